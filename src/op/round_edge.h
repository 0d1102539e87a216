#pragma once
#include <algorithm>

#include "limpid/core/number.h"
#include "limpid/core/vec.h"

#include "op/pass.h"

namespace limpid {

/// The place of `uv` around a picture, 0 ... 1: from its upper left corner to the right, down, to
/// the left and up, a quarter for each side; of the side that is nearest. `name` is that of the
/// picture's size in a recording.
template <class F>
LIMPID_INLINE F round_edge(const Bounds& b, Vec2<F> uv, const char* name) {
  const F x =
      saturate((uv.x - given<F>(b.low.x)) / given<F>(std::max(b.high.x - b.low.x, 1e-9), name, 0));
  const F y =
      saturate((uv.y - given<F>(b.low.y)) / given<F>(std::max(b.high.y - b.low.y, 1e-9), name, 1));
  const F left = x, right = F(1) - x, top = y, bottom = F(1) - y;
  const F beside = select(left < right, F(0.75) + F(0.25) * bottom, F(0.25) + F(0.25) * top);
  const F over = select(top < bottom, F(0.25) * left, F(0.5) + F(0.25) * right);
  return select(min(left, right) < min(top, bottom), beside, over);
}

}  // namespace limpid
