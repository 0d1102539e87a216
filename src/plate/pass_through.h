#pragma once
#include <span>
#include <string>
#include <vector>

#include "limpid/plate/plate.h"

#include "plate/plate_file.h"

namespace limpid {

/// The layers to choose from, and the roles.
struct PassingPlate {
  std::span<const PlateFile> files;
  std::vector<LayerSource> sources;  ///< of the files that are searched
  const LayerChoices& roles;         ///< `color` among them
};

/// As Plate::passed().
std::vector<PassedPart> passed_parts(const PassingPlate& plate,
                                     const std::vector<std::string>& names);

/// As Plate::other_layers().
std::vector<std::string> other_layers(const PassingPlate& plate);

}  // namespace limpid
