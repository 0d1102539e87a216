#include "arrays.h"

#include <cstdint>
#include <vector>

#include "limpid/core/error.h"

namespace limpid::python {
namespace {

namespace py = pybind11;

/// Keeps strides and all coordinates within the range of int.
constexpr py::ssize_t kMaxSize = 1 << 24;

std::string text_of(const py::handle& object) { return py::str(object).cast<std::string>(); }

std::string shape_text(Size size, int channels) {
  return "(" + std::to_string(size.height) + ", " + std::to_string(size.width) +
         (channels > 1 ? ", " + std::to_string(channels) : "") + ")";
}

Sample sample_of(const py::array& array, const std::string& name) {
  const py::dtype type = array.dtype();
  if (type.kind() == 'f' && type.byteorder() == '=') {
    if (type.itemsize() == 4) return Sample::kFloat;
    if (type.itemsize() == 2) return Sample::kHalf;
  }
  throw Error(name + " is an array of " + text_of(type) +
              ", expected float32 or float16 of this machine's byte order");
}

const float* floats_of(const Picture& picture, const std::string& name) {
  constexpr std::ptrdiff_t kSize = sizeof(float);
  if (picture.sample != Sample::kFloat) throw Error(name + " is float16, expected float32");
  const bool aligned = reinterpret_cast<std::uintptr_t>(picture.data) % kSize == 0 &&
                       picture.x_stride % kSize == 0 && picture.y_stride % kSize == 0 &&
                       picture.channel_stride % kSize == 0;
  if (!aligned) throw Error(name + " is not aligned to the 4 bytes of a float32");
  return static_cast<const float*>(picture.data);
}

}  // namespace

Picture picture_of(const py::handle& object, const std::string& name) {
  if (!py::isinstance<py::array>(object)) {
    throw Error(name + " is a " + text_of(py::type::of(object).attr("__name__")) +
                ", expected a numpy array");
  }
  const auto array = py::reinterpret_borrow<py::array>(object);
  Picture picture;
  picture.sample = sample_of(array, name);
  if (array.ndim() != 2 && array.ndim() != 3) {
    throw Error(name + " has " + std::to_string(array.ndim()) +
                " dimensions, expected (rows, columns) or (rows, columns, channels)");
  }
  for (py::ssize_t i = 0; i < array.ndim(); ++i) {
    if (array.shape(i) < 1 || array.shape(i) > kMaxSize) {
      throw Error(name + " has the shape " + text_of(py::object(array.attr("shape"))) +
                  ", expected 1 ... " + std::to_string(kMaxSize) + " along each dimension");
    }
  }
  picture.data = const_cast<void*>(array.data());
  picture.size = {static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0))};
  picture.y_stride = array.strides(0);
  picture.x_stride = array.strides(1);
  if (array.ndim() == 3) {
    picture.channels = static_cast<int>(array.shape(2));
    picture.channel_stride = array.strides(2);
  }
  return picture;
}

Picture writable_picture_of(const py::handle& object, const std::string& name) {
  const Picture picture = picture_of(object, name);
  if (!py::reinterpret_borrow<py::array>(object).writeable()) {
    throw Error(name + " is read-only, expected an array that may be written");
  }
  return picture;
}

void expect(const Picture& picture, const std::string& name, Size size, int channels) {
  if (picture.size == size && picture.channels == channels) return;
  throw Error(name + " has the shape " + shape_text(picture.size, picture.channels) +
              ", expected " + shape_text(size, channels));
}

HostInput input_of(const Picture& picture, int channel, int x0, int y0) {
  return {static_cast<const std::byte*>(picture.data) + channel * picture.channel_stride,
          picture.sample,
          picture.x_stride,
          picture.y_stride,
          {x0, y0, x0 + picture.size.width, y0 + picture.size.height}};
}

HostOutput output_of(const Picture& picture, int channel) {
  return {static_cast<std::byte*>(picture.data) + channel * picture.channel_stride, picture.sample,
          picture.x_stride, picture.y_stride, rect_of(picture.size)};
}

Texture texture_of(const Picture& picture, const std::string& name, bool mirrored) {
  expect(picture, name, picture.size, 3);
  const float* first = floats_of(picture, name);
  constexpr std::ptrdiff_t kSize = sizeof(float);
  const std::ptrdiff_t x_stride = picture.x_stride / kSize;
  if (mirrored) first += (picture.size.width - 1) * x_stride;
  Texture texture;
  for (int c = 0; c < 3; ++c) {
    texture.channels[static_cast<std::size_t>(c)] = {
        first + c * (picture.channel_stride / kSize), mirrored ? -x_stride : x_stride,
        picture.y_stride / kSize, rect_of(picture.size)};
  }
  return texture;
}

py::array new_array(Size size, int channels, Sample sample) {
  std::vector<py::ssize_t> shape{size.height, size.width};
  if (channels > 1) shape.push_back(channels);
  return py::array(py::dtype(sample == Sample::kHalf ? "float16" : "float32"), shape);
}

}  // namespace limpid::python
