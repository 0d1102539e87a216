#pragma once
#include <span>
#include <string_view>

#include "limpid/core/frame.h"

namespace limpid {

/// A step that computes planes once per frame from other planes, in complete/.
struct CompleterInfo {
  std::string_view name;
  PlaneSet inputs;           ///< all of them are required
  PlaneSet makes;            ///< made if an operator reads them and the frame lacks them
  PlaneSet corrects;         ///< corrected if the frame has them
  PlaneSet optional_inputs;  ///< read if the frame has them
  std::string_view about;
};

/// All completers, in the order in which they run.
std::span<const CompleterInfo> completers();

}  // namespace limpid
