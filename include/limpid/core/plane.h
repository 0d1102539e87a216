#pragma once
#include <cstddef>
#include <memory>
#include <type_traits>

#include "limpid/core/rect.h"

namespace limpid {

/// One channel of a picture in memory that somebody else owns. `data` points at the texel
/// (window.x0, window.y0); strides count elements and may be anything, also negative or, for
/// interleaved pixels, 3 or 4.
template <class T>
struct View {
  T* data = nullptr;
  std::ptrdiff_t x_stride = 1, y_stride = 0;
  Rect window;  ///< the pixels that are there, in the coordinates of the display window

  explicit operator bool() const { return data != nullptr; }
  T& at(int x, int y) const { return row(y)[std::ptrdiff_t{x - window.x0} * x_stride]; }
  T* row(int y) const { return data + std::ptrdiff_t{y - window.y0} * y_stride; }
  operator View<const T>() const requires(!std::is_const_v<T>) {
    return {data, x_stride, y_stride, window};
  }
};

/// One channel that owns its memory: float32, rows 64-byte aligned and padded to whole 64 bytes,
/// padding and pixels zero at first.
class Plane {
 public:
  Plane() = default;
  /// Throws Error for an empty window, std::bad_alloc where memory ends.
  explicit Plane(Rect window);

  View<float> view() { return {data_.get(), 1, y_stride_, window_}; }
  View<const float> view() const { return {data_.get(), 1, y_stride_, window_}; }
  explicit operator bool() const { return data_ != nullptr; }

 private:
  struct Free {
    void* block;  ///< what was allocated; the first row is aligned within
    void operator()(float*) const;
  };
  std::unique_ptr<float[], Free> data_;
  std::ptrdiff_t y_stride_ = 0;
  Rect window_;
};

}  // namespace limpid
