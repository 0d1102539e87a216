#include "plate/layer_views.h"

#include <algorithm>
#include <iterator>

namespace limpid {
namespace {

void add_view(std::vector<std::string>& views, const std::string& view) {
  const auto same = [&](const std::string& other) { return is_same_view(other, view); };
  if (!view.empty() && std::none_of(views.begin(), views.end(), same)) views.push_back(view);
}

/// A layer "left wall" names no view.
bool tells_view(const LayerGroup& group) { return !group.named || is_known(group); }

}  // namespace

bool is_same_view(const std::string& a, const std::string& b) {
  return lower_case(a) == lower_case(b);
}

std::vector<std::string> views_of(const std::vector<LayerGroup>& groups) {
  std::vector<std::string> views;
  for (const LayerGroup& group : groups) {
    for (const std::string& view : group.source->views) add_view(views, view);
    add_view(views, group.source->view);
  }
  for (const LayerGroup& group : groups) {
    if (tells_view(group)) add_view(views, group.view);
  }
  return views;
}

std::string default_view(const std::vector<LayerGroup>& groups) {
  const std::vector<std::string> views = views_of(groups);
  if (views.empty()) return "";
  for (const LayerGroup& group : groups) {
    if (!group.source->views.empty()) return group.source->views.front();
  }
  std::vector<Candidate> colors;
  for (LayerRank rank : kFoundRanks) {
    const std::vector<Candidate> more = candidates_of(rank, role_named("color"), groups);
    colors.insert(colors.end(), more.begin(), more.end());
  }
  if (colors.empty()) return views.front();
  if (!of_view(colors, "").empty()) return "";
  // The groups are in the order of the file.
  return std::min_element(colors.begin(), colors.end(),
                          [](const Candidate& a, const Candidate& b) { return a.group < b.group; })
      ->group->view;
}

std::vector<Candidate> of_view(const std::vector<Candidate>& candidates, const std::string& view) {
  std::vector<Candidate> chosen;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(chosen),
               [&](const Candidate& c) { return is_same_view(c.group->view, view); });
  return chosen;
}

std::vector<std::string> views_of(std::span<const LayerSource> sources) {
  return views_of(group_layers(sources));
}

std::string default_view(std::span<const LayerSource> sources) {
  return default_view(group_layers(sources));
}

}  // namespace limpid
