#pragma once
#include <cstring>
#include <vector>

#include <glm/gtc/type_ptr.hpp>
#include <gmock/gmock.h>

#include "limpid/limpid.h"

#include "embed/host.h"

/// A frame and a picture as C passes them.

namespace limpid::test::c {

constexpr Size kSize{37, 23};

inline limpid_channel channel(int what, const View<const float>& view) {
  return {what,
          LIMPID_FLOAT,
          const_cast<float*>(view.data),
          4 * view.x_stride,
          4 * view.y_stride,
          0,
          0,
          0,
          0};
}

/// A frame of noise and a picture for this frame, as C structs.
class LimpidC : public testing::Test {
 protected:
  LimpidC() : buffers(noisy_frame(rect_of(kSize))), out(rect_of(kSize)) {
    const Scene scene = simple_scene(kSize);
    for (int i = 0; i < kPlaneCount; ++i) planes.push_back(channel(i, buffers.frame.planes[i]));
    for (int c = 0; c < 3; ++c) outputs.push_back(channel(c, out.target.color[c]));
    outputs.push_back(channel(LIMPID_OUT_A, out.target.alpha));
    frame.size = sizeof frame;
    frame.width = kSize.width;
    frame.height = kSize.height;
    frame.planes = planes.data();
    frame.plane_count = planes.size();
    set_matrix(frame.view, scene.camera->view);
    set_matrix(frame.projection, scene.camera->projection);
    frame.water_up[1] = 2;  // need not have length 1
    frame.has_sun = 1;
    for (int i = 0; i < 3; ++i) {
      frame.sun_direction[i] = 3 * scene.sun->direction[i];
    }
    frame.sun_color[0] = scene.sun->color.r;
    frame.sun_color[1] = scene.sun->color.g;
    frame.sun_color[2] = scene.sun->color.b;
    picture.size = sizeof picture;
    picture.outputs = outputs.data();
    picture.output_count = outputs.size();
    conventions.trusted = 1;
    limpid_create(&conventions, nullptr, &water, nullptr, 0);
  }
  ~LimpidC() override { limpid_destroy(water); }

  static void set_matrix(double* to, const glm::dmat4& m) {
    std::memcpy(to, glm::value_ptr(m), sizeof m);
  }
  std::vector<float> expected(const Look& look, const Primaries& primaries = kRec709) {
    Scene scene = simple_scene(kSize);
    scene.primaries = primaries;
    scene.sun->direction = glm::normalize(3.0 * scene.sun->direction);
    return judged(look, buffers.frame, scene);
  }
  void expect_refused(const char* why) {
    const std::vector<float> before = out.values();
    EXPECT_EQ(limpid_run(water, &frame, &picture), LIMPID_REFUSED);
    EXPECT_THAT(limpid_message(water), ::testing::HasSubstr(why));
    EXPECT_EQ(out.values(), before);
  }

  Buffers buffers;
  Picture out;
  std::vector<limpid_channel> planes, outputs;
  limpid_frame frame{};
  limpid_picture picture{};
  limpid_conventions conventions = LIMPID_CONVENTIONS;
  limpid_compositor* water = nullptr;
};

}  // namespace limpid::test::c
