#include "judge/shot/shot_error.h"

#include <array>
#include <utility>

#include <gtest/gtest.h>

#include "core/convert_color.h"

/// The error of a shot is that of the light, whatever primaries its numbers have.

namespace limpid {
namespace {

constexpr Rect kWindow{0, 0, 24, 16};
const Primaries kAcesCg = find_color_space("ACEScg").value();

using Picture = std::array<Plane, 3>;

/// Colors from dark to bright, the middle ones more reddish by `red`.
Picture picture(float red) {
  Picture made{Plane(kWindow), Plane(kWindow), Plane(kWindow)};
  for (int y = 0; y < kWindow.y1; ++y) {
    for (int x = 0; x < kWindow.x1; ++x) {
      const float light = 0.02f * static_cast<float>(x + 1);
      made[0].view().at(x, y) = light + (x > 7 && x < 16 ? red : 0);
      made[1].view().at(x, y) = 0.8f * light;
      made[2].view().at(x, y) = 0.03f * static_cast<float>(y + 1);
    }
  }
  return made;
}
ColorViews views(const Picture& of) { return {of[0].view(), of[1].view(), of[2].view()}; }

ShotError error_in(const Primaries& primaries) {
  Picture one = picture(0.1f), judge = picture(0);
  for (Picture* each : {&one, &judge}) {
    convert_color({(*each)[0].view(), (*each)[1].view(), (*each)[2].view()}, primaries, kRec709);
  }
  const WetMask wet(static_cast<std::size_t>(kWindow.area()), 1);
  return shot_error(views(one), views(judge), wet, primaries);
}

TEST(ShotError, LooksTheSameInEveryWorkingSpace) {
  const ShotError plain = error_in(kRec709), wide = error_in(kAcesCg);
  EXPECT_GT(plain.flip, 0.01) << "there is an error to see";
  EXPECT_LT(plain.ssim, 0.9999);
  EXPECT_NEAR(wide.flip, plain.flip, 1e-4);
  EXPECT_NEAR(wide.ssim, plain.ssim, 1e-4);
  EXPECT_LT(wide.pixels.max, 0.99 * plain.pixels.max) << "the numbers are those of the space";
}

}  // namespace
}  // namespace limpid
