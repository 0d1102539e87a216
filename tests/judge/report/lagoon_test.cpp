#include "judge/report/lagoon.h"

#include <gtest/gtest.h>

#include "judge/report/picture.h"
#include "paths.h"

/// Water on the plate lagoon, by the fused runner, beside a path-traced picture of the same water.

namespace limpid::test {
namespace {

class LagoonTest : public ::testing::Test {
 protected:
  TruthError error_of(const Look& look) const {
    const Picture picture(lagoon_.window());
    lagoon_.run(lagoon_.plan(look), picture.target, *make_executor(2));
    return lagoon_.error_of(picture.color());
  }
  const Lagoon lagoon_{LIMPID_DATA "/plates/lagoon"};
};

TEST_F(LagoonTest, MostOfTheBottomIsInTheFrame) {
  EXPECT_GT(lagoon_.in_frame_share(), 0.7);
  EXPECT_LT(lagoon_.in_frame_share(), 0.85);  // else rays that leave the frame would not be counted
}

TEST_F(LagoonTest, MarchedWaterIsNearTheTruth) {
  EXPECT_LT(error_of(Lagoon::truth_look()).wet, 0.08);
  EXPECT_LT(error_of(Lagoon::truth_look()).in_frame, 0.027);
  EXPECT_GT(lagoon_.error_of(lagoon_.dry()).wet, 0.5);
}

TEST_F(LagoonTest, EveryReadingOfTheDepthGetsNearer) {
  Look look = Lagoon::truth_look();
  look.of<Refraction>().model = Refraction::Model::kNormalOffset;
  double last = error_of(look).in_frame;
  look.of<Refraction>().model = Refraction::Model::kSnell;
  for (const int steps : {0, 1, 2, 4, Refraction::kMarch}) {
    look.of<Refraction>().steps = steps;
    const double error = error_of(look).in_frame;
    EXPECT_LT(error, 0.9 * last) << "steps " << steps;
    last = error;
  }
}

}  // namespace
}  // namespace limpid::test
