#pragma once
#include <string>

namespace limpid {

/// Where water makes one look beyond the picture: with the normals that the frame has, else calm.
struct Beyond {
  double share = 0;  ///< of the wet pixels
  /// Pixels of overscan, from the sides of the display window, that would show it; 0 on a side at
  /// which the planes go far enough.
  int left = 0, top = 0, right = 0, bottom = 0;

  bool any() const { return left > 0 || top > 0 || right > 0 || bottom > 0; }
};

/// "5.8 % of the wet pixels look beyond the picture; overscan of color and depth by 4 pixels on the
/// left, 2 on the right, 0 at the top and 24 at the bottom would show what is there", or that none
/// does.
std::string to_text(const Beyond& beyond);

}  // namespace limpid
