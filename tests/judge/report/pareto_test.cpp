#include "judge/report/pareto.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limpid {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::size_t> front(const std::vector<Costs>& choices) { return pareto_front(choices); }

TEST(Pareto, WhatIsBeatenInBothCostsIsNotOnTheFront) {
  EXPECT_THAT(front({{3, 1}, {1, 3}, {2, 2}, {3, 3}, {2.5, 2.5}}), ElementsAre(1, 2, 0));
}

TEST(Pareto, AsGoodInOneCostAndWorseInTheOtherIsBeaten) {
  EXPECT_THAT(front({{1, 2}, {1, 3}}), ElementsAre(0));
  EXPECT_THAT(front({{1, 3}, {1, 2}}), ElementsAre(1));
  EXPECT_THAT(front({{1, 2}, {2, 2}}), ElementsAre(0));
}

TEST(Pareto, EqualChoicesStayTogether) {
  EXPECT_THAT(front({{5, 0}, {1, 2}, {4, 4}, {1, 2}}), ElementsAre(1, 3, 0));
}

TEST(Pareto, OneAndNone) {
  EXPECT_THAT(front({{7, 7}}), ElementsAre(0));
  EXPECT_THAT(front({}), IsEmpty());
}

TEST(Pareto, NanAndInfinityNeverCount) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  EXPECT_THAT(front({{nan, 0}, {0, nan}, {inf, 0}, {0, inf}, {9, 9}}), ElementsAre(4));
}

}  // namespace
}  // namespace limpid
