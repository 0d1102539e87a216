#pragma once
#include <span>
#include <string_view>

#include "limpid/core/frame.h"

namespace limpid {

/// A plane that is computed once per frame from other planes, by complete/.
struct CompleterInfo {
  std::string_view name;
  PlaneSet inputs;           ///< all of them are required
  PlaneSet makes;            ///< those of them that an operator asks for and the frame lacks
  PlaneSet corrects;         ///< and corrects these if the frame has them
  PlaneSet optional_inputs;  ///< by these, if the frame has them
  std::string_view about;
};

/// In the order in which they run.
std::span<const CompleterInfo> completers();

}  // namespace limpid
