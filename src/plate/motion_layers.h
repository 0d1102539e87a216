#pragma once
#include <string>
#include <vector>

#include "limpid/plate/plate.h"

namespace limpid {

/// The layers of motion vectors among these, of the view or of no view, by the conventions of
/// Blender (Vector: X Y to the previous frame, Z W to the next), Arnold (motionvector) and Nuke
/// (forward, backward). `named` is the user's choice, or "". Throws Error if there is none.
std::vector<MotionLayer> find_motion_layers(const std::vector<LayerSource>& sources,
                                            const std::string& view, const std::string& named);

}  // namespace limpid
