#include "judge/hard/hard_case.h"
#include "judge/hard/sea.h"

namespace limpid {

void add_sea_cases(HardCases& cases, const std::string& group, const std::string& name,
                   const Sea& sea) {
  const auto add = [&](SeaError what, const char* quantity, const char* reason) {
    cases.push_back({group, name + ", " + quantity,
                     std::string("error of the ") + quantity + " over its bound", reason, 1,
                     [=](const HardWorld& world) { return sea_error(world, sea, what); }});
  };
  add(SeaError::kSurface, "surface depth",
      "7 roundings: three of the height over the water, three of the ray's fall, one of the "
      "quotient");
  add(SeaError::kPath, "path",
      "30 roundings of heights, of the numbers that are summed, and 10 of the path");
  add(SeaError::kReflectance, "reflectance",
      "6 roundings of the cosine times the largest slope, 6.3, and 8 of the formula");
}

void add_projection_cases(HardCases& cases) {
  const auto add = [&](const char* name, const Sea& sea) {
    add_sea_cases(cases, "projection", name, sea);
  };
  add("orthographic", {.orthographic = 3});
  add("lens shift", {.shift = {0.7, -0.4}});
  add("pixels twice as wide as high", {.pixel_aspect = 2});
  add("pixels half as wide as high", {.pixel_aspect = 0.5});
  add("a turned world", {.turned = true});
  add("all but orthographic at once", {.shift = {-0.5, 0.6}, .pixel_aspect = 1.7, .turned = true});
  add("orthographic in a turned world",
      {.orthographic = 3, .pixel_aspect = 0.6, .clip = ClipSpace::kReversed, .turned = true});
}

}  // namespace limpid
