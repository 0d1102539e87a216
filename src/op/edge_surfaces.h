#pragma once
#include "limpid/core/frame.h"

/// @file
/// The surfaces above the water at the edge of the picture, for mirrored rays that leave the
/// picture.

namespace limpid {

/// Means of the surfaces above the water that the picture shows along its edge. Columns run
/// around the picture as in op/round_edge.h. In row r a mean reaches `reach (r / (kRows - 1))^2`
/// pixels to both sides, over corners, too, but over one column at least. Made by complete/ for
/// frames whose dry picture is mirrored.
struct EdgeSurfaces {
  static constexpr int kRows = 16;
  /// Their light times their share.
  Texture colors;
  /// Red: the share of such surfaces. Green: their eye depth times their share, in scene units; a
  /// mean weighted by the depth, because things near the eye hide what is mirrored.
  /// Blue: the share of surfaces and sky above the water.
  Texture shape;
  double reach;
  /// Whether the picture is that of a room: 1 if at least nine tenths of its upper edge are
  /// surfaces and a quarter of it looks down, like a ceiling; 0 if half of the edge or more is
  /// open, or nothing there looks down; in between it changes linearly with both.
  double closed;
};

}  // namespace limpid
