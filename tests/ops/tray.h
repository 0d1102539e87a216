#pragma once
#include <gtest/gtest.h>

#include "support.h"

namespace limpid::test {

/// The plainest picture to work out by hand: an orthographic camera looks straight down on water
/// at y = 0, one scene unit a pixel, the viewer straight up from every point. On screen x is world
/// x and y (down) is world z, so a normal (a, b, c) has the tilt (a, c). Water 10 away, bottom 14;
/// color 0.5, no other planes, no sun.
inline Scene tray_scene(Size size) {
  Scene scene;
  Camera camera;
  camera.view = glm::lookAt(glm::dvec3(0, 10, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -1));
  camera.projection = orthographic(size.width, size.height, 0.1, 100, ClipSpace::kGl);
  scene.camera = camera;
  scene.water = WaterPlane{};
  return scene;
}

struct Tray {
  explicit Tray(Size size) : buffers(rect_of(size)), scene(tray_scene(size)) {
    for (PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
      buffers.fill(id, 0.5f);
    }
    buffers.fill(PlaneId::kSurfaceDepth, 10).fill(PlaneId::kDepth, 14);
  }
  Picture wet() const { return reference(look, buffers.frame, scene); }

  Buffers buffers;
  Scene scene;
  Look look = still_look();
};

/// Noise everywhere, but no reflection and no layer below, seen by a perspective camera.
struct Noise {
  explicit Noise(Size size) : buffers(noisy_frame(rect_of(size))), scene(simple_scene(size)) {
    for (PlaneId first : {PlaneId::kReflectionR, PlaneId::kBelowR}) {
      for (int c = 0; c < 3; ++c) buffers.frame.planes[index_of(first) + c] = {};
    }
  }
  Picture wet() const { return reference(look, buffers.frame, scene); }

  Buffers buffers;
  Scene scene;
  Look look = still_look();
};

inline void expect_rgb(Rgb<double> got, Rgb<double> expected, double tolerance = 1e-6) {
  EXPECT_NEAR(got.r, expected.r, tolerance);
  EXPECT_NEAR(got.g, expected.g, tolerance);
  EXPECT_NEAR(got.b, expected.b, tolerance);
}

inline Rgb<double> rgb_of(const Picture& picture, Aov which, int x, int y) {
  return {picture.aov(which, x, y, 0), picture.aov(which, x, y, 1), picture.aov(which, x, y, 2)};
}

/// Calls fn(x, y) on every pixel of the picture's wet part.
template <class Fn>
void each_wet(const Picture& picture, Size size, Fn&& fn) {
  int wet = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (std::isinf(picture.aov(Aov::kSurfaceDepth, x, y))) continue;
      ++wet;
      fn(x, y);
    }
  }
  EXPECT_GT(wet, 0);
}

}  // namespace limpid::test
