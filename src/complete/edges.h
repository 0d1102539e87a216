#pragma once
#include <memory>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"

#include "op/pass.h"

namespace limpid {

/// Parts pixels that show water and something before it, as at edges that a filter, motion or a
/// lens has blurred: what covers the pixel goes into Frame::edges, and color and depth become those
/// of what is behind. What is not wet behind stays as it is, and so do all pixels of views that may
/// begin in the water.
///
/// Deep samples tell it (Frame::foreground, with the layer below the water behind it). Where
/// there are none it is estimated. An edge is where something dry stands before something wet: the
/// steps of color across such edges, at growing distances, say in each part of the picture how far
/// they are blurred. Where they are not, nothing is touched. In the band that is left the share of
/// a pixel is where its color lies between those of the two sides beyond the band, along Fisher's
/// discriminant (1936, "The Use of Multiple Measurements in Taxonomic Problems"), so that their
/// texture does not count; what is thinner than the band, by the regression of the sides that depth
/// tells on color, for renderers draw depth at one sample of many. Where behind the water nothing
/// was hit and alpha is 0 around, the alpha of the pixel is its share. Where colors do not tell the
/// two sides apart, depth alone does.
class Edges {
 public:
  /// How far from its middle an edge may be blurred, in pixels; beyond it stays hard.
  static constexpr int kFarthest = 31;

  Edges();
  ~Edges();
  Edges(Edges&&) noexcept;
  Edges& operator=(Edges&&) noexcept;

  /// Puts planes of its own in place of color and depth and sets Frame::edges, where there are such
  /// pixels; these hold until the next call. `context` is that of the frame. Keeps its memory.
  void make(Frame& frame, const Pass& pass, Executor& executor);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limpid
