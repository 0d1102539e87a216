#include "report/hard_world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "limpid/core/error.h"
#include "limpid/core/simd.h"
#include "limpid/load/look_file.h"
#include "limpid/load/sanitise.h"
#include "limpid/plan/plan.h"
#include "limpid/run/fused.h"
#include "limpid/run/reference.h"

namespace limpid {
namespace {

constexpr const char* kReference = "reference";

template <class Fn>
void fill(Plane& plane, Size size, Fn&& value) {
  plane = Plane(rect_of(size));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) plane.view().at(x, y) = value(x, y);
  }
}

Texture texture_of(const std::array<Plane, 3>& planes) {
  return {.channels = {planes[0].view(), planes[1].view(), planes[2].view()}};
}

}  // namespace

float hard_noise(int x, int y, int channel) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9E3779B1u ^
                    static_cast<std::uint32_t>(y) * 0x85EBCA77u ^
                    static_cast<std::uint32_t>(channel) * 0xC2B2AE3Du;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) / static_cast<float>(1 << 24);
}

Plane& HardFrame::add(PlaneId id) {
  Plane& plane = planes_[index_of(id)];
  plane = Plane(frame_.display);
  frame_.planes[index_of(id)] = plane.view();
  return plane;
}

void HardFrame::sanitise(const glm::dvec3& up) { sanitise_planes(planes_, up); }

HardPicture::HardPicture(Rect window) : window_(window) {
  for (View<float>& view : target.color) view = added();
  target.alpha = added();
  for (int a = 0; a < kAovCount; ++a) {
    for (std::size_t i = 0; i < aovs()[a].suffixes.size(); ++i) target.aovs[a][i] = added();
  }
}

View<float> HardPicture::added() { return planes_.emplace_back(window_).view(); }

HardWorld::HardWorld(const std::filesystem::path& data, int threads)
    : runners_{kReference}, executor_(make_executor(threads)) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(data / "looks", error)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  if (files.empty()) throw Error((data / "looks").string() + ": has no looks (*.toml)");
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) looks_.push_back(load_look(file));
  for (const std::string& simd : simd_targets()) runners_.push_back(simd);
  for (int c = 0; c < 3; ++c) {
    fill(waves_[c], {16, 8},
         [c](int x, int y) { return c == 2 ? 0.9f : 0.3f + 0.4f * hard_noise(x, y, 60 + c); });
    fill(sky_[c], {8, 4}, [c](int x, int y) { return hard_noise(x, y, 70 + c); });
  }
}

const Look& HardWorld::look(const std::string& name) const {
  for (const Look& look : looks_) {
    if (look.name == name) return look;
  }
  throw Error("hard cases need the look " + name + ", which the data folder does not have");
}

HardPicture HardWorld::run(const std::string& runner, const Look& look, const HardFrame& frame,
                           const Scene& scene) const {
  Frame whole = frame.frame();
  if (!whole.wave_map) whole.wave_map = texture_of(waves_);
  if (!whole.environment) whole.environment = texture_of(sky_);
  StateSet all;
  for (const AovInfo& info : aovs()) all = all | info.parts;
  const Inputs inputs{.planes = whole.present(),
                      .wave_map = true,
                      .sun = scene.sun.has_value(),
                      .environment = true};
  const Plan plan = make_plan(look, inputs, all);
  HardPicture picture(whole.work());
  if (runner == kReference) {
    run_reference(plan, whole, scene, picture.target);
  } else {
    run_fused(plan, whole, scene, picture.target, *executor_, {.simd = runner});
  }
  return picture;
}

std::string place_text(const std::string& runner, const std::string& look, int x, int y) {
  return runner + ", " + look + ", pixel " + std::to_string(x) + " " + std::to_string(y);
}

Look calm_look(const HardWorld& world) {
  Look look = world.look("physical");
  look.of<WaveNormals>().strength = 0;
  look.of<PrismSplit>().gain = 0;
  look.of<FresnelReflection>().source = FresnelReflection::Source::kConstant;
  return look;
}

}  // namespace limpid
