#pragma once
#include <span>
#include <string>
#include <vector>

#include "limpid/plate/layers.h"

#include "plate/layer_names.h"

namespace limpid {

/// Channels of one layer that may feed a role.
struct Candidate {
  const LayerGroup* group = nullptr;
  std::vector<std::string> channels;
  const LayerRule* rule = nullptr;  ///< null where the user named them
};

/// The ranks of what is found without being named, strongest first.
inline constexpr LayerRank kFoundRanks[] = {
    LayerRank::kOwn, LayerRank::kLayer, LayerRank::kFileName, LayerRank::kBare, LayerRank::kPart};

/// What the rules of one rank find; at most one candidate a layer.
std::vector<Candidate> candidates_of(LayerRank rank, const Role& role,
                                     const std::vector<LayerGroup>& groups);

/// The one candidate, or the only one of flat pixels; null where there is none. Throws Error that
/// begins with `subject` and lists them where there are several.
const Candidate* only_one(const Role& role, const std::string& subject,
                          const std::vector<Candidate>& candidates,
                          std::span<const LayerSource> sources);

/// All layers with their channels, as in "ViewLayer.Combined (R G B A), ViewLayer.Depth (Z)".
std::string layer_list(const std::vector<LayerGroup>& groups, std::span<const LayerSource> sources);

bool is_picture(const Role& role);

/// A picture of one channel is spread to three.
LayerChoice choice_of(const Role& role, const Candidate& candidate, std::string reason);

}  // namespace limpid
