#pragma once
#include <array>

#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/core/texture_levels.h"

namespace limpid::bench {

/// A synthetic plate of any size for timing: a camera over a bay, about 60 % of the pixels wet,
/// rocks that come through the surface, cast shadows, a mirrored sky; a tiling normal map of 512 x
/// 512 texels with the values of a PNG, and no normals of its own. Smooth where real plates are
/// smooth, with hard edges where they have edges.
struct MadePlate {
  explicit MadePlate(Size size);

  Frame frame;
  Scene scene;

  double wet_share() const;

 private:
  void make_map();

  std::array<Plane, kPlaneCount> planes_;
  std::array<Plane, 3> map_;
  std::vector<std::uint32_t> map_bytes_;
  LevelMaker map_levels_;
};

}  // namespace limpid::bench
