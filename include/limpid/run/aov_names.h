#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "limpid/run/target.h"

namespace limpid {

/// Whose names the channels of a picture and its AOVs have in a file.
enum class AovNames {
  kLimpid,   ///< R G B A, transmitted.R, fresnel.Y, stmap.g.U
  kNuke,     ///< R G B A, transmitted.red, fresnel.red, stmap_g.u: as Nuke's Write has them
  kBlender,  ///< ViewLayer.Combined.R, ViewLayer.transmitted.R, ViewLayer.stmap_g.U V A
  kArnold,   ///< R G B A, transmitted.R, fresnel, stmap_g.X: flat names, one number has no suffix
};

/// "limpid", "nuke", "blender", "arnold".
std::string_view aov_names_name(AovNames names);
/// Throws Error of Fault::kUsage with the nearest name.
AovNames aov_names_named(std::string_view name);

/// A channel in a file.
struct AovChannel {
  std::string name;
  /// Which of the AOV's planes it shows; -1: it is 1 everywhere, for hosts that want a map to have
  /// an alpha.
  int plane;
};

/// A layer of that name, as "stmap.g", as the host has it: "ViewLayer.stmap_g".
std::string aov_layer(std::string_view layer, AovNames names);

/// Those of an AOV, its planes in order.
std::vector<AovChannel> aov_channels(Aov aov, AovNames names = AovNames::kLimpid);

/// The picture's R, G, B and A.
std::vector<std::string> picture_channels(AovNames names = AovNames::kLimpid);

}  // namespace limpid
