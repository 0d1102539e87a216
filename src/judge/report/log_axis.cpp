#include "judge/report/log_axis.h"

#include <cmath>

#include "limpid/core/error.h"

#include "judge/report/markup.h"

namespace limpid {
namespace {

struct Step {
  int digit, power;
  double value() const { return digit * std::pow(10.0, power); }
  bool numbered() const { return digit == 1 || digit == 2 || digit == 5; }
};

Step after(Step step) {
  return step.digit == 9 ? Step{1, step.power + 1} : Step{step.digit + 1, step.power};
}

constexpr double kAir = 1.15;  // between the outermost values and the ends, a factor

}  // namespace

LogAxis::LogAxis(double least, double most) {
  if (!(least > 0 && least <= most && std::isfinite(most))) {
    throw Error("axis from " + std::to_string(least) + " to " + std::to_string(most) +
                ": expected finite numbers above 0");
  }
  Step step{1, static_cast<int>(std::floor(std::log10(least / kAir)))};
  for (Step s = step; s.value() <= least / kAir; s = after(s)) {
    if (s.numbered()) step = s;
  }
  std::vector<Step> steps{step};
  while (!(step.numbered() && step.value() >= most * kAir)) steps.push_back(step = after(step));

  const bool few = steps.back().value() < 1000 * steps.front().value();
  for (const Step& s : steps) {
    const bool number = s.digit == 1 || (few && s.numbered());
    ticks_.push_back({s.value(), number ? tick_number(s.digit, s.power) : ""});
  }
}

double LogAxis::place(double value) const {
  return std::log(value / first()) / std::log(last() / first());
}

}  // namespace limpid
