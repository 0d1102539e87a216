#include "complete/edge_surfaces.h"

#include <cmath>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "op/pass.h"
#include "support.h"

// The surfaces above the water at the edge of the picture.

namespace limpid {
namespace {

using test::kInf;

/// A level view from 2 above the water: noise of things of all depths, sky and bottom.
struct Shown {
  Rect window;
  test::Buffers buffers{window};
  Scene scene = test::simple_scene(window.size());
  EdgeSurfacesMaker maker;
  const EdgeSurfaces* made = nullptr;

  explicit Shown(Rect size, int threads = 1) : window(size) {
    scene.camera->view =
        glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 2, -1), glm::dvec3(0, 1, 0));
    buffers.set(PlaneId::kDepth, [](int x, int y) {
      const float kind = test::noise(x / 3, y / 3, 1);
      return kind < 0.3f ? kInf : kind < 0.8f ? 1 + 3 * kind : 40.0f;
    });
    for (int c = 0; c < 3; ++c) {
      buffers.set(plane_after(PlaneId::kColorR, c),
                  [c](int x, int y) { return test::noise(x, y, 2 + c); });
    }
    make(threads);
  }
  void make(int threads = 1) {
    const Pass pass(scene, buffers.frame, 1.333, {});
    made = maker.make(buffers.frame, pass, *make_executor(threads));
  }
  const View<const float>& plane(int k) const {
    const Texture& texture = k < 3 ? made->colors : made->shape;
    return texture.channels[static_cast<std::size_t>(k % 3)];
  }
  int columns() const { return plane(0).window.width() / 4; }

  /// Red, green, blue, 1, depth and its square of a surface there, and 1 of a surface or sky.
  using Texel = std::array<double, 7>;
  Texel texel(int x, int y) const {
    const auto at = [&](PlaneId id) -> double { return buffers.frame.plane(id).at(x, y); };
    const double rise = rays_of(*scene.camera, {double(window.width()), double(window.height())})
                            .ray_at(x - window.x0 + 0.5, y - window.y0 + 0.5)
                            .y;
    const double depth = at(PlaneId::kDepth);
    if (depth == kInf) return {0, 0, 0, 0, 0, 0, rise > 0 ? 1.0 : 0.0};
    if (!(2 + depth * rise > 0)) return {};
    return {at(PlaneId::kColorR),
            at(PlaneId::kColorG),
            at(PlaneId::kColorB),
            1,
            depth,
            depth * depth,
            1};
  }
  /// The outermost texels from the upper left corner to the right, down, to the left and up.
  std::vector<Texel> around() const {
    std::vector<Texel> all;
    const Rect& w = window;
    for (int x = w.x0; x < w.x1; ++x) all.push_back(texel(x, w.y0));
    for (int y = w.y0; y < w.y1; ++y) all.push_back(texel(w.x1 - 1, y));
    for (int x = w.x1 - 1; x >= w.x0; --x) all.push_back(texel(x, w.y1 - 1));
    for (int y = w.y1 - 1; y >= w.y0; --y) all.push_back(texel(w.x0, y));
    return all;
  }
};

/// The mean of texels of a ring from one place to another, which may be beyond its ends.
Shown::Texel mean_of(const std::vector<Shown::Texel>& ring, double begin, double end) {
  const int count = static_cast<int>(ring.size());
  Shown::Texel mean{};
  for (int i = static_cast<int>(std::floor(begin)); i < end; ++i) {
    const double part = std::min(end, i + 1.0) - std::max(begin, double(i));
    const Shown::Texel& texel = ring[static_cast<std::size_t>((i % count + count) % count)];
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += part * texel[k] / (end - begin);
  }
  return mean;
}

TEST(EdgeSurfaces, AreMeansOfTheEdgeAsFarAsTheRowSays) {
  for (const Rect window : {Rect{-4, 3, 36, 23}, Rect{0, 0, 10, 30}, Rect{2, 1, 3, 2},
                            Rect{0, 0, 1, 7}, Rect{0, 0, 40, 1}}) {
    const Shown shown(window);
    const auto ring = shown.around();
    const double longer = std::max(window.width(), window.height());
    ASSERT_EQ(shown.columns(), longer);
    ASSERT_EQ(shown.plane(3).window.height(), EdgeSurfaces::kRows);
    EXPECT_EQ(shown.made->reach, longer / 2);
    double begin = 0;
    for (int i = 0; i < 4 * shown.columns(); ++i) {
      const double step =
          (i / shown.columns() % 2 == 0 ? window.width() : window.height()) / longer;
      for (int row = 0; row < EdgeSurfaces::kRows; ++row) {
        const double part = row / (EdgeSurfaces::kRows - 1.0);
        const double half = std::max(longer / 2 * part * part, step / 2);
        const Shown::Texel mean = mean_of(ring, begin + step / 2 - half, begin + step / 2 + half);
        const double depth = mean[4] > 0 ? mean[3] * mean[5] / mean[4] : 0;
        for (int k = 0; k < 3; ++k) {
          ASSERT_NEAR(shown.plane(k).at(i, row), mean[static_cast<std::size_t>(k)], 1e-5)
              << i << ", " << row << " of " << window.width() << "x" << window.height();
        }
        ASSERT_NEAR(shown.plane(3).at(i, row), mean[3], 1e-5) << i << ", " << row;
        ASSERT_NEAR(shown.plane(4).at(i, row), depth, 1e-4 + 1e-5 * depth) << i << ", " << row;
        ASSERT_NEAR(shown.plane(5).at(i, row), mean[6], 1e-5) << i << ", " << row;
      }
      begin += step;
    }
  }
}

