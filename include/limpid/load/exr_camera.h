#pragma once
#include <optional>

#include "limpid/core/camera.h"
#include "limpid/load/exr_file.h"

namespace limpid {

/// The camera that an EXR part's standard attributes `worldToCamera` and `worldToNDC` describe
/// (OpenEXR "Standard Optional Attributes": row vectors, left-handed camera space looking down +Z;
/// NDC 0 ... 1 with y down over the display window), or nothing when one of them is absent. They do
/// not say near and far: clip depth is GL with near 0.001 and infinite far. Throws Error when the
/// two contradict each other.
std::optional<Camera> camera_of(const ExrFile& file, int part);

}  // namespace limpid
