#pragma once
#include "limpid/core/frame.h"

#include "core/fetch.h"

/// Reading and writing channels in lanes. For inclusion by lanes_target.cpp alone.

namespace limpid::HWY_NAMESPACE {

/// A channel of the frame: index = y * y_stride + x * x_stride from `data`, x and y from the corner
/// of its window.
struct Source {
  const float* data;
  int x_stride, y_stride;
  Rect window;
  float missing;

  LIMPID_LANES_INLINE Source(const View<const float>& view, float value)
      : data(view.data),
        x_stride(static_cast<int>(view.x_stride)),
        y_stride(static_cast<int>(view.y_stride)),
        window(view.window),
        missing(value) {}

  /// Whether both have the same index for each pixel.
  LIMPID_LANES_INLINE bool like(const Source& s) const {
    return data && s.data && x_stride == s.x_stride && y_stride == s.y_stride &&
           window.x0 == s.window.x0 && window.y0 == s.window.y0 && window.x1 == s.window.x1 &&
           window.y1 == s.window.y1;
  }
  LIMPID_LANES_INLINE int width() const { return window.x1 - window.x0; }
  LIMPID_LANES_INLINE int height() const { return window.y1 - window.y0; }

  LIMPID_LANES_INLINE VI index(VI x, VI y) const {
    return hn::Add(hn::Mul(x, hn::Set(kDI, x_stride)), hn::Mul(y, hn::Set(kDI, y_stride)));
  }
  LIMPID_LANES_INLINE Lane gather(VI at) const { return fetch(data, at); }
};

/// `count` floats of a row as one vector; lanes beyond are 0. A full vector is one unaligned load.
LIMPID_LANES_INLINE Lane load_row(const float* from, std::ptrdiff_t x_stride, int count) {
  if (x_stride == 1 && count >= kLanes) return Lane(hn::LoadU(kD, from));
  alignas(64) float buffer[kLanes] = {};
  for (int i = 0; i < count && i < kLanes; ++i) buffer[i] = from[i * x_stride];
  return Lane(hn::Load(kD, buffer));
}

LIMPID_LANES_INLINE void store_row(Lane value, float* to, std::ptrdiff_t x_stride, int count) {
  if (x_stride == 1 && count >= kLanes) {
    hn::StoreU(value.v, kD, to);
    return;
  }
  alignas(64) float buffer[kLanes];
  hn::Store(value.v, kD, buffer);
  for (int i = 0; i < count && i < kLanes; ++i) to[i * x_stride] = buffer[i];
}

LIMPID_LANES_INLINE VI clamp(VI x, int low, int high) {
  return hn::Min(hn::Max(x, hn::Set(kDI, low)), hn::Set(kDI, high));
}

}  // namespace limpid::HWY_NAMESPACE
