#include "limpid/files/picture/display.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"
#include "limpid/files/picture/preview.h"

#include "files/exr/written.h"
#include "files/picture/tiny_ocio.h"

/// What a screen shows of light in other primaries, and by a config of OpenColorIO.

namespace limpid {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using Light = std::array<float, 3>;

Light shown(const DisplayTransform& display, const Light& light) {
  std::array<View<const float>, 3> views;
  for (std::size_t i = 0; i < 3; ++i) views[i] = {&light[i], 1, 0, {0, 0, 1, 1}};
  const std::array<Plane, 3> planes = display.displayed(views);
  return {planes[0].view().at(0, 0), planes[1].view().at(0, 0), planes[2].view().at(0, 0)};
}

Primaries acescg() { return find_color_space("ACEScg").value(); }
std::filesystem::path config() { return test::write_tiny_ocio(test::own_folder() / "config.ocio"); }

std::string refusal(const DisplayChoice& choice, const Primaries& primaries = kRec709) {
  return test::error_of([&] { DisplayTransform{choice, primaries}; });
}

TEST(Display, UsuallyIsThePreviewOfEachChannel) {
  const Light light{.18f, 3, -1};
  for (const double stops : {0.0, -1.5, 2.0}) {
    const Light out = shown(DisplayTransform({.exposure = stops}), light);
    for (std::size_t i = 0; i < 3; ++i) {
      const View<const float> view{&light[i], 1, 0, {0, 0, 1, 1}};
      EXPECT_EQ(out[i], displayed(view, stops).view().at(0, 0));
    }
  }
}

TEST(Display, OtherPrimariesBecomeThoseOfTheScreen) {
  const DisplayTransform display({}, acescg());
  // The red of Rec.709, in ACEScg.
  const Light red = shown(display, {.61309732f, .07019422f, .02061560f});
  EXPECT_NEAR(red[0], 1, 1e-5);
  EXPECT_NEAR(red[1], 0, 2e-5);
  EXPECT_NEAR(red[2], 0, 2e-5);
  for (const float gray : {.01f, .18f, .7f}) {
    for (const float channel : shown(display, {gray, gray, gray})) {
      EXPECT_NEAR(channel, srgb_from_linear(gray), 1e-5);
    }
  }
  const Light twice = shown(DisplayTransform({.exposure = 1}, acescg()), {.1f, .1f, .1f});
  EXPECT_NEAR(twice[1], srgb_from_linear(.2f), 1e-5);
  // What the screen cannot show is as near as it comes.
  const Light green = shown(display, {0, 1, 0});
  EXPECT_EQ(green[0], 0);
  EXPECT_NEAR(green[1], 1, 1e-6);
  EXPECT_EQ(green[2], 0);
}

TEST(Display, NothingComesOutThatIsNoNumber) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const float nan = std::nanf("");
  for (const Primaries& primaries : {kRec709, acescg()}) {
    const DisplayTransform display({}, primaries);
    EXPECT_EQ(shown(display, {nan, nan, nan}), (Light{0, 0, 0}));
    EXPECT_EQ(shown(display, {-kInfinity, -kInfinity, -kInfinity}), (Light{0, 0, 0}));
    for (const float channel : shown(display, {kInfinity, kInfinity, kInfinity})) {
      EXPECT_NEAR(channel, 1, 1e-6);
    }
  }
}

TEST(Display, AConfigsViews) {
  EXPECT_THAT(display_views(config()), ElementsAre("screen/half", "screen/swapped", "wall/half"));
  EXPECT_EQ(display_view(config(), ""), "screen/half");
  EXPECT_EQ(display_view(config(), "swapped"), "screen/swapped");
  EXPECT_EQ(display_view(config(), "wall/half"), "wall/half");
}

void expect_shown(const DisplayTransform& display, const Light& light, const Light& expected) {
  const Light out = shown(display, light);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(out[i], expected[i], 1e-5) << i;
}

TEST(Display, ShowsAConfigsView) {
  const Light light{.1f, .2f, .4f};
  expect_shown(DisplayTransform({0, config(), ""}), light, {.05f, .1f, .2f});
  expect_shown(DisplayTransform({1, config(), "wall/half"}), light, {.1f, .2f, .4f});
  expect_shown(DisplayTransform({0, config(), "swapped"}), light, {.4f, .2f, .1f});
  // The config has no ACEScg: light goes to the space that it has.
  expect_shown(DisplayTransform({0, config(), "swapped"}, acescg()),
               {.61309732f, .07019422f, .02061560f}, {0, 0, 1});
}

TEST(Display, Refuses) {
  EXPECT_THAT(refusal({.exposure = 101, .config = {}}), HasSubstr("exposure = 101"));
  EXPECT_THAT(refusal({0, config(), "swaped"}),
              HasSubstr("view 'swaped' of " + config().string() +
                        ": expected sRGB or one of screen/half, screen/swapped, wall/half"));
  const auto absent = test::own_folder() / "absent.ocio";
  EXPECT_THAT(refusal({0, absent, ""}), HasSubstr("absent.ocio: "));
  const auto text = test::written("text.ocio", "no config\n");
  EXPECT_THAT(refusal({0, text, ""}), HasSubstr("--display sRGB needs no OpenColorIO"));
}

}  // namespace
}  // namespace limpid
