#include "files/gltf/gltf_types.h"

namespace limpid {
namespace {

// Components of SCALAR, VEC2 ...
constexpr std::string_view kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
constexpr std::int64_t kComponents[] = {1, 2, 3, 4, 4, 9, 16};

}  // namespace

std::int64_t gltf_component_size(std::int64_t component) {
  switch (component) {
    case kGltfByte:
    case kGltfUbyte:
      return 1;
    case kGltfShort:
    case kGltfUshort:
      return 2;
    case kGltfUint:
    case kGltfFloat:
      return 4;
    default:
      return 0;
  }
}

std::int64_t gltf_element_size(const JsonPlace& accessor) {
  const JsonPlace component = accessor.at("componentType");
  const std::int64_t size = gltf_component_size(component.integer(0, INT32_MAX));
  if (size == 0) component.refuse("one of 5120, 5121, 5122, 5123, 5125, 5126");
  return size * kComponents[accessor.at("type").choice(kTypes)];
}

bool is_normalized(const JsonPlace& accessor) {
  const std::optional<JsonPlace> said = accessor.find("normalized");
  return said && said->boolean();
}

}  // namespace limpid
