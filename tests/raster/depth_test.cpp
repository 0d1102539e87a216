#include <gtest/gtest.h>

#include "raster_scenes.h"

namespace limpid {
namespace {

using namespace test;

constexpr ClipSpace kClips[] = {ClipSpace::kGl, ClipSpace::kD3d, ClipSpace::kReversed};

/// Eye depth at which the ray of a pixel meets the plane of three points.
double plane_depth(const RasterView& view, int x, int y, const glm::dvec3& p, const glm::dvec3& n) {
  const Rays rays = rays_of(view.camera, {view.display.width(), view.display.height()});
  const glm::dvec3 from = view.camera.eye() + rays.origin_at(x + 0.5, y + 0.5);
  return glm::dot(n, p - from) / glm::dot(n, rays.ray_at(x + 0.5, y + 0.5));
}

/// Counts the covered pixels, and compares each with the plane.
int expect_plane(const RasterImage& image, const RasterView& view, const glm::dvec3& p,
                 const glm::dvec3& n, double tolerance) {
  int covered = 0;
  const Rect& w = view.window;
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      if (at(image.coverage, x, y) != 1) {
        EXPECT_EQ(at(image.depth, x, y), kInfinity);
        continue;
      }
      ++covered;
      const double expected = plane_depth(view, x, y, p, n);
      EXPECT_NEAR(at(image.depth, x, y), expected, tolerance * std::abs(expected)) << x << ' ' << y;
    }
  }
  return covered;
}

TEST(Depth, IsThatOfTheTrianglesPlaneInEveryClipSpace) {
  Random random(5);
  for (ClipSpace clip : kClips) {
    for (double far : {50.0, kInfinity}) {
      for (int round = 0; round < 30; ++round) {
        const RasterView view = perspective_view(67, 41, {3, 2, 5}, {0, 0, 0}, clip, 0.1, far);
        const auto corner = [&] {
          return glm::vec3(random.between(-6, 6), random.between(-4, 4), random.between(-3, 3));
        };
        Mesh mesh = triangles({corner(), corner(), corner()});
        Model model = model_of({mesh});
        model.materials[0].double_sided = true;
        const RasterImage image = drawn(model, view);
        const glm::dvec3 a(mesh.positions[0]), b(mesh.positions[1]), c(mesh.positions[2]);
        expect_plane(image, view, a, glm::cross(b - a, c - a), 3e-7);
      }
    }
  }
}

TEST(Depth, OfAHorizonKeepsFloatPrecision) {
  // A ground of two triangles, 1e5 to each side, seen from 2 above it.
  const double e = 1e5;
  const Model model = model_of({quad({-e, 0, e}, {e, 0, e}, {e, 0, -e}, {-e, 0, -e})});
  const RasterView view = perspective_view(320, 180, {0, 2, 0}, {0, 1.9, -1});
  const RasterImage image = drawn(model, view);
  EXPECT_GT(expect_plane(image, view, {0, 0, 0}, {0, 1, 0}, 3e-7), 320 * 90);
}

TEST(Depth, OfOrthographicViewsMayBeNegative) {
  RasterView view = flat_view(40, 30);
  const Model model = model_of(
      {triangles({pixel_point(1, 1, -20), pixel_point(3, 29, 60), pixel_point(39, 10, 35)})});
  const RasterImage image = drawn(model, view);
  const glm::dvec3 a = pixel_point(1, 1, -20), b = pixel_point(3, 29, 60),
                   c = pixel_point(39, 10, 35);
  EXPECT_GT(expect_plane(image, view, a, glm::cross(b - a, c - a), 1e-5), 300);
}

