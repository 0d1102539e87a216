#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/ext/matrix_transform.hpp>

#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/run/fused.h"
#include "limpid/run/reference.h"

/// Small made-up frames and targets for tests.

namespace limpid::test {

constexpr float kInf = std::numeric_limits<float>::infinity();

/// Deterministic numbers in 0 ... 1 from a position: no state, the same on every machine.
inline float noise(int x, int y, int channel) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9E3779B1u ^
                    static_cast<std::uint32_t>(y) * 0x85EBCA77u ^
                    static_cast<std::uint32_t>(channel) * 0xC2B2AE3Du;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) / static_cast<float>(1 << 24);
}

/// Owns the planes of a frame. set() makes a plane from a function of the pixel.
class Buffers {
 public:
  explicit Buffers(Rect display) { frame.display = display; }

  template <class Fn>
  Buffers& set(PlaneId id, Fn&& value, Rect window) {
    Plane& plane = planes_[index_of(id)];
    plane = Plane(window);
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) plane.view().at(x, y) = value(x, y);
    }
    frame.planes[index_of(id)] = plane.view();
    return *this;
  }
  template <class Fn>
  Buffers& set(PlaneId id, Fn&& value) {
    return set(id, value, frame.display);
  }
  Buffers& fill(PlaneId id, float value) {
    return set(id, [=](int, int) { return value; });
  }
  Buffers& normal(Vec3<double> n) {
    fill(PlaneId::kSurfaceNormalX, static_cast<float>(n.x));
    fill(PlaneId::kSurfaceNormalY, static_cast<float>(n.y));
    return fill(PlaneId::kSurfaceNormalZ, static_cast<float>(n.z));
  }

  Frame frame;

 private:
  std::array<Plane, kPlaneCount> planes_;
};

/// A camera 2 above the water plane y = 0 that looks down by 30 degrees, and a low sun.
inline Scene simple_scene(Size size) {
  Scene scene;
  Camera camera;
  camera.view =
      glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 2 - std::tan(std::numbers::pi / 6), -1),
                  glm::dvec3(0, 1, 0));
  camera.projection = perspective(0.9, double(size.width) / size.height, 0.1, 1e3, ClipSpace::kGl);
  scene.camera = camera;
  scene.water = WaterPlane{};
  scene.sun = Sun{{0, 0.6, -0.8}, {3, 2.5, 2}};
  return scene;
}

/// Every plane of a frame, made of noise: wavy normals, a bottom that rises through the surface in
/// places, some sky.
inline Buffers noisy_frame(Rect display) {
  Buffers b(display);
  for (int i = 0; i < kPlaneCount; ++i) {
    b.set(static_cast<PlaneId>(i), [&](int x, int y) { return 2 * noise(x, y, i); });
  }
  b.set(PlaneId::kShadow, [](int x, int y) { return noise(x, y, 40) > 0.3f ? 1.0f : 0.0f; });
  b.set(PlaneId::kSurfaceShadow, [](int x, int y) { return noise(x, y, 47); });
  b.set(PlaneId::kSurfaceDepth,
        [](int x, int y) { return noise(x / 7, y / 5, 41) > 0.25f ? 3 + noise(x, y, 42) : kInf; });
  b.set(PlaneId::kDepth, [](int x, int y) {
    const float kind = noise(x / 4, y / 3, 43);
    return kind < 0.2f ? 2.0f : kind < 0.3f ? kInf : 3.5f + 6 * noise(x / 2, y / 2, 44);
  });
  const auto normal = [](int x, int y) {
    const double sx = 0.5 * noise(x, y, 45) - 0.25, sz = 0.5 * noise(x, y, 46) - 0.25;
    const double length = std::sqrt(sx * sx + 1 + sz * sz);
    return std::array<float, 3>{static_cast<float>(sx / length), static_cast<float>(1 / length),
                                static_cast<float>(sz / length)};
  };
  for (int c = 0; c < 3; ++c) {
    b.set(plane_after(PlaneId::kSurfaceNormalX, c),
          [&](int x, int y) { return normal(x, y)[static_cast<std::size_t>(c)]; });
  }
  return b;
}

