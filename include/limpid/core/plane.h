#pragma once
#include <cstddef>
#include <memory>
#include <type_traits>

#include "limpid/core/rect.h"

namespace limpid {

/// A view of one channel of a picture, in memory that another object owns. `data` points at the
/// texel (window.x0, window.y0). Strides count elements of type T and may have any value: for
/// interleaved pixels 3 or 4, and also negative values.
template <class T>
struct View {
  T* data = nullptr;
  std::ptrdiff_t x_stride = 1, y_stride = 0;
  Rect window;  ///< the data window, in the pixel coordinates of the display window

  explicit operator bool() const { return data != nullptr; }
  T& at(int x, int y) const { return row(y)[std::ptrdiff_t{x - window.x0} * x_stride]; }
  T* row(int y) const { return data + std::ptrdiff_t{y - window.y0} * y_stride; }
  operator View<const T>() const requires(!std::is_const_v<T>) {
    return {data, x_stride, y_stride, window};
  }
};

/// One channel that owns its memory: float32, with rows that are 64-byte aligned and padded to
/// multiples of 64 bytes. Pixels and padding are 0 at first.
class Plane {
 public:
  Plane() = default;
  /// Throws Error for an empty window, std::bad_alloc if memory runs out.
  explicit Plane(Rect window);

  View<float> view() { return {data_.get(), 1, y_stride_, window_}; }
  View<const float> view() const { return {data_.get(), 1, y_stride_, window_}; }
  explicit operator bool() const { return data_ != nullptr; }

 private:
  struct Free {
    void* block;  ///< the allocated memory; the first row is aligned within it
    void operator()(float*) const;
  };
  std::unique_ptr<float[], Free> data_;
  std::ptrdiff_t y_stride_ = 0;
  Rect window_;
};

}  // namespace limpid
