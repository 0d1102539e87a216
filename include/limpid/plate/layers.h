#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/files/exr/exr_file.h"

namespace limpid {

/// A channel that could feed a plane: the indices of its file and part, and its full name.
struct ChannelRef {
  int file = 0, part = 0;
  std::string name;
  friend bool operator==(const ChannelRef&, const ChannelRef&) = default;
};

/// The names in one part of an opened file.
struct LayerSource {
  int file = 0, part = 0;
  std::string file_name;  ///< without folders, for messages and as the last hint ("dry_depth.exr")
  std::string part_name;
  std::string view;
  std::vector<std::string> channels;
  std::vector<std::string> views = {};  ///< of a part with several views, see ExrPart::views
  bool deep = false;
};

/// The source of a role's planes, and the reason.
struct LayerChoice {
  /// One channel per plane of the role, in the role's order. Color without alpha has three. A
  /// picture with one channel feeds R, G and B: its channel is listed three times.
  std::vector<ChannelRef> channels;
  std::string reason;     ///< one phrase, for `inspect`, e.g. "layer 'ViewLayer.Depth' (Blender)"
  std::string view = {};  ///< of the channels; "" if their names have no view
};

/// The user's choices: role name -> "FILE:CHANNELS", "FILE" or "CHANNELS" (the text after
/// `depth=`).
using LayerOverrides = std::map<std::string, std::string>;

/// The source found for each role. Roles without a source are absent.
using LayerChoices = std::map<std::string_view, LayerChoice>;

/// The sources of an opened EXR file, one per part.
std::vector<LayerSource> layer_sources(int file, const std::string& file_name,
                                       std::span<const ExrPart> parts);

/// The views of stereo plates, each once: first those of the attributes `multiView` and `view`,
/// then those in the names of parts and layers ("rgba_left", "right.R"), which are left and right
/// only. Channels without a view are those of the default view if the attribute `multiView` gives
/// one; else they belong to all views.
std::vector<std::string> views_of(std::span<const LayerSource> sources);

/// The default view: the first that `multiView` lists; else that of the color, "" if a color has
/// none; with several colors that of the first one.
std::string default_view(std::span<const LayerSource> sources);

/// Finds the channels of a role by the conventions of Blender, Nuke, Natron, Arnold, Karma, V-Ray,
/// and of limpid's plates (src/plate/layer_rules.cpp lists them). limpid's names take precedence
/// over layers and parts with a known name, these over files with a known name, these over channels
/// without a layer. Letter case is ignored. Layers of the water never feed a role of the dry scene,
/// and vice versa. If there are several views, the channels of `view` are used, or those without a
/// view if that view has none for the role; "" is default_view(). Of equally good flat and deep
/// samples the flat ones are used. Empty if no channel fits. Throws Error if two candidates fit
/// equally well; its message lists them and the option that decides (`--layer
/// depth=ViewLayer.Depth.Z`).
std::optional<LayerChoice> find_layer(const Role& role, std::span<const LayerSource> sources,
                                      const std::string& view = "");

/// find_layer() for every role that is not in `decided`, in one view: `view`, or the view of the
/// color.
LayerChoices find_layers(std::span<const LayerSource> sources, const LayerOverrides& decided = {},
                         const std::string& view = "");

/// The channels that the part CHANNELS of an override names: a full channel name
/// ("ViewLayer.Depth.Z"), a list ("R,G,B"), a layer or part ("ViewLayer.Depth", "depth"), or "" for
/// the channels of these sources that fit the role best; a file that is named for a role of the
/// water may use the names of a dry scene. A channel or layer may have its part's name in front
/// ("rgba.left.R"). The beginning of a name ("Depth.Z") and its letter case may be left out if the
/// name stays unique; of a name in several views the channel of `view` is used, "" as in
/// find_layer(). Throws Error with the known names and the nearest one if no channel has the name,
/// and Error with the expected number of channels if their number is wrong.
LayerChoice choose_layer(const Role& role, std::string_view channels,
                         std::span<const LayerSource> sources, const std::string& view = "");

}  // namespace limpid
