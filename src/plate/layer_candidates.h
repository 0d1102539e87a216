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
  const LayerRule* rule = nullptr;  ///< null if the user named them
};

/// The ranks of layers found without being named, strongest first.
inline constexpr LayerRank kFoundRanks[] = {
    LayerRank::kOwn, LayerRank::kLayer, LayerRank::kFileName, LayerRank::kBare, LayerRank::kPart};

/// The candidates by the rules of one rank; at most one per layer.
std::vector<Candidate> candidates_of(LayerRank rank, const Role& role,
                                     const std::vector<LayerGroup>& groups);

/// The only candidate, or the only one with flat pixels; null if there is none. Throws Error that
/// begins with `subject` and lists the candidates if there are several.
const Candidate* only_one(const Role& role, const std::string& subject,
                          const std::vector<Candidate>& candidates,
                          std::span<const LayerSource> sources);

/// All layers with their channels, as in "ViewLayer.Combined (R G B A), ViewLayer.Depth (Z)".
std::string layer_list(const std::vector<LayerGroup>& groups, std::span<const LayerSource> sources);

bool is_picture(const Role& role);

/// A single channel fills all three planes of a color.
LayerChoice choice_of(const Role& role, const Candidate& candidate, std::string reason);

}  // namespace limpid
