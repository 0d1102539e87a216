#include "limpid/files/picture/preview.h"

#include <cmath>
#include <string>
#include <vector>

#include "limpid/core/error.h"

#include "files/picture/whole_image.h"

namespace limpid {
// IEC 61966-2-1:1999 "Colour management - Default RGB colour space - sRGB".
float srgb_from_linear(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

float linear_from_srgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

Plane displayed(View<const float> linear, double exposure_stops) {
  const auto gain = static_cast<float>(std::exp2(exposure_stops));
  Plane plane(linear.window);
  const View<float> to = plane.view();
  for (int y = linear.window.y0; y < linear.window.y1; ++y) {
    for (int x = linear.window.x0; x < linear.window.x1; ++x) {
      const float value = linear.at(x, y) * gain;
      // NaN, which is not above 0, becomes 0.
      to.at(x, y) = value > 0 ? srgb_from_linear(std::fmin(value, 1.0f)) : 0.0f;
    }
  }
  return plane;
}

void write_preview(const std::filesystem::path& path, View<const float> r, View<const float> g,
                   View<const float> b, double exposure_stops,
                   const std::map<std::string, std::string>& texts) {
  if (!(std::abs(exposure_stops) <= 100)) {
    throw Error(path.string() + ": exposure of " + std::to_string(exposure_stops) +
                ": expected -100 ... 100 (stops)");
  }
  AtomicFiles files;
  write_preview(files, path, {r, g, b}, DisplayTransform({.exposure = exposure_stops}), texts);
  files.commit();
}

void write_preview(AtomicFiles& files, const std::filesystem::path& path,
                   const std::array<View<const float>, 3>& light, const DisplayTransform& display,
                   const std::map<std::string, std::string>& texts) {
  const std::array<Plane, 3> planes = display.displayed(light);
  write_image8(files, path, {planes[0].view(), planes[1].view(), planes[2].view()}, texts);
}

}  // namespace limpid
