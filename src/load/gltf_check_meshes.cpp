#include <algorithm>

#include "limpid/core/error.h"

#include "load/gltf_check.h"

namespace limpid {
namespace {

constexpr std::int64_t kByte = 5121, kShort = 5123, kInt = 5125, kFloat = 5126;
constexpr const char* kModes[] = {
    "points", "lines", "a line loop", "a line strip", "", "a triangle strip", "a triangle fan"};

bool normalized(const JsonPlace& accessor) {
  const std::optional<JsonPlace> said = accessor.find("normalized");
  return said && said->boolean();
}

// What every accessor that is drawn must be.
void check_dense(const JsonPlace& accessor) {
  if (accessor.find("sparse"))
    throw Error(accessor.path() + ": sparse accessors are not supported");
  if (!accessor.find("bufferView")) throw Error(accessor.path() + ": expected a bufferView");
}

void check_floats(const JsonPlace& use, const JsonPlace& accessor, std::string_view type) {
  check_dense(accessor);
  if (accessor.at("type").text() != type ||
      accessor.at("componentType").integer(0, INT32_MAX) != kFloat) {
    use.refuse("an accessor of " + std::string(type) + " float");
  }
}

// Of uvs and colors.
void check_shares(const JsonPlace& use, const JsonPlace& accessor,
                  const std::vector<std::string>& types) {
  check_dense(accessor);
  const std::int64_t component = accessor.at("componentType").integer(0, INT32_MAX);
  const bool integers = (component == kByte || component == kShort) && normalized(accessor);
  const bool fits =
      std::find(types.begin(), types.end(), accessor.at("type").text()) != types.end();
  if (!fits || !(component == kFloat || integers)) {
    use.refuse("an accessor of " + join(types, " or ") +
               " float, or of normalized unsigned bytes or shorts");
  }
}

void check_indices(const JsonPlace& use, const JsonPlace& accessor) {
  check_dense(accessor);
  const std::int64_t component = accessor.at("componentType").integer(0, INT32_MAX);
  const bool unsigned_integers = component == kByte || component == kShort || component == kInt;
  if (accessor.at("type").text() != "SCALAR" || !unsigned_integers || normalized(accessor)) {
    use.refuse("an accessor of SCALAR unsigned integers");
  }
}

// Returns the vertex count.
std::int64_t check_attributes(const JsonPlace& primitive, const std::vector<JsonPlace>& accessors) {
  const JsonPlace attributes = primitive.at("attributes");
  const JsonPlace position = attributes.at("POSITION");
  const auto accessor_of = [&](const JsonPlace& use) -> const JsonPlace& {
    return accessors[use.index(accessors.size())];
  };
  check_floats(position, accessor_of(position), "VEC3");
  const std::int64_t vertices = accessor_of(position).at("count").integer(1, INT32_MAX);
  const auto check_count = [&](const JsonPlace& use) {
    const JsonPlace count = accessor_of(use).at("count");
    if (count.integer(1, INT32_MAX) != vertices) {
      count.refuse(std::to_string(vertices) + " as in POSITION");
    }
  };
  if (const std::optional<JsonPlace> normal = attributes.find("NORMAL")) {
    check_floats(*normal, accessor_of(*normal), "VEC3");
    check_count(*normal);
  }
  for (const std::string& key : attributes.keys()) {
    if (!key.starts_with("TEXCOORD_")) continue;
    const JsonPlace uv = attributes.at(key);
    check_shares(uv, accessor_of(uv), {"VEC2"});
    check_count(uv);
  }
  if (const std::optional<JsonPlace> color = attributes.find("COLOR_0")) {
    check_shares(*color, accessor_of(*color), {"VEC3", "VEC4"});
    check_count(*color);
  }
  return vertices;
}

void check_primitive(const JsonPlace& primitive, const std::vector<JsonPlace>& accessors,
                     std::size_t materials) {
  if (const std::optional<JsonPlace> mode = primitive.find("mode")) {
    const std::int64_t kind = mode->integer(0, 6);
    if (kind != 4) mode->refuse(std::string("4, a triangle list, not ") + kModes[kind]);
  }
  if (primitive.find("targets")) {
    throw Error(primitive.path() + ".targets: morph targets are not supported");
  }
  std::int64_t corners = check_attributes(primitive, accessors);
  std::optional<JsonPlace> counted = primitive.at("attributes").find("POSITION");
  if (const std::optional<JsonPlace> indices = primitive.find("indices")) {
    const JsonPlace& accessor = accessors[indices->index(accessors.size())];
    check_indices(*indices, accessor);
    corners = accessor.at("count").integer(1, INT32_MAX);
    counted = indices;
  }
  if (corners % 3 != 0) {
    throw Error(counted->path() + ": " + std::to_string(corners) +
                " corners, expected three a triangle");
  }
  if (const std::optional<JsonPlace> material = primitive.find("material")) {
    material->index(materials);
  }
}

}  // namespace

void check_gltf_meshes(const JsonPlace& root) {
  const std::vector<JsonPlace> accessors = root.list("accessors");
  const std::size_t materials = root.count("materials");
  for (const JsonPlace& mesh : root.list("meshes")) {
    const std::vector<JsonPlace> primitives = mesh.at("primitives").items();
    if (primitives.empty()) mesh.at("primitives").refuse("at least one");
    for (const JsonPlace& primitive : primitives) check_primitive(primitive, accessors, materials);
  }
}

}  // namespace limpid
