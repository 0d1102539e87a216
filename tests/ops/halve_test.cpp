#include "op/halve.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace limpid {
namespace {

/// A number that looks ahead.
struct Ahead {
  double v;
  Ahead() = default;
  explicit Ahead(double x) : v(x) {}
  friend Ahead operator+(Ahead a, Ahead b) { return Ahead(a.v + b.v); }
  friend Ahead operator*(Ahead a, Ahead b) { return Ahead(a.v * b.v); }
  friend Ahead select(bool m, Ahead yes, Ahead no) { return m ? yes : no; }
};

}  // namespace

template <>
inline constexpr bool kLooksAhead<Ahead> = true;

namespace {

TEST(Halve, FindsWhereItBegins) {
  int looks = 0;
  const Bracket<double> at = halve<double>({0, 1}, 6, [&](double t) {
    ++looks;
    return t >= 0.3;
  });
  EXPECT_EQ(looks, 6);
  EXPECT_EQ(at.low, 19.0 / 64);
  EXPECT_EQ(at.high, 20.0 / 64);
}

// Also for a condition that begins to hold more than once, and after an odd number of halvings.
TEST(Halve, ComesToTheSameWhenItLooksAhead) {
  for (int seed = 0; seed < 200; ++seed) {
    const auto holds = [&](double t) { return std::sin(37 * t + seed) > 0; };
    for (int times = 0; times < 7; ++times) {
      const Bracket<double> one = halve<double>({0.1, 0.9}, times, holds);
      std::vector<double> looks;
      const Bracket<Ahead> both = halve<Ahead>({Ahead(0.1), Ahead(0.9)}, times, [&](Ahead t) {
        looks.push_back(t.v);
        return holds(t.v);
      });
      EXPECT_EQ(one.low, both.low.v) << seed << " " << times;
      EXPECT_EQ(one.high, both.high.v) << seed << " " << times;
      EXPECT_EQ(looks.size(), 3 * std::size_t(times / 2) + std::size_t(times % 2));
    }
  }
}

}  // namespace
}  // namespace limpid
