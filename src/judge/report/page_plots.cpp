#include "judge/report/page_plots.h"

#include <algorithm>
#include <cmath>

#include "judge/report/html_parts.h"
#include "judge/report/markup.h"

namespace limpid {

std::string about(const std::string& what, double ns_per_pixel, double error) {
  return what + ": " + short_number(ns_per_pixel) + " ns/pixel, error " + short_number(error);
}

std::size_t index_in(std::vector<std::string>& list, const std::string& word) {
  const auto at = std::find(list.begin(), list.end(), word);
  const auto index = static_cast<std::size_t>(at - list.begin());
  if (at == list.end()) list.push_back(word);
  return index;
}

void add_point(Scatter& scatter, ScatterPoint point) {
  if (std::isfinite(point.error)) scatter.points.push_back(std::move(point));
}

std::string drawn(const Scatter& scatter, const std::string& caption) {
  return scatter.points.empty() ? "" : plot_figure(to_svg(scatter), caption);
}

}  // namespace limpid
