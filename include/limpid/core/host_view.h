#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "limpid/core/plane.h"
#include "limpid/core/rect.h"

namespace limpid {

/// The type of the samples of a channel.
enum class Sample : std::uint8_t {
  kFloat,  ///< 32 bits, IEEE 754
  kHalf,   ///< 16 bits, IEEE 754
};
constexpr std::ptrdiff_t bytes_of(Sample sample) { return sample == Sample::kHalf ? 2 : 4; }

/// A view of one channel of a picture in a host's memory. `data` points at the sample of the pixel
/// (window.x0, window.y0). Strides count bytes and may have any value: those of interleaved pixels,
/// negative ones for pictures that begin with the lowest row, and 0 for inputs. Samples need no
/// alignment.
template <class Void>
struct HostView {
  Void* data = nullptr;
  Sample sample = Sample::kFloat;
  std::ptrdiff_t x_stride = 0, y_stride = 0;
  Rect window;  ///< the data window, in the pixel coordinates of the picture

  explicit operator bool() const { return data != nullptr; }
  operator HostView<const void>() const requires(!std::is_const_v<Void>) {
    return {data, sample, x_stride, y_stride, window};
  }
};
using HostInput = HostView<const void>;
using HostOutput = HostView<void>;

/// A channel with samples side by side, row after row without a gap.
template <class Void>
HostView<Void> planar(Void* data, Sample sample, Size size) {
  const std::ptrdiff_t bytes = bytes_of(sample);
  return {data, sample, bytes, bytes * size.width, rect_of(size)};
}

/// Channel `index` of interleaved pixels with `channels` channels, row after row without a gap.
template <class Void>
HostView<Void> interleaved(Void* data, Sample sample, int channels, int index, Size size) {
  using Byte = std::conditional_t<std::is_const_v<Void>, const std::byte, std::byte>;
  const std::ptrdiff_t bytes = bytes_of(sample);
  return {static_cast<Byte*>(data) + bytes * index, sample, bytes * channels,
          bytes * channels * size.width, rect_of(size)};
}

/// A view of floats as a host's view.
inline HostInput host_view(const View<const float>& view) {
  constexpr std::ptrdiff_t kSize = sizeof(float);
  return {view.data, Sample::kFloat, kSize * view.x_stride, kSize * view.y_stride, view.window};
}
inline HostOutput host_view(const View<float>& view) {
  constexpr std::ptrdiff_t kSize = sizeof(float);
  return {view.data, Sample::kFloat, kSize * view.x_stride, kSize * view.y_stride, view.window};
}

/// Whether floats_of() can view the samples: they are floats, aligned, with strides that are
/// multiples of a float.
bool is_floats(const HostInput& view);
/// The same samples as a view of floats. Requires is_floats().
View<const float> floats_of(const HostInput& view);
View<float> floats_of(const HostOutput& view);

/// Whether the two may share memory: their ranges from the first to the last byte intersect.
/// Channels of the same interleaved pixels overlap in this sense.
bool overlap(const HostInput& a, const HostInput& b);

}  // namespace limpid
