#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "limpid/run/target.h"

namespace limpid {

/// The conventions for names of channels of a picture and its AOVs in a file, by host.
enum class AovNames {
  kLimpid,   ///< R G B A, transmitted.R, fresnel.Y, stmap.g.U
  kNuke,     ///< R G B A, transmitted.red, fresnel.red, stmap_g.u, as Nuke's Write names them
  kBlender,  ///< ViewLayer.Combined.R, ViewLayer.transmitted.R, ViewLayer.stmap_g.U V A
  kArnold,   ///< R G B A, transmitted.R, fresnel, stmap_g.X: flat names, one number has no suffix
};

/// The name of the convention: "limpid", "nuke", "blender", "arnold".
std::string_view aov_names_name(AovNames names);
/// Throws Error of Fault::kUsage with the nearest name.
AovNames aov_names_named(std::string_view name);

/// A channel in a file.
struct AovChannel {
  std::string name;
  /// Index of the AOV's plane; -1: the channel is 1 everywhere, for hosts that require an alpha of
  /// a map.
  int plane;
};

/// The host's name of a layer, such as "ViewLayer.stmap_g" for "stmap.g".
std::string aov_layer(std::string_view layer, AovNames names);

/// The channels of an AOV, in the order of its planes.
std::vector<AovChannel> aov_channels(Aov aov, AovNames names = AovNames::kLimpid);

/// The names of the picture's R, G, B and A.
std::vector<std::string> picture_channels(AovNames names = AovNames::kLimpid);

}  // namespace limpid