// A picture of more texels than columns.
TEST(EdgeSurfaces, OfALargePictureAreMeansOfItsTexels) {
  Shown shown({0, 0, 2100, 3});
  EXPECT_LT(shown.columns(), 1024);
  shown.buffers.fill(PlaneId::kDepth, 1).set(PlaneId::kColorR, [](int x, int) {
    return x % 2 == 0 ? 1.0f : 2.0f;
  });
  shown.make();
  for (int i = 0; i < shown.columns(); ++i) {
    EXPECT_NEAR(shown.plane(0).at(i, 0), 1.5, 0.2) << i;
    EXPECT_NEAR(shown.plane(0).at(i, 9), 1.5, 0.01) << i;
    EXPECT_NEAR(shown.plane(3).at(i, 9), 1, 1e-5) << i;
  }
}

// Light of the largest number in one texel leaves the rest of the edge as it is.
TEST(EdgeSurfaces, InfiniteLightStaysWhereItIs) {
  Shown shown({0, 0, 40, 20});
  shown.buffers.fill(PlaneId::kDepth, 1).set(PlaneId::kColorR, [](int x, int y) {
    return x == 3 && y == 0 ? kInf : 2.0f;
  });
  shown.make();
  EXPECT_NEAR(shown.plane(0).at(3, 0), 65504, 1);
  for (int i = 5; i < 160; ++i) EXPECT_NEAR(shown.plane(0).at(i, 0), 2, 1e-5) << i;
}

/// A hall with a ceiling at a height, and walls at both sides, 4 and 20 away. The columns before
/// `open` show the sky.
struct Hall : Shown {
  Hall(double ceiling, int open) : Shown({0, 0, 40, 40}) {
    const Rays rays = rays_of(*scene.camera, {40, 40});
    buffers.set(PlaneId::kDepth, [&](int x, int y) {
      const double wall = x < 10 || x >= 30 ? 4 : 20, rise = rays.ray_at(x + 0.5, y + 0.5).y;
      if (x < open) return kInf;
      return static_cast<float>(rise > 0 ? std::min(wall, (ceiling - 2) / rise) : wall);
    });
    make();
  }
};

TEST(EdgeSurfaces, ARoomIsClosed) {
  EXPECT_EQ(Hall(3, 0).made->closed, 1);
  EXPECT_EQ(Hall(3, 3).made->closed, 1) << "a window";
  EXPECT_EQ(Hall(3, 20).made->closed, 0) << "a roof on one side";
  EXPECT_EQ(Hall(1e3, 0).made->closed, 0) << "a yard";
  Hall trees(1e3, 0);
  trees.buffers.set(PlaneId::kDepth, [](int, int y) { return y == 0 ? 3.0f : 20.0f; });
  trees.make();
  EXPECT_EQ(trees.made->closed, 0) << "twigs before a wall";
  Hall turned(1e3, 0);
  turned.scene.camera->view =
      glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 2, -1), glm::dvec3(0, -1, 0));
  turned.buffers.fill(PlaneId::kDepth, 2);
  turned.make();
  EXPECT_EQ(turned.made->closed, 0) << "a wall, upside down";
}

// In a room they would be a haze.
TEST(EdgeSurfaces, LampsOfARoomCountAsFourTimesTheMedian) {
  for (const float lamp : {9.0f, kInf}) {
    Hall hall(3, 0);
    for (int c = 0; c < 3; ++c) {
      hall.buffers.set(plane_after(PlaneId::kColorR, c), [=](int x, int y) {
        return x == 20 && y == 0 ? lamp : 2.0f / float(1 + c);
      });
    }
    hall.make();
    EXPECT_NEAR(hall.plane(0).at(20, 0), 8, 1e-5);
    EXPECT_NEAR(hall.plane(2).at(20, 0), 8, 1e-5) << "as white as it is";
    for (int i = 22; i < 40; ++i) EXPECT_NEAR(hall.plane(0).at(i, 0), 2, 1e-5) << i;
  }
}

TEST(EdgeSurfaces, ThreadsDoNotMatter) {
  const Shown one({-4, 3, 36, 23}), four({-4, 3, 36, 23}, 4);
  EXPECT_EQ(one.made->closed, four.made->closed);
  for (int k = 0; k < 6; ++k) {
    for (int row = 0; row < EdgeSurfaces::kRows; ++row) {
      for (int i = 0; i < 160; ++i) ASSERT_EQ(one.plane(k).at(i, row), four.plane(k).at(i, row));
    }
  }
}

}  // namespace
}  // namespace limpid
