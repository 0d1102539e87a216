#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "limpid/core/plane.h"
#include "limpid/core/rect.h"

namespace limpid {

/// How a number of a picture is stored.
enum class Sample : std::uint8_t {
  kFloat,  ///< 32 bits, IEEE 754
  kHalf,   ///< 16 bits, IEEE 754
};
constexpr std::ptrdiff_t bytes_of(Sample sample) { return sample == Sample::kHalf ? 2 : 4; }

/// One channel of a picture as a host program keeps it. `data` points at the sample of the pixel
/// (window.x0, window.y0); strides count bytes and may be anything: those of interleaved pixels,
/// negative ones of pictures that begin with the lowest row, for what is read also 0. No alignment
/// is asked for.
template <class Void>
struct HostView {
  Void* data = nullptr;
  Sample sample = Sample::kFloat;
  std::ptrdiff_t x_stride = 0, y_stride = 0;
  Rect window;  ///< the pixels that are there, in the coordinates of the picture

  explicit operator bool() const { return data != nullptr; }
  operator HostView<const void>() const requires(!std::is_const_v<Void>) {
    return {data, sample, x_stride, y_stride, window};
  }
};
using HostInput = HostView<const void>;
using HostOutput = HostView<void>;

/// A channel alone: row after row without a gap.
template <class Void>
HostView<Void> planar(Void* data, Sample sample, Size size) {
  const std::ptrdiff_t bytes = bytes_of(sample);
  return {data, sample, bytes, bytes * size.width, rect_of(size)};
}

/// Channel `index` of pixels with that many channels, row after row without a gap.
template <class Void>
HostView<Void> interleaved(Void* data, Sample sample, int channels, int index, Size size) {
  using Byte = std::conditional_t<std::is_const_v<Void>, const std::byte, std::byte>;
  const std::ptrdiff_t bytes = bytes_of(sample);
  return {static_cast<Byte*>(data) + bytes * index, sample, bytes * channels,
          bytes * channels * size.width, rect_of(size)};
}

/// Floats of our own, as a host has them.
inline HostInput host_view(const View<const float>& view) {
  constexpr std::ptrdiff_t kSize = sizeof(float);
  return {view.data, Sample::kFloat, kSize * view.x_stride, kSize * view.y_stride, view.window};
}
inline HostOutput host_view(const View<float>& view) {
  constexpr std::ptrdiff_t kSize = sizeof(float);
  return {view.data, Sample::kFloat, kSize * view.x_stride, kSize * view.y_stride, view.window};
}

/// Whether its samples are floats that can be read as such: aligned, at whole floats from another.
bool is_floats(const HostInput& view);
/// The same as a view of our own, where is_floats().
View<const float> floats_of(const HostInput& view);
View<float> floats_of(const HostOutput& view);

/// Whether some byte may belong to both: between the first and the last byte of the one lies one of
/// the other. Channels of the same interleaved pixels overlap in this sense.
bool overlap(const HostInput& a, const HostInput& b);

}  // namespace limpid
