#pragma once
#include <cstddef>
#include <string>

#include <pybind11/numpy.h>

#include "limpid/core/frame.h"
#include "limpid/core/host_view.h"

/// numpy's arrays as the library's pictures: in place, with any strides. Nothing is copied or
/// converted; other arrays are refused.

namespace limpid::python {

struct Picture {
  void* data = nullptr;
  Sample sample = Sample::kFloat;
  Size size;
  int channels = 1;
  std::ptrdiff_t x_stride = 0, y_stride = 0, channel_stride = 0;  ///< bytes
};

/// [rows, columns] or [rows, columns, channels], float32 or float16 in native byte order. Throws
/// Error, with `name`, for other arrays. The array keeps the memory.
Picture picture_of(const pybind11::handle& array, const std::string& name);
/// The same for a writable array.
Picture writable_picture_of(const pybind11::handle& array, const std::string& name);

/// Throws Error unless the picture has that size and number of channels.
void expect(const Picture& picture, const std::string& name, Size size, int channels);

/// One channel; its first pixel is (x0, y0).
HostInput input_of(const Picture& picture, int channel, int x0 = 0, int y0 = 0);
HostOutput output_of(const Picture& picture, int channel);

/// Three channels of aligned float32, else throws Error. `mirrored`: columns run backwards.
Texture texture_of(const Picture& picture, const std::string& name, bool mirrored);

/// A new array, without a third dimension for one channel.
pybind11::array new_array(Size size, int channels, Sample sample);

}  // namespace limpid::python
