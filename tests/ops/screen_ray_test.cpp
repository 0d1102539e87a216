#include "op/screen_ray.h"

#include <gtest/gtest.h>

#include "op/pixel.h"
#include "support.h"

namespace limpid {
namespace {

/// A ray from the middle of a picture, in this direction.
ScreenRay<double> ray_towards(const Pass& c, Vec3<double> direction) {
  Pixel<double> p{};
  p.uv = {0.5, 0.5};
  p.surface_depth = 6;
  return ScreenRay<double>(c, p, direction);
}

TEST(ScreenRay, ShareOfTheWayOnScreenAndBack) {
  const Size size{64, 48};
  const test::Buffers b = test::noisy_frame(rect_of(size));
  const Scene scene = test::simple_scene(size);
  const Pass c(scene, b.frame, 1.333, {});
  const Vec3<double> directions[] = {{0, -1, 0}, {0.3, -0.8, 0.5}, {-0.2, -0.7, -0.6}};
  for (const Vec3<double>& direction : directions) {
    const ScreenRay<double> ray = ray_towards(c, direction);
    for (const double end : {0.5, 3.0}) {
      EXPECT_NEAR(ray.share_at(0, end), 0, 1e-12);
      EXPECT_NEAR(ray.share_at(end, end), 1, 1e-12);
      for (const double t : {0.01, 0.3, 0.9}) {
        const double s = ray.at_share(t, end);
        EXPECT_NEAR(ray.share_at(s, end), t, 1e-12);
        // Shares are of the way on screen: the shift there is that part of the one at the end.
        EXPECT_NEAR(ray.shift_at(s).y, t * ray.shift_at(end).y, 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace limpid
