#include "limpid/plate/layers.h"

#include "plate/layer_candidates.h"
#include "plate/layer_views.h"

namespace limpid {
namespace {

/// Views in the order in which a role is searched in them; the empty name is layers without a view.
std::vector<std::string> order_of_views(const std::vector<LayerGroup>& groups,
                                        const std::string& asked) {
  std::vector<std::string> order{asked.empty() ? default_view(groups) : asked};
  if (!order.front().empty()) {
    order.push_back("");
  } else {
    for (const std::string& view : views_of(groups)) order.push_back(view);
  }
  return order;
}

std::string reason_of(const Candidate& candidate) {
  const LayerGroup& group = *candidate.group;
  const std::string programs = " (" + std::string(candidate.rule->programs) + ")";
  if (candidate.rule->rank == LayerRank::kFileName) return "the file's name";
  if (candidate.rule->rank == LayerRank::kBare) return "channels without a layer" + programs;
  if (!group.path.empty()) return "layer '" + group.path + "'" + programs;
  if (!group.source->part_name.empty()) return "part '" + group.source->part_name + "'" + programs;
  return "channel '" + candidate.channels[0] + "'" + programs;
}

}  // namespace

std::vector<LayerSource> layer_sources(int file, const std::string& file_name,
                                       std::span<const ExrPart> parts) {
  std::vector<LayerSource> sources;
  for (const ExrPart& part : parts) {
    LayerSource source{file, static_cast<int>(sources.size()), file_name, part.name, part.view, {}};
    source.views = part.views;
    source.deep = part.deep;
    for (const ExrChannel& channel : part.channels) source.channels.push_back(channel.name);
    sources.push_back(std::move(source));
  }
  return sources;
}

std::optional<LayerChoice> find_layer(const Role& role, std::span<const LayerSource> sources,
                                      const std::string& view) {
  const std::vector<LayerGroup> groups = group_layers(sources);
  std::vector<std::vector<Candidate>> found;  // strongest first
  for (LayerRank rank : kFoundRanks) found.push_back(candidates_of(rank, role, groups));
  for (const std::string& searched : order_of_views(groups, view)) {
    for (const std::vector<Candidate>& all : found) {
      const std::vector<Candidate> candidates = of_view(all, searched);
      if (const Candidate* one = only_one(role, std::string(role.name), candidates, sources)) {
        return choice_of(role, *one, reason_of(*one));
      }
    }
  }
  return std::nullopt;
}

LayerChoices find_layers(std::span<const LayerSource> sources, const LayerOverrides& decided,
                         const std::string& view) {
  LayerChoices choices;
  for (const Role& role : roles()) {
    if (decided.contains(std::string(role.name))) continue;
    const auto color = choices.find("color");
    const bool of_color = view.empty() && color != choices.end();
    if (auto choice = find_layer(role, sources, of_color ? color->second.view : view)) {
      choices[role.name] = std::move(*choice);
    }
  }
  return choices;
}

}  // namespace limpid
