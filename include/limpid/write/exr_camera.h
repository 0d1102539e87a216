#pragma once
#include <array>
#include <map>
#include <string>

#include "limpid/core/camera.h"

namespace limpid {

/// The camera as the standard attributes `worldToCamera` and `worldToNDC` that load/exr_camera.h
/// reads.
std::map<std::string, std::array<float, 16>> camera_attributes(const Camera& camera);

}  // namespace limpid
