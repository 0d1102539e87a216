#include "judge/report/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid {

std::vector<std::size_t> pareto_front(std::span<const Costs> choices) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (std::isfinite(choices[i].time) && std::isfinite(choices[i].error)) order.push_back(i);
  }
  const auto before = [&](std::size_t a, std::size_t b) {
    if (choices[a].time != choices[b].time) return choices[a].time < choices[b].time;
    return choices[a].error < choices[b].error;
  };
  std::stable_sort(order.begin(), order.end(), before);

  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i : order) {
    const bool same = !front.empty() && choices[i].time == choices[front.back()].time &&
                      choices[i].error == choices[front.back()].error;
    if (choices[i].error >= least && !same) continue;
    least = choices[i].error;
    front.push_back(i);
  }
  return front;
}

}  // namespace limpid
