#pragma once
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/texture_levels.h"

namespace limpid {

/// The sum of the slopes of WaveNormals::slopes for a map at one time: the mean of four lookups
/// that have drifted apart is itself a map that repeats. With second moments, so that their mean in
/// a pixel and their covariance there are one lookup (Olano & Baker 2010, "LEAN Mapping").
class SlopeMap {
 public:
  /// If the map is larger than TextureLevels::base, the variance within a texel counts as common to
  /// lookups in the same place, and as independent for lookups a texel apart. Allocates no memory
  /// after the first map of a size.
  void make(const TextureLevels& map, const FourShifts& shifts, Executor& executor);

  /// From the last make(), until the next one.
  const SlopeLevels& levels() const { return levels_; }

 private:
  SlopeLevels levels_;
  std::vector<float> moments_;
};

}  // namespace limpid
