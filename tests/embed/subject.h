#pragma once
#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include "limpid/compositor.h"

#include "embed/host.h"

/// The frames for the tests of the compositor, and the pictures by which they are judged.

namespace limpid::test {

constexpr Size kSize{67, 41};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

inline Look busy_look() {
  Look look = article_look();
  look.of<PrismSplit>().strength = 0.01;
  look.of<SunHighlight>().power = 20;
  return look;
}

/// Noise in the conventions of a frame, except that normals have unit length only to a float's last
/// bit.
inline Buffers raw_frame(Size size) {
  Buffers b = noisy_frame(rect_of(size));
  b.set(PlaneId::kReflectionValid, [](int x, int y) { return noise(x, y, 50); });
  return b;
}

/// The same noise after entry.
inline Buffers valid_frame(Size size) {
  Buffers b = raw_frame(size);
  std::array<Plane, 3> normal;
  for (int c = 0; c < 3; ++c) {
    normal[c] = Plane(rect_of(size));
    fill(host_view(normal[c].view()), b.frame.plane(plane_after(PlaneId::kSurfaceNormalX, c)));
  }
  sanitise_normal(normal[0].view(), normal[1].view(), normal[2].view(), {0, 1, 0});
  for (int c = 0; c < 3; ++c) {
    b.set(plane_after(PlaneId::kSurfaceNormalX, c),
          [&](int x, int y) { return normal[c].view().at(x, y); });
  }
  return b;
}

/// A frame, its scene, and the fused runner's picture of them.
struct Subject {
  explicit Subject(Size size = kSize)
      : buffers(valid_frame(size)),
        scene(simple_scene(size)),
        expected(judged(busy_look(), buffers.frame, scene)) {}
  Buffers buffers;
  Scene scene;
  std::vector<float> expected;
};

inline std::vector<float> wet(Compositor& compositor, const HostFrame& frame) {
  Picture picture(frame.display);
  compositor.run(frame, host_picture(picture.target));
  return picture.values();
}

inline bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

}  // namespace limpid::test
