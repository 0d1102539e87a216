#include "judge/hard/world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "limpid/core/error.h"
#include "limpid/core/simd.h"
#include "limpid/enter/sanitise.h"
#include "limpid/files/text/look_file.h"
#include "limpid/plan/plan.h"
#include "limpid/run/fused.h"
#include "limpid/run/reference.h"

#include "judge/hard/sea.h"

namespace limpid {
namespace {

constexpr const char* kReference = "reference";
constexpr const char* kGpu = "gpu";

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

bool HardPicture::has_water() const {
  for (int y = window_.y0; y < window_.y1; ++y) {
    for (int x = window_.x0; x < window_.x1; ++x) {
      if (wet(x, y) || aov(Aov::kPath, x, y) > 0) return true;
    }
  }
  return false;
}

View<float> HardPicture::added() { return planes_.emplace_back(window_).view(); }

HardWorld::HardWorld(const std::filesystem::path& data, int threads, const GpuOptions* gpu)
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
  if (gpu) {
    gpu_ = std::make_unique<GpuRunner>(*gpu);
    runners_.push_back(kGpu);
  }
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
                      .environment = true,
                      .waves = scene.has_waves()};
  const Plan plan = make_plan(look, inputs, all);
  HardPicture picture(whole.work());
  if (runner == kReference) {
    run_reference(plan, whole, scene, picture.target);
  } else if (runner == kGpu) {
    gpu_->run(plan, whole, scene, picture.target, *executor_);
  } else {
    run_fused(plan, whole, scene, picture.target, *executor_, {.simd = runner});
  }
  return picture;
}

HardFrame noisy_frame(Size size) {
  constexpr float kSky = std::numeric_limits<float>::infinity();
  HardFrame frame(rect_of(size));
  for (int i = 0; i < kPlaneCount; ++i) {
    frame.set(static_cast<PlaneId>(i), [i](int x, int y) { return 2 * hard_noise(x, y, i); });
  }
  frame.set(PlaneId::kShadow, [](int x, int y) { return hard_noise(x, y, 40) > 0.3f ? 1 : 0; });
  frame.set(PlaneId::kSurfaceShadow, [](int x, int y) { return hard_noise(x, y, 47); });
  frame.set(PlaneId::kSurfaceDepth, [](int x, int y) {
    return hard_noise(x / 7, y / 5, 41) > 0.25f ? 3 + hard_noise(x, y, 42) : kSky;
  });
  frame.set(PlaneId::kDepth, [](int x, int y) {
    const float kind = hard_noise(x / 4, y / 3, 43);
    return kind < 0.2f ? 2.0f : kind < 0.3f ? kSky : 3.5f + 6 * hard_noise(x / 2, y / 2, 44);
  });
  for (int c = 0; c < 3; ++c) {
    frame.set(plane_after(PlaneId::kSurfaceNormalX, c), [c](int x, int y) {
      const double across = 0.5 * hard_noise(x, y, 45) - 0.25;
      const double along = 0.5 * hard_noise(x, y, 46) - 0.25;
      const double normal[] = {across, 1, along};
      return normal[c] / std::sqrt(across * across + 1 + along * along);
    });
  }
  return frame;
}

Scene noisy_scene(Size size) { return Sea{.size = size}.scene(); }

std::string place_text(const std::string& runner, const std::string& look, int x, int y) {
  return runner + ", " + look + ", pixel " + std::to_string(x) + " " + std::to_string(y);
}

Look calm_look(const HardWorld& world) {
  Look look = world.look("physical");
  look.of<WaveNormals>().strength = 0;
  look.of<PrismSplit>().gain = 0;
  look.of<WaveNormals>().filter = WaveNormals::Filter::kNone;
  look.of<FresnelReflection>().source = FresnelReflection::Source::kConstant;
  look.of<FresnelReflection>().facets = FresnelReflection::Facets::kMean;
  // A fitted plane is as exact as its input, not as the formulas.
  look.of<Refraction>().off_frame = Refraction::OffFrame::kShorten;
  look.of<Caustics>().sunlight = Caustics::Sunlight::kStraight;
  return look;
}

}  // namespace limpid
