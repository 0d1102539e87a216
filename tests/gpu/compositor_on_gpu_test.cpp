#include <cstring>

#include <gmock/gmock.h>

#include "limpid/compositor.h"
#include "limpid/core/error.h"

#include "embed/host.h"
#include "embed/limpid_c.h"
#include "gpu/gpu.h"

/// A compositor whose runner is a GPU's, in C++ and in C, gives the bits of that runner.

namespace limpid {
namespace {

using test::Picture;
using ::testing::HasSubstr;
using ::testing::StartsWith;

using CompositorOnGpu = test::GpuTest;

/// The picture that a GpuRunner makes of the frame with the look physical, color and alpha.
std::vector<float> judged(const Frame& frame, const Scene& scene) {
  Picture picture(frame.work());
  picture.target.aovs = {};
  GpuRunner().run(make_plan({}, test::inputs_of(frame, scene)), frame, scene, picture.target,
                  *make_executor(1));
  return picture.values();
}

std::string refusal(const CompositorOptions& options) {
  try {
    Compositor made({}, {}, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST_F(CompositorOnGpu, GivesTheBitsOfTheRunnerFrameAfterFrame) {
  const Size size{53, 31};
  const Scene scene = test::simple_scene(size);
  Compositor water({.trusted = true}, {}, {.gpu = GpuOptions{}});
  EXPECT_THAT(water.device(), StartsWith(gpu_devices()[0].name));
  EXPECT_EQ(Compositor().device(), "");
  for (const Size& of_frame : {size, Size{20, 41}, size}) {
    const test::Buffers buffers = test::noisy_frame(rect_of(of_frame));
    Picture picture(rect_of(of_frame));
    picture.target.aovs = {};
    water.run(test::host_frame(buffers.frame, scene), test::host_picture(picture.target));
    EXPECT_EQ(picture.values(), judged(buffers.frame, scene));
  }
}

TEST_F(CompositorOnGpu, RefusesWhatAGpuDoesNotDo) {
  EXPECT_THAT(refusal({.max_error = 0.01, .gpu = GpuOptions{}}),
              HasSubstr("max_error = 0.010000, expected 0 on a GPU, which leaves nothing out"));
  EXPECT_THAT(refusal({.gpu = GpuOptions{.simd = "scalar"}}),
              HasSubstr("the simd of gpu is scalar, expected it in the options of the compositor"));
  EXPECT_THAT(refusal({.gpu = GpuOptions{.device = "no such device"}}),
              StartsWith("no GPU has 'no such device' in its name: expected a part of one of "));
}

/// A frame in the C functions' types, outside of a test of its own.
struct InC : test::c::LimpidC {
  using LimpidC::buffers;
  using LimpidC::conventions;
  using LimpidC::frame;
  using LimpidC::out;
  using LimpidC::picture;
  using LimpidC::water;
  void TestBody() override {}
};

TEST_F(CompositorOnGpu, IsThereInC) {
  InC c;
  limpid_destroy(c.water);
  limpid_options options = LIMPID_OPTIONS;
  options.runner = LIMPID_RUNNER_GPU;
  char text[256] = "?";
  ASSERT_EQ(limpid_create(&c.conventions, &options, &c.water, text, sizeof text), LIMPID_OK)
      << text;
  const std::size_t length = limpid_device_text(c.water, text, sizeof text);
  EXPECT_EQ(length, std::strlen(text));
  EXPECT_THAT(text, StartsWith(gpu_devices()[0].name));
  ASSERT_EQ(limpid_run(c.water, &c.frame, &c.picture), LIMPID_OK) << limpid_message(c.water);
  EXPECT_EQ(c.out.values(), judged(c.buffers.frame, test::simple_scene(test::c::kSize)));
  limpid_destroy(c.water);
  options.gpu = "no such device";
  EXPECT_EQ(limpid_create(&c.conventions, &options, &c.water, text, sizeof text), LIMPID_REFUSED);
  EXPECT_THAT(text, StartsWith("no GPU has 'no such device' in its name"));
}

}  // namespace
}  // namespace limpid
