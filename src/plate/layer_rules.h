#pragma once
#include <span>
#include <string_view>

namespace limpid {

/// Strength of a match, strongest first.
enum class LayerRank {
  kOwn,       ///< the whole layer path is one of limpid's own names
  kLayer,     ///< the last word of a layer's path, or of a part's name, is a known one
  kFileName,  ///< a file of one kind of channel whose name has the words
  kBare,      ///< channels without any layer
  kPart,      ///< R G B without a layer, in a part of an unknown name
  kGiven,     ///< only in a file that the user named for the role
};

/// One naming convention. `layer` and `channels` hold alternatives separated by '|', in order of
/// preference.
struct LayerRule {
  LayerRank rank;
  std::string_view role;      ///< "": a known layer without a role
  std::string_view layer;     ///< in lower-case words; "water" also matches "surface"
  std::string_view channels;  ///< one per plane; "*" = the only channel of the layer
  std::string_view programs;  ///< that use it
};

std::span<const LayerRule> layer_rules();

}  // namespace limpid
