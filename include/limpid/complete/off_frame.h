#pragma once
#include <string>

namespace limpid {

/// The refracted lookups that leave the picture, with the normals of the frame, or else for calm
/// water.
struct OffFrameLookups {
  double share = 0;  ///< share of the wet pixels with such a lookup, 0 ... 1
  /// Pixels of overscan beyond each side of the display window that would show the ends of these
  /// lookups; 0 on a side with enough overscan in the planes.
  int left = 0, top = 0, right = 0, bottom = 0;

  bool any() const { return left > 0 || top > 0 || right > 0 || bottom > 0; }
};

/// A sentence with the share and the pixels of overscan, or the sentence that no lookup leaves the
/// picture.
std::string to_text(const OffFrameLookups& off_frame);

}  // namespace limpid
