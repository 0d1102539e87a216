#pragma once
#include <span>
#include <string_view>

#include "limpid/core/frame.h"

namespace limpid {

/// Something that can be made, once a frame, of planes that are there: complete/ has how.
struct CompleterInfo {
  std::string_view name;
  PlaneSet inputs;  ///< without all of these it is not made
  PlaneSet makes;   ///< those of them that an operator asks for and the frame lacks
  PlaneSet mends;   ///< and these where it has them, too: they stay where they tell something
  PlaneSet helped;  ///< by these, where they are there
  std::string_view about;
};

/// In the order in which they run.
std::span<const CompleterInfo> completers();

}  // namespace limpid
