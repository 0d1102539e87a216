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
  std::vector<std::string> views = {};  ///< of a part that holds several, see ExrPart::views
  bool deep = false;
};

/// The source of a role's planes, and the reason.
struct LayerChoice {
  /// One per plane of the role, in the role's order. Color without alpha has three. A picture of
  /// one channel feeds all three of R G B: its channel is there three times.
  std::vector<ChannelRef> channels;
  std::string reason;     ///< one phrase, for `inspect`, e.g. "layer 'ViewLayer.Depth' (Blender)"
  std::string view = {};  ///< that the channels belong to; "" where they name none
};

/// The user's choices: role name -> "FILE:CHANNELS", "FILE" or "CHANNELS" (the text after
/// `depth=`).
using LayerOverrides = std::map<std::string, std::string>;

/// The source found for each role. Roles without a source are absent.
using LayerChoices = std::map<std::string_view, LayerChoice>;

/// The sources of an opened EXR file, one a part.
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
/// and of limpid's plates (src/plate/layer_rules.cpp lists them). limpid's names win over layers
/// and parts with a known name, those over files with a telling name, those over bare channels.
/// Letter case does not matter. Layers of the water never feed a role of the dry scene, and vice
/// versa. With several views it is `view`, and channels without a view if that view has none for
/// the role; "" is default_view(). Between equally good flat and deep samples it takes the flat
/// ones. Empty when nothing fits. Throws Error that lists the candidates when two fit equally well,
/// and names the flag (`--layer depth=ViewLayer.Depth.Z`) that decides.
std::optional<LayerChoice> find_layer(const Role& role, std::span<const LayerSource> sources,
                                      const std::string& view = "");

/// find_layer() for every role but those that the user has decided, of one view: `view`, or that of
/// the color.
LayerChoices find_layers(std::span<const LayerSource> sources, const LayerOverrides& decided = {},
                         const std::string& view = "");

/// The channels meant by an override's channel part: a full channel name ("ViewLayer.Depth.Z"), a
/// list ("R,G,B"), a layer or part ("ViewLayer.Depth", "depth"), or "" for what of these sources
/// fits the role best, where a file given for the water may use the names of a dry scene. A
/// channel or layer may have its part's name in front ("rgba.left.R"). A name may leave out its
/// beginning ("Depth.Z") and its letter case while it stays clear; a name that several views have
/// means that of `view`, "" as in find_layer(). Throws Error that lists what there is, with the
/// nearest name, when it fits nothing, and one that says how many channels the role needs when
/// their number is wrong.
LayerChoice choose_layer(const Role& role, std::string_view channels,
                         std::span<const LayerSource> sources, const std::string& view = "");

}  // namespace limpid
