#pragma once
#include <array>
#include <map>
#include <optional>
#include <string>

#include "limpid/core/camera.h"
#include "limpid/files/exr/exr_file.h"

/// @file
/// Cameras as the standard attributes `worldToCamera` and `worldToNDC` of EXR files (OpenEXR
/// "Standard Optional Attributes": row vectors, left-handed camera space looking down +Z; NDC
/// 0 ... 1 with y down over the display window).

namespace limpid {

/// The camera in these attributes of a part, or nothing if one of them is absent. They have no near
/// and far: clip depth is GL with near 0.001 and infinite far. Throws Error if the two contradict
/// each other.
std::optional<Camera> camera_of(const ExrFile& file, int part);

/// The attributes, by name, from which camera_of() makes this camera again, except near and far.
std::map<std::string, std::array<float, 16>> camera_attributes(const Camera& camera);

}  // namespace limpid
