#include "files/gltf/gltf_accessors.h"

#include <algorithm>
#include <cstring>

#include "limpid/core/error.h"

#include "files/gltf/gltf_types.h"

namespace limpid {

template <class T>
T GltfElements::raw(std::size_t element, int component) const {
  T value;
  std::memcpy(&value, first_ + element * stride_ + component * sizeof(T), sizeof(T));
  return value;
}

std::uint32_t GltfElements::integer(std::size_t element, int component) const {
  switch (component_) {
    case kGltfUbyte:
      return raw<std::uint8_t>(element, component);
    case kGltfUshort:
      return raw<std::uint16_t>(element, component);
    default:
      return raw<std::uint32_t>(element, component);
  }
}

float GltfElements::number(std::size_t element, int component) const {
  const auto scaled = [&](auto value, float largest) {
    const auto number = static_cast<float>(value);
    return normalized_ ? std::max(number / largest, -1.0f) : number;
  };
  switch (component_) {
    case kGltfByte:
      return scaled(raw<std::int8_t>(element, component), 127);
    case kGltfUbyte:
      return scaled(raw<std::uint8_t>(element, component), 255);
    case kGltfShort:
      return scaled(raw<std::int16_t>(element, component), 32767);
    case kGltfUshort:
      return scaled(raw<std::uint16_t>(element, component), 65535);
    case kGltfUint:
      return static_cast<float>(raw<std::uint32_t>(element, component));
    default:
      return raw<float>(element, component);
  }
}

glm::vec3 GltfElements::vector(std::size_t element) const {
  return {number(element, 0), number(element, 1), number(element, 2)};
}

glm::dmat4 GltfElements::matrix(std::size_t element) const {
  glm::dmat4 matrix;
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = number(element, i);
  return matrix;
}

GltfAccessors::Part GltfAccessors::part_of(const JsonPlace& place) {
  Part part;
  if (const auto view = place.find("bufferView")) {
    part.view = static_cast<int>(view->integer(0, INT32_MAX));
  }
  if (const auto offset = place.find("byteOffset")) {
    part.offset = static_cast<std::size_t>(offset->integer(0, INT64_MAX));
  }
  return part;
}

GltfAccessors::GltfAccessors(const JsonPlace& root, const GltfBuffers& buffers,
                             MemoryBudget& budget)
    : buffers_(buffers), budget_(budget) {
  const std::vector<JsonPlace> views = root.list("bufferViews");
  for (const JsonPlace& place : root.list("accessors")) {
    Accessor& accessor = accessors_.emplace_back();
    accessor.base = part_of(place);
    accessor.element = static_cast<std::size_t>(gltf_element_size(place));
    accessor.stride = accessor.element;
    accessor.count = static_cast<std::size_t>(place.at("count").integer(1, INT32_MAX));
    accessor.component = static_cast<int>(place.at("componentType").integer(0, INT32_MAX));
    accessor.normalized = is_normalized(place);
    if (accessor.base.view >= 0) {
      const auto stride = views[accessor.base.view].find("byteStride");
      if (stride) accessor.stride = static_cast<std::size_t>(stride->integer(0, INT32_MAX));
    }
    if (const auto sparse = place.find("sparse")) {
      accessor.sparse = static_cast<std::size_t>(sparse->at("count").integer(1, INT32_MAX));
      accessor.indices = part_of(sparse->at("indices"));
      accessor.values = part_of(sparse->at("values"));
      accessor.index_component =
          static_cast<int>(sparse->at("indices").at("componentType").integer(0, INT32_MAX));
    }
  }
}

const char* GltfAccessors::bytes(const Part& part) const {
  return buffers_.view(part.view).data() + part.offset;
}

void GltfAccessors::put_sparse(const Accessor& accessor, int index, char* copy) const {
  GltfElements indices;
  indices.first_ = bytes(accessor.indices);
  indices.component_ = accessor.index_component;
  indices.stride_ = static_cast<std::size_t>(gltf_component_size(accessor.index_component));
  const char* values = bytes(accessor.values);
  std::int64_t last = -1;
  for (std::size_t i = 0; i < accessor.sparse; ++i) {
    const std::int64_t at = indices.integer(i, 0);
    if (at <= last || at >= static_cast<std::int64_t>(accessor.count)) {
      throw Error("accessors[" + std::to_string(index) + "].sparse: index " + std::to_string(i) +
                  " is " + std::to_string(at) + ", expected one above " + std::to_string(last) +
                  " and below " + std::to_string(accessor.count));
    }
    std::memcpy(copy + static_cast<std::size_t>(at) * accessor.element,
                values + i * accessor.element, accessor.element);
    last = at;
  }
}

GltfElements GltfAccessors::of(int index) const {
  // The content of an accessor without a buffer view: an element of zeros, repeated.
  static constexpr char kZeros[64] = {};
  const Accessor& accessor = accessors_.at(index);
  GltfElements elements;
  const bool empty = accessor.base.view < 0;
  elements.first_ = empty ? kZeros : bytes(accessor.base);
  elements.stride_ = empty ? 0 : accessor.stride;
  elements.count_ = accessor.count;
  elements.component_ = accessor.component;
  elements.components_ = static_cast<int>(accessor.element) /
                         static_cast<int>(gltf_component_size(accessor.component));
  elements.normalized_ = accessor.normalized;
  if (accessor.sparse == 0) return elements;
  budget_.take(accessor.count, accessor.element, "accessors[" + std::to_string(index) + "]");
  auto copy = std::make_unique<char[]>(accessor.count * accessor.element);
  for (std::size_t i = 0; !empty && i < accessor.count; ++i) {
    std::memcpy(copy.get() + i * accessor.element, elements.first_ + i * elements.stride_,
                accessor.element);
  }
  put_sparse(accessor, index, copy.get());
  elements.first_ = copy.get();
  elements.copy_ = std::move(copy);
  elements.stride_ = accessor.element;
  return elements;
}

}  // namespace limpid