TEST(Depth, NearestWinsWhateverTheOrder) {
  const Mesh near = quad(pixel_point(5, 20, 3), pixel_point(20, 20, 3), pixel_point(20, 5, 3),
                         pixel_point(5, 5, 3));
  const Mesh far = quad(pixel_point(10, 25, 7), pixel_point(25, 25, 7), pixel_point(25, 10, 7),
                        pixel_point(10, 10, 7));
  for (const Model& model : {model_of({near, far}), model_of({far, near})}) {
    const RasterImage image = drawn(model, flat_view(30, 30));
    EXPECT_EQ(at(image.depth, 15, 15), 3);
    EXPECT_EQ(at(image.depth, 22, 22), 7);
    EXPECT_EQ(at(image.depth, 7, 7), 3);
    EXPECT_EQ(at(image.depth, 2, 2), kInfinity);
  }
}

TEST(Clip, NothingIsNearerThanTheNearPlaneOrBeyondTheFarPlane) {
  for (ClipSpace clip : kClips) {
    const RasterView view = perspective_view(90, 70, {0, 1, 0}, {0, 0, -1}, clip, 1.2, 9.0);
    const Model model = model_of({quad({-50, 0, 50}, {50, 0, 50}, {50, 0, -50}, {-50, 0, -50})});
    const RasterImage image = drawn(model, view);
    int covered = 0;
    for (int y = 0; y < 70; ++y) {
      for (int x = 0; x < 90; ++x) {
        const double depth = plane_depth(view, x, y, {0, 0, 0}, {0, 1, 0});
        const bool expected = depth > 1.2 && depth < 9;
        if (std::abs(depth - 1.2) < 0.003 || std::abs(depth - 9) < 0.02) continue;  // snapping
        EXPECT_EQ(at(image.coverage, x, y), expected) << x << ' ' << y << ' ' << depth;
        covered += expected;
      }
    }
    EXPECT_GT(covered, 1000);
  }
}

TEST(Clip, UserPlaneKeepsItsPositiveSide) {
  RasterView view = perspective_view(90, 70, {0.4, 2, 1}, {0, 0, -1});
  const glm::dvec4 plane(0.8, 0.1, 0.6, 0.3);
  const Model model = model_of({hills(10, 30, 0)});
  view.clip_plane = plane;
  const RasterImage image = drawn(model, view);
  view.clip_plane.reset();
  const RasterImage whole = drawn(model, view);
  const Rays rays = rays_of(view.camera, {90, 70});
  int kept = 0, cut = 0;
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 90; ++x) {
      if (at(whole.coverage, x, y) == 0) continue;
      const glm::dvec3 p =
          view.camera.eye() + double(at(whole.depth, x, y)) * rays.ray_at(x + 0.5, y + 0.5);
      const double side = glm::dot(plane, glm::dvec4(p, 1));
      if (std::abs(side) < 0.01 * at(whole.depth, x, y)) continue;
      ASSERT_EQ(at(image.coverage, x, y), side > 0) << x << ' ' << y;
      if (side > 0) {
        EXPECT_NEAR(at(image.depth, x, y), at(whole.depth, x, y), 1e-5);
        ++kept;
      } else {
        ++cut;
      }
    }
  }
  EXPECT_GT(kept, 300);
  EXPECT_GT(cut, 300);
}

TEST(Clip, EdgeOnAndPastTheEyeTrianglesGiveDepthInRange) {
  Random random(6);
  for (int round = 0; round < 500; ++round) {
    // Planes through or nearly through the eye at the origin.
    const double tiny = round % 2 ? 0 : 1e-9;
    const auto corner = [&] {
      return glm::vec3(random.between(-1, 1), tiny * random.next(), random.between(-3, 1));
    };
    Model model = model_of({triangles({corner(), corner(), corner()})});
    model.materials[0].double_sided = true;
    const RasterView view = perspective_view(64, 64, {0, 0, 0}, {0, 0, -1});
    const RasterImage image = drawn(model, view, low_sun());
    for (float value : values(image)) ASSERT_FALSE(std::isnan(value));
    for (int i = 0; i < 64 * 64; ++i) {
      if (at(image.coverage, i % 64, i / 64) == 1) {
        ASSERT_GT(at(image.depth, i % 64, i / 64), 0.09);
        ASSERT_LT(at(image.depth, i % 64, i / 64), 6.1);
      }
    }
  }
}

}  // namespace
}  // namespace limpid
