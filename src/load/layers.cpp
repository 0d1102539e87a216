#include "limpid/load/layers.h"

#include "load/layer_candidates.h"

namespace limpid {
namespace {

constexpr LayerRank kRanks[] = {LayerRank::kOwn, LayerRank::kLayer, LayerRank::kFileName,
                                LayerRank::kBare};

std::string reason_of(const Candidate& candidate) {
  const LayerGroup& group = *candidate.group;
  const std::string who = " (" + std::string(candidate.rule->who) + ")";
  if (candidate.rule->rank == LayerRank::kFileName) return "the file's name";
  if (candidate.rule->rank == LayerRank::kBare) return "channels without a layer" + who;
  if (!group.path.empty()) return "layer '" + group.path + "'" + who;
  if (!group.source->part_name.empty()) return "part '" + group.source->part_name + "'" + who;
  return "channel '" + candidate.channels[0] + "'" + who;
}

}  // namespace

std::vector<LayerSource> layer_sources(int file, const std::string& file_name,
                                       std::span<const ExrPart> parts) {
  std::vector<LayerSource> sources;
  for (const ExrPart& part : parts) {
    LayerSource source{file, static_cast<int>(sources.size()), file_name, part.name, part.view, {}};
    for (const ExrChannel& channel : part.channels) source.channels.push_back(channel.name);
    sources.push_back(std::move(source));
  }
  return sources;
}

std::optional<LayerChoice> find_layer(const Role& role, std::span<const LayerSource> sources) {
  const std::vector<LayerGroup> groups = group_layers(sources);
  for (LayerRank rank : kRanks) {
    const std::vector<Candidate> candidates = candidates_of(rank, role, groups);
    if (const Candidate* one = only_one(role, std::string(role.name), candidates, sources)) {
      return choice_of(role, *one, reason_of(*one));
    }
  }
  return std::nullopt;
}

LayerChoices find_layers(std::span<const LayerSource> sources, const LayerOverrides& decided) {
  LayerChoices choices;
  for (const Role& role : roles()) {
    if (decided.contains(std::string(role.name))) continue;
    if (std::optional<LayerChoice> choice = find_layer(role, sources)) {
      choices[role.name] = std::move(*choice);
    }
  }
  return choices;
}

}  // namespace limpid
