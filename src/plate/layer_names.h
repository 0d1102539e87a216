#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/plate/layers.h"

#include "plate/layer_rules.h"

namespace limpid {

/// "ViewLayer.Depth.Z" -> layer "ViewLayer.Depth", component "Z": split at the last dot, since
/// layer names are free text. A loose channel has the layer "".
struct ChannelName {
  std::string layer, component;
};
ChannelName split_channel(std::string_view name);

/// The normalised name of a component: "r" for r, R, red, Red; otherwise the name in lower case.
std::string plain_component(std::string_view component);

/// Sorts components in the usual order, R G B A X Y Z, then the others in their old order.
void sort_components(std::vector<std::string>& components);

std::string lower_case(std::string_view text);

/// Words in lower case, split at punctuation, before digits and at "aB": "shotWater_depth0001" ->
/// shot water depth 0001.
std::vector<std::string> words_of(std::string_view text);

/// The parts of a text between separators, without blanks around them.
std::vector<std::string_view> split(std::string_view text, std::string_view separators);

/// The channels of one layer in one part. A loose channel whose name is no component
/// ("shadow_matte") is a layer of its own.
struct LayerGroup {
  const LayerSource* source = nullptr;
  std::string path;                      ///< the layer as in the file, "" for loose channels
  std::vector<std::string> channels;     ///< full names, in the file's order
  std::string view;                      ///< as views_of() spells it, or ""
  std::string topic;                     ///< words of the name's last part, without "water"
  bool named = false;                    ///< whether path, part or channel name a layer
  bool water = false;                    ///< whether any name assigns it to the water
  const LayerRule* file_rule = nullptr;  ///< the rule that the file's name gives the channels
};

/// `sources` must outlive the groups.
std::vector<LayerGroup> group_layers(std::span<const LayerSource> sources);

/// How well a name must match the user's text; tried in this order.
enum class Agreement { kExact, kLetterCase, kEnding };
inline constexpr Agreement kAgreements[] = {Agreement::kExact, Agreement::kLetterCase,
                                            Agreement::kEnding};
bool agrees(Agreement agreement, const std::string& name, std::string_view typed);

/// The name with its part's name in front, or "" if the part has none.
std::string with_part(const LayerGroup& group, const std::string& name);

/// Whether a rule knows the layer's name, for the role or any role.
bool is_known(const LayerGroup& group, std::string_view role = "");

/// The channels that the rule picks from the layer, or none if it does not fit.
std::vector<std::string> match(const LayerRule& rule, const LayerGroup& group);

}  // namespace limpid
