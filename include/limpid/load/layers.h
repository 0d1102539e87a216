#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/core/frame.h"

namespace limpid {

/// A channel that could feed a plane: which of the opened files, which part, and its full name.
struct ChannelRef {
  int file = 0, part = 0;
  std::string name;
  friend bool operator==(const ChannelRef&, const ChannelRef&) = default;
};

/// One part of one opened file, as far as names matter.
struct LayerSource {
  int file = 0, part = 0;
  std::string file_name;  ///< without folders, for texts and as the last hint ("dry_depth.exr")
  std::string part_name;
  std::string view;
  std::vector<std::string> channels;
};

/// Where a role's planes come from and why.
struct LayerChoice {
  std::vector<ChannelRef>
      channels;        ///< one per plane of the role; a one-channel picture feeds all of color
  std::string reason;  ///< one phrase, for `inspect`, e.g. "layer 'Depth' of ViewLayer, channel Z"
};

/// What the user said: role name -> "FILE:CHANNELS", "FILE" or "CHANNELS" (the text after
/// `depth=`).
using LayerOverrides = std::map<std::string, std::string>;

/// What was found for each role. Roles that nothing feeds are absent.
using LayerChoices = std::map<std::string_view, LayerChoice>;

/// Finds the channels of each role by the conventions of Blender, Nuke, Natron, Arnold, Karma,
/// V-Ray, and our own plates. Throws Error that lists the candidates when two fit a role equally
/// well, and names the flag
/// (`--layer depth=ViewLayer.Depth.Z`) that decides.
LayerChoices find_layers(std::span<const LayerSource> sources);

/// The channels meant by an override's channel part, e.g. "ViewLayer.Depth.Z", "depth" (a layer),
/// "R,G,B". Throws Error that lists what there is, with the nearest name, when it fits nothing.
LayerChoice choose_layer(const Role& role, std::string_view channels,
                         std::span<const LayerSource> sources);

}  // namespace limpid
