#include <array>
#include <string>

#include <gtest/gtest.h>

#include "limpid/core/simd.h"

#include "raster_scenes.h"

namespace limpid {
namespace {

using namespace test;

constexpr int kSize = 37;

struct Point {
  int x, y;  ///< 1/256 pixel
};

std::int64_t side(Point a, Point b, Point p) {
  return std::int64_t{b.x - a.x} * (p.y - a.y) - std::int64_t{b.y - a.y} * (p.x - a.x);
}

/// 1 strictly inside of a convex polygon (clockwise with y down), 0 strictly outside, -1 on its
/// rim.
int inside(const std::vector<Point>& polygon, Point p) {
  int answer = 1;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::int64_t s = side(polygon[i], polygon[(i + 1) % polygon.size()], p);
    if (s < 0) return 0;
    if (s == 0) answer = -1;
  }
  return answer;
}

glm::vec3 point(Point p) { return pixel_point(p.x / 256.0, p.y / 256.0); }

/// The count of triangles that cover each pixel, drawn one by one.
std::vector<int> counts(const std::vector<std::array<Point, 3>>& all, const std::string& simd) {
  std::vector<int> covered(kSize * kSize);
  const auto executor = make_executor(1);
  for (const auto& t : all) {
    const Model model = model_of({triangles({point(t[0]), point(t[1]), point(t[2])})});
    RasterView view = flat_view(kSize, kSize);
    view.cull = false;
    const RasterImage image = rasterise(model, view, {}, {.coverage = true}, *executor, simd);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        covered[static_cast<std::size_t>(y * kSize + x)] += at(image.coverage, x, y) == 1;
      }
    }
  }
  return covered;
}

/// Each pixel strictly inside is covered once, strictly outside never, on the rim at most once.
void expect_once(const std::vector<Point>& polygon, const std::vector<int>& covered) {
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const int expected = inside(polygon, {256 * x + 128, 256 * y + 128});
      const int got = covered[static_cast<std::size_t>(y * kSize + x)];
      if (expected < 0) {
        ASSERT_LE(got, 1) << x << ' ' << y;
      } else {
        ASSERT_EQ(got, expected) << x << ' ' << y;
      }
    }
  }
}

/// Positions that often hit pixel centres and edges exactly.
Point random_point(Random& random) {
  const int step = random.next() < 0.5 ? 128 : random.next() < 0.5 ? 32 : 1;
  const auto coordinate = [&] { return random.below((kSize + 8) * 256 / step) * step - 4 * 256; };
  return {coordinate(), coordinate()};
}

class CoverageOnTarget : public testing::TestWithParam<std::string> {};

TEST_P(CoverageOnTarget, TwoTrianglesThatShareAnEdgeCoverEachPixelOnce) {
  Random random(1);
  int pairs = 0;
  while (pairs < 1500) {
    const Point a = random_point(random), b = random_point(random), c = random_point(random),
                d = random_point(random);
    const std::vector<Point> outline{a, b, c, d};
    bool convex = true;
    for (std::size_t i = 0; i < 4; ++i) {
      convex = convex && side(outline[i], outline[(i + 1) % 4], outline[(i + 2) % 4]) > 0;
    }
    if (!convex) continue;
    ++pairs;
    // The diagonal in either sense, the corners in any order.
    const bool turned = random.next() < 0.5;
    ASSERT_NO_FATAL_FAILURE(
        expect_once(outline, counts({turned ? std::array{c, a, b} : std::array{a, b, c},
                                     turned ? std::array{a, d, c} : std::array{a, c, d}},
                                    GetParam())));
  }
}

TEST_P(CoverageOnTarget, FansHaveNoCracks) {
  Random random(2);
  for (int fan = 0; fan < 60; ++fan) {
    // Rounded points of a circle, without the points that would make the rim concave.
    std::vector<Point> rim;
    const double radius = random.between(2, 17);
    const int corners = 5 + random.below(12);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * 3.14159265358979 * i / corners;
      rim.push_back({static_cast<int>(256 * (18.5 + radius * std::cos(angle))),
                     static_cast<int>(256 * (18.5 + radius * std::sin(angle)))});
    }
    // Every other fan has its middle on a pixel's centre, which one of the fan's triangles must
    // cover.
    const int off = fan % 2 ? random.below(200) - 100 : 0;
    const Point middle{256 * 18 + 128 + off, 256 * 18 + 128 - off};
    std::vector<std::array<Point, 3>> triangles;
    for (std::size_t i = 0; i < rim.size(); ++i) {
      triangles.push_back({middle, rim[i], rim[(i + 1) % rim.size()]});
    }
    ASSERT_NO_FATAL_FAILURE(expect_once(rim, counts(triangles, GetParam())));
  }
}

INSTANTIATE_TEST_SUITE_P(Simd, CoverageOnTarget, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST(Coverage, LargeTrianglesAreExactToo) {
  // Corners up to 16000 pixels away; one corner is each pixel's centre or next to the centre.
  Random random(3);
  for (int round = 0; round < 300; ++round) {
    const auto far = [&] {
      const double angle = random.between(0, 6.28318530717959);
      return Point{static_cast<int>(256 * 15000 * std::cos(angle)),
                   static_cast<int>(256 * 15000 * std::sin(angle))};
    };
    const Point a = far(), b{-a.x + 256 * random.below(kSize), -a.y + 256 * random.below(kSize)},
                c = far();
    if (side(a, b, c) == 0) continue;
    const std::vector<Point> outline =
        side(a, b, c) > 0 ? std::vector<Point>{a, b, c} : std::vector<Point>{a, c, b};
    ASSERT_NO_FATAL_FAILURE(expect_once(outline, counts({{a, b, c}}, "")));
  }
}

TEST(Coverage, MeshesThroughTheNearPlaneAndTheGuardBandHaveNoCracks) {
  // Jittered ground from behind the camera to far beyond the sides: every pixel below the horizon.
  Random random(4);
  for (double extent : {40.0, 4000.0, 4e6}) {
    Mesh ground = hills(30, extent, 0);
    for (glm::vec3& p : ground.positions) {
      p += glm::vec3(random.between(-0.3, 0.3), 0, random.between(-0.3, 0.3)) *
           static_cast<float>(extent / 30);
    }
    RasterView view = perspective_view(160, 120, {0, 1, 0}, {0.3, 0.4, -1}, ClipSpace::kGl, 0.01);
    const RasterImage image = drawn(model_of({ground}), view);
    const Rays rays = rays_of(view.camera, {160, 120});
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        const glm::dvec3 ray = rays.ray_at(x + 0.5, y + 0.5);
        const double depth = -1 / ray.y;
        const double reach = std::max(std::abs(depth * ray.x), std::abs(depth * ray.z));
        if (ray.y < 0 && reach < 0.47 * extent) {
          ASSERT_EQ(at(image.coverage, x, y), 1) << extent << ": " << x << ' ' << y;
        }
        if (ray.y > 0) {
          ASSERT_EQ(at(image.coverage, x, y), 0) << x << ' ' << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace limpid
