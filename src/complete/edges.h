#pragma once
#include <memory>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"

#include "op/pass.h"

namespace limpid {

/// Separates pixels that show both water and an object in front of it, as at edges blurred by a
/// filter, motion or a lens: the covering part goes into Frame::edges, and color and depth become
/// those of the scene behind. Pixels without water behind stay unchanged, and so do all pixels of
/// views that may begin in the water.
///
/// Deep samples give the parts exactly (Frame::foreground, with the layer below the water behind
/// it). Without them the parts are estimated. An edge is a dry surface in front of a wet one: the
/// steps of color across such edges, at growing distances, give the width of the blur in each part
/// of the picture. Where there is no blur, nothing changes. In the band of the blur, the share of a
/// pixel is the place of its color between those of the two sides beyond the band, along Fisher's
/// discriminant (1936, "The Use of Multiple Measurements in Taxonomic Problems"), which ignores
/// their texture; for an object thinner than the band, by the regression of the sides that depth
/// gives on color, because renderers take depth from one sample of many. Objects thinner than a
/// pixel do not show the blur; there the blur of the picture's other edges counts, and in single
/// dry pixels of the water's color the object has no share. Where behind the water nothing was hit
/// and alpha is 0 around, the alpha of the pixel is its share. Where colors do not distinguish the
/// two sides, depth alone decides.
class Edges {
 public:
  /// Widest blur from the middle of an edge, in pixels; beyond it an edge stays hard.
  static constexpr int kFarthest = 31;

  Edges();
  ~Edges();
  Edges(Edges&&) noexcept;
  Edges& operator=(Edges&&) noexcept;

  /// Replaces color and depth by own planes and sets Frame::edges, if there are such pixels; valid
  /// until the next call. `pass` is that of the frame. Keeps its memory.
  void make(Frame& frame, const Pass& pass, Executor& executor);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limpid
