#pragma once
#include <cstdint>
#include <vector>

#include "raster/raster_job.h"

namespace limpid::raster {

/// The pieces that clipping adds to a group. Corner numbers in `triangles` count from the first of
/// `corners`. Boxes are in pixels, as in Survivors.
struct ClippedPieces {
  struct Piece {
    Triangle triangle;
    int x0, y0, x1, y1;
  };
  std::vector<Corner> corners;
  std::vector<Attributes> attributes;
  std::vector<MoreAttributes> more;  ///< one per corner for a mesh that has them, or none
  std::vector<Piece> pieces;
  void clear();
};

/// Clips one triangle in homogeneous space, in double, and adds the pieces that may be visible. An
/// edge of two triangles is cut at the same point in both. `corners`: those of the vertex stage.
void clip(const DrawnInstance& instance, const Screen& screen, const Corner* corners,
          std::uint32_t triangle, ClippedPieces& out);

}  // namespace limpid::raster
