#include <cmath>

#include <gmock/gmock.h>

#include "limpid/compositor.h"
#include "limpid/core/error.h"

#include "embed/host.h"
#include "embed/subject.h"

/// Frames and pictures that a compositor refuses, before it writes.

namespace limpid {
namespace {

using test::busy_look;
using test::kNan;
using test::kSize;
using test::Picture;
using test::Subject;
using ::testing::HasSubstr;

std::string refusal(Compositor& compositor, const HostFrame& frame, const HostPicture& picture) {
  try {
    compositor.run(frame, picture);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

/// A refused frame leaves the picture alone.
TEST(Compositor, RefusesBeforeItWrites) {
  const Subject s;
  Compositor compositor({.trusted = true}, busy_look());
  const HostFrame good = test::host_frame(s.buffers.frame, s.scene);
  Picture picture(rect_of(kSize));
  const HostPicture out = test::host_picture(picture.target);
  const std::vector<float> before = picture.values();

  HostFrame frame = good;
  frame.scene.camera.reset();
  EXPECT_THAT(refusal(compositor, frame, out), HasSubstr("no camera"));
  frame = good;
  frame.scene.water.reset();
  EXPECT_THAT(refusal(compositor, frame, out), HasSubstr("no water plane"));
  frame = good;
  frame.plane(PlaneId::kDepth) = {};
  EXPECT_THAT(refusal(compositor, frame, out), HasSubstr("no depth"));
  frame = good;
  frame.plane(PlaneId::kColorG).window.x1 -= 1;
  EXPECT_THAT(refusal(compositor, frame, out), HasSubstr("color covers"));
  frame = good;
  frame.display = {};
  EXPECT_THAT(refusal(compositor, frame, out), HasSubstr("display window is empty"));
  frame = good;
  frame.plane(PlaneId::kShadow).window = {};
  EXPECT_THAT(refusal(compositor, frame, out), HasSubstr("shadow has no pixels"));
  frame = good;
  frame.display = {-2000000000, -5, 2000000000, 41};
  EXPECT_THAT(refusal(compositor, frame, out), HasSubstr("2^29"));
  frame = good;
  frame.scene.camera->projection[3][3] = 1;
  EXPECT_THAT(refusal(compositor, frame, out), HasSubstr("projection"));

  HostPicture wrong = out;
  wrong.color[1] = {};
  EXPECT_THAT(refusal(compositor, good, wrong), HasSubstr("no color"));
  wrong = out;
  wrong.alpha.window.y1 -= 1;
  EXPECT_THAT(refusal(compositor, good, wrong), HasSubstr("alpha does not cover"));
  wrong = out;
  wrong.color[2].x_stride = 0;
  EXPECT_THAT(refusal(compositor, good, wrong), HasSubstr("pixels share bytes"));
  wrong.color[2] = out.color[2];
  wrong.color[2].x_stride = 2;
  EXPECT_THAT(refusal(compositor, good, wrong), HasSubstr("pixels share bytes"));
  wrong = out;
  wrong.color[2] = out.color[1];
  EXPECT_THAT(refusal(compositor, good, wrong), HasSubstr("shares bytes with color"));
  wrong.color[2].data = static_cast<std::byte*>(out.color[1].data) + 2;  // overlaps in part
  EXPECT_THAT(refusal(compositor, good, wrong), HasSubstr("shares bytes with color"));
  wrong = out;
  wrong.of(Aov::kNormal)[1] =
      test::host_picture(picture.target, {Aov::kNormal}).of(Aov::kNormal)[1];
  EXPECT_THAT(refusal(compositor, good, wrong), HasSubstr("lacks its first channel"));
  wrong = out;
  wrong.of(Aov::kPath) = {out.color[0], out.color[1], out.color[2]};
  EXPECT_THAT(refusal(compositor, good, wrong), HasSubstr("AOV path"));
  EXPECT_EQ(picture.values(), before);

  EXPECT_THROW(Compositor({.depth = DepthKind::kNormalised}), Error);
  EXPECT_THROW(Compositor({.depth = DepthKind::kNormalised, .near = 1, .far = HUGE_VAL}), Error);
  EXPECT_THROW(Compositor({}, {}, {.simd = "mmx"}), Error);
  EXPECT_THROW(Compositor({}, {}, {.max_error = -1}), Error);
  Look bad;
  bad.water.ior = kNan;
  EXPECT_THROW(Compositor({}, bad), Error);
}

/// The commonest mistake of a host: reversed depth that the conventions do not declare.
TEST(Compositor, RefusesDeviceDepthThatRunsTheOtherWay) {
  const Subject s;
  HostFrame frame = test::host_frame(s.buffers.frame, s.scene);
  Picture picture(rect_of(kSize));
  for (const bool reversed : {false, true}) {
    const ClipSpace said = reversed ? ClipSpace::kGl : ClipSpace::kReversed;
    const ClipSpace is = reversed ? ClipSpace::kReversed : ClipSpace::kGl;
    Compositor compositor({.depth = DepthKind::kDevice, .clip = said}, busy_look());
    frame.scene.camera->projection = perspective(0.9, 67.0 / 41, 0.1, 1e3, is);
    EXPECT_THAT(refusal(compositor, frame, test::host_picture(picture.target)),
                HasSubstr("device depth"));
  }
}

TEST(Compositor, RefusesADepthNothingThatIsNoNumber) {
  for (const double bad : {double{test::kInf}, std::nan("")}) {
    try {
      Compositor({.depth_nothing = bad});
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("depth_nothing"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace limpid