/// A tiling map of noise around straight up.
class NoiseMap {
 public:
  NoiseMap(int width, int height) {
    for (int c = 0; c < 3; ++c) {
      planes_[c] = Plane(Rect{0, 0, width, height});
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          planes_[c].view().at(x, y) = c == 2 ? 0.9f : 0.3f + 0.4f * noise(x, y, 60 + c);
        }
      }
      texture.channels[c] = planes_[c].view();
    }
  }
  Texture texture;

 private:
  std::array<Plane, 3> planes_;
};

/// A target that owns its planes: color, alpha and all AOVs.
class Picture {
 public:
  explicit Picture(Rect window) : window_(window) {
    for (View<float>& view : target.color) view = added();
    target.alpha = added();
    for (int a = 0; a < kAovCount; ++a) {
      for (std::size_t i = 0; i < aovs()[a].suffixes.size(); ++i) target.aovs[a][i] = added();
    }
  }

  Rgb<double> color(int x, int y) const {
    return {target.color[0].at(x, y), target.color[1].at(x, y), target.color[2].at(x, y)};
  }
  double aov(Aov which, int x, int y, int channel = 0) const {
    return target.of(which)[channel].at(x, y);
  }
  /// All channels in one row: for comparing pictures bit for bit or by difference.
  std::vector<float> values() const {
    std::vector<float> all;
    for (const Plane& plane : planes_) {
      for (int y = window_.y0; y < window_.y1; ++y) {
        for (int x = window_.x0; x < window_.x1; ++x) all.push_back(plane.view().at(x, y));
      }
    }
    return all;
  }

  Target target;

 private:
  View<float> added() {
    planes_.emplace_back(window_);
    return planes_.back().view();
  }
  Rect window_;
  std::vector<Plane> planes_;
};

inline StateSet all_state() {
  StateSet all;
  for (const AovInfo& info : aovs()) all = all | info.parts;
  return all;
}

inline Inputs inputs_of(const Frame& frame, const Scene& scene) {
  return {frame.present(),       static_cast<bool>(frame.wave_map),
          scene.sun.has_value(), static_cast<bool>(frame.environment),
          scene.has_waves(),     scene.primaries};
}

/// Pure water, without sunlight's path down and the surface: tests vary one property of fog at a
/// time.
inline DepthFog::Params plain_fog(DepthFog::Model model) {
  DepthFog::Params fog;
  fog.model = model;
  fog.distance = DepthFog::Distance::kEye;
  fog.water_type = WaterType::kCustom;
  fog.scattering = fog.ambient = {0, 0, 0};
  fog.crossing = DepthFog::Crossing::kNone;
  return fog;
}

/// The models of "Realistic Water", which are the plainest to work out by hand.
inline Look article_look() {
  Look look;
  look.water.edges = Water::Edges::kHard;
  look.of<WaveNormals>().model = WaveNormals::Model::kFourMaps;
  look.of<PrismSplit>().model = PrismSplit::Model::kAxis;
  Refraction::Params& refraction = look.of<Refraction>();
  refraction.model = Refraction::Model::kNormalOffset;
  refraction.rejection = Refraction::Rejection::kSnap;
  refraction.off_frame = Refraction::OffFrame::kClamp;
  look.of<Caustics>() = {.strength = 0, .sunlight = Caustics::Sunlight::kStraight};
  look.of<DepthFog>() = plain_fog(DepthFog::Model::kLinear);
  look.of<WaterShadow>() = {WaterShadow::Model::kDarken, 0.5};
  look.of<FresnelReflection>().lookup = FresnelReflection::Lookup::kOffset;
  look.of<SunHighlight>().model = SunHighlight::Model::kBlinnPhong;
  return look;
}

/// The same look with every operator neutral or absent, except operators that a test sets
/// afterwards.
inline Look still_look() {
  Look look = article_look();
  look.of<Refraction>().strength = 0;
  look.of<DepthFog>().alpha = 0;
  look.of<WaterShadow>().strength = 0;
  look.of<SunHighlight>().strength = 0;
  return look;
}

inline Picture reference(const Look& look, const Frame& frame, const Scene& scene) {
  Picture picture(frame.work());
  run_reference(make_plan(look, inputs_of(frame, scene), all_state()), frame, scene,
                picture.target);
  return picture;
}

inline Picture fused(const Look& look, const Frame& frame, const Scene& scene,
                     const FusedOptions& options = {}, int threads = 1) {
  Picture picture(frame.work());
  run_fused(make_plan(look, inputs_of(frame, scene), all_state()), frame, scene, picture.target,
            *make_executor(threads), options);
  return picture;
}

}  // namespace limpid::test
