#pragma once
#include <filesystem>
#include <string>

#include "limpid/files/text/look_file.h"

#include "ops/tray.h"
#include "paths.h"

/// The common code of the articles' tests. The comments work each article's formulas out by hand,
/// at pixels of the tray (ops/tray.h), with the numbers of the article's look.

namespace limpid::test {

inline Look look_of_article(const std::string& name) {
  return load_look(std::filesystem::path(LIMPID_DATA) / "looks" / (name + ".toml"));
}

/// The same camera leant back: V = (0, 0.6, 0.8) everywhere. World x still runs to the right.
inline void look_aslant(Tray& tray) {
  tray.scene.camera->view =
      glm::lookAt(glm::dvec3(0, 6, 8), glm::dvec3(0, 0, 0), glm::dvec3(0, 1, 0));
}

/// Three planes whose values tell the position of a lookup: red is x, green y, in pixels (whole at
/// the centres), blue x again.
inline void fill_places(Buffers& buffers, PlaneId first) {
  const auto across = [](int x, int) { return static_cast<float>(x); };
  const auto down = [](int, int y) { return static_cast<float>(y); };
  buffers.set(first, across).set(plane_after(first, 1), down).set(plane_after(first, 2), across);
}

/// A normal map of 8 x 8 texels. With tile_size 8 a texel is as large as a pixel of the tray; the
/// centre of the pixel (6, 1) of 8 x 8 is that of the texel (2, 2), for the map's u runs along
/// world x and its v along -z, from the middle of the picture.
class TexelMap {
 public:
  /// A map of fn(x, y), the color of the texel (x, y).
  template <class Fn>
  explicit TexelMap(Fn&& color) {
    for (Plane& plane : planes_) plane = Plane(Rect{0, 0, 8, 8});
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        const Rgb<double> c = color(x, y);
        planes_[0].view().at(x, y) = static_cast<float>(c.r);
        planes_[1].view().at(x, y) = static_cast<float>(c.g);
        planes_[2].view().at(x, y) = static_cast<float>(c.b);
      }
    }
    for (int c = 0; c < 3; ++c) texture.channels[c] = planes_[c].view();
  }
  /// A map of one color.
  explicit TexelMap(Rgb<double> color) : TexelMap([=](int, int) { return color; }) {}

  Texture texture;

 private:
  std::array<Plane, 3> planes_;
};

inline void expect_vector(Vec3<double> got, Vec3<double> expected, double tolerance = 2e-6) {
  EXPECT_NEAR(got.x, expected.x, tolerance);
  EXPECT_NEAR(got.y, expected.y, tolerance);
  EXPECT_NEAR(got.z, expected.z, tolerance);
}

inline Vec3<double> normal_at(const Picture& picture, int x, int y) {
  return {picture.aov(Aov::kNormal, x, y, 0), picture.aov(Aov::kNormal, x, y, 1),
          picture.aov(Aov::kNormal, x, y, 2)};
}

/// The position of a channel's lookup, in pixels from the pixel's own centre: x right, y down.
inline Vec2<double> shift_at(const Picture& picture, Aov stmap, int x, int y, Size size) {
  return {picture.aov(stmap, x, y, 0) * size.width - (x + 0.5),
          (1 - picture.aov(stmap, x, y, 1)) * size.height - (y + 0.5)};
}

inline void expect_shift(Vec2<double> got, Vec2<double> expected, double tolerance = 1e-5) {
  EXPECT_NEAR(got.x, expected.x, tolerance);
  EXPECT_NEAR(got.y, expected.y, tolerance);
}

}  // namespace limpid::test
