#pragma once
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/core/scene.h"

namespace limpid::bench {

/// A made-up plate of any size for timing: a camera over a bay, about 60 % of the pixels wet, rocks
/// that come through the surface, wavy normals, cast shadows. Smooth where real plates are smooth,
/// with hard edges where they have edges.
struct MadePlate {
  explicit MadePlate(Size size);

  Frame frame;
  Scene scene;

 private:
  std::vector<Plane> planes_;
};

}  // namespace limpid::bench
