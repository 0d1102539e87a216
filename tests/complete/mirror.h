#pragma once
#include <gtest/gtest.h>

#include "limpid/ops/fresnel_reflection.h"

#include "complete/shore.h"

namespace limpid::test {

constexpr float kWall = 3, kSky = 7, kInside = 90;  ///< radiance

/// A pure mirror over calm water, in both runners.
struct Mirror : Shore {
  Look look = still_look();

  Mirror() {
    FresnelReflection::Params& params = look.of<FresnelReflection>();
    params.source = FresnelReflection::Source::kAuto;
    params.lookup = FresnelReflection::Lookup::kRay;
    params.reflectance = FresnelReflection::Reflectance::kRim;
    params.power = 0;
    params.color = {0.25, 0.25, 0.25};
    scene.water = WaterPlane{};
    for (const PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
      buffers.set(id, [&](int x, int y) {
        const float depth = dry_depth(x, y);
        return depth == kInf ? kSky : depth == 20 ? kWall : 1.0f;
      });
    }
    for (const PlaneId id : {PlaneId::kReflectionR, PlaneId::kReflectionG, PlaneId::kReflectionB}) {
      buffers.frame.planes[index_of(id)] = {};
    }
  }
  void give_reflection() {
    for (const PlaneId id : {PlaneId::kReflectionR, PlaneId::kReflectionG, PlaneId::kReflectionB}) {
      buffers.set(id, [&](int x, int y) {
        const bool inside = dry_depth(x, y) == 20 && 2 + 20 * ray(x, y).y > 0;
        return inside ? kInside : mirrored_depth(x, y) == 20 ? kWall : kSky;
      });
    }
  }
  /// The picture of the reference, after a check that the fused runner agrees.
  Picture pictures() {
    Picture exact = reference(look, buffers.frame, scene);
    const Picture fast = fused(look, buffers.frame, scene);
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        EXPECT_NEAR(exact.color(x, y).r, fast.color(x, y).r, 1e-3) << x << ", " << y;
      }
    }
    return exact;
  }
  bool wet(int x, int y) const {
    const double sinks = ray(x, y).y;
    return sinks < 0 && -2 / sinks < dry_depth(x, y);
  }
  /// The mirror's color there, 0 near an end of the wall.
  float expected(int x, int y) const {
    const double at = mirrored_depth(x, y);
    for (int off = -4; off <= 4; ++off) {
      const int row = std::clamp(y + off, 0, kSize.height - 1);
      if (mirrored_depth(x, row) != at || !wet(x, row)) return 0;
    }
    return at == 20 ? kWall : kSky;
  }
  /// Checks all mirrored pixels; the number of pixels that show the wall.
  int check(const Picture& picture, float sky = kSky) const {
    int walls = 0, skies = 0;
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 2; x < kSize.width - 2; ++x) {
        const float wanted = wet(x, y) ? expected(x, y) : 0;
        if (wanted == 0) continue;
        const float shown = wanted == kSky ? sky : wanted;
        EXPECT_NEAR(picture.color(x, y).r, shown, 1e-4) << x << ", " << y;
        (wanted == kWall ? walls : skies) += 1;
      }
    }
    EXPECT_GT(skies, 50);
    return walls;
  }
};

/// A wall whose mirror image a leaned facet sees from lower than the eye does: near its foot, rays
/// meet it that in the picture end above it.
struct Ridge : Mirror {
  static constexpr Size kWide{320, 240};
  double lean;

  Ridge(double top_of_wall, double lean_of_facets) : lean(lean_of_facets) {
    top = top_of_wall;
    buffers = Buffers(rect_of(kWide));
    const auto set = [&](PlaneId first, auto&& value) {
      for (int c = 0; c < 3; ++c) buffers.set(plane_after(first, c), value);
    };
    buffers.set(PlaneId::kDepth, [&](int x, int y) { return depth(x, y); });
    set(PlaneId::kColorR, [&](int x, int y) {
      return depth(x, y) == kInf ? kSky : 2 + far * ray(x, y).y > 0 ? kWall : 1.0f;
    });
    set(PlaneId::kReflectionR,
        [&](int x, int y) { return image_depth(x, y) == kInf ? kSky : kWall; });
    buffers.set(PlaneId::kReflectionDepth, [&](int x, int y) { return image_depth(x, y); });
    const double length = std::hypot(1, lean);
    buffers.set(PlaneId::kSurfaceNormalX, [](int, int) { return 0.0f; });
    buffers.set(PlaneId::kSurfaceNormalY, [&](int, int) { return float(1 / length); });
    buffers.set(PlaneId::kSurfaceNormalZ, [&](int, int) { return float(lean / length); });
  }
  glm::dvec3 ray(int x, int y) const {
    return rays_of(*scene.camera, {kWide.width, kWide.height}).ray_at(x + 0.5, y + 0.5);
  }
  float depth(int x, int y) const {
    const double sinks = ray(x, y).y;
    if (2 + far * sinks > top) return kInf;
    return static_cast<float>(sinks < 0 ? std::min(far, -(2 + deep) / sinks) : far);
  }
  float image_depth(int x, int y) const {
    const double height = -(2 + far * ray(x, y).y);
    return height > 0 && height < top ? float(far) : kInf;
  }
  /// Height over the water at which the mirrored ray of a pixel passes the wall.
  double passes_at(int x, int y) const {
    const glm::dvec3 view = ray(x, y), normal = glm::normalize(glm::dvec3(0, 1, lean));
    const glm::dvec3 mirrored = view - 2 * glm::dot(view, normal) * normal;
    return (far - 2 / -view.y) * mirrored.y / -mirrored.z;
  }
};

}  // namespace limpid::test
