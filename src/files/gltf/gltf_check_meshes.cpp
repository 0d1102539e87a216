#include <algorithm>

#include "limpid/core/error.h"

#include "files/gltf/gltf_check.h"
#include "files/gltf/gltf_extensions.h"
#include "files/gltf/gltf_triangles.h"
#include "files/gltf/gltf_types.h"

namespace limpid {
namespace {

// The component types of an attribute: floats, or integers of these types, as fractions of the
// largest or as their values.
struct Form {
  std::vector<std::string> types;
  std::vector<std::int64_t> normalized, plain;
  const char* expected;
};

const Form kVectors = {{"VEC3"}, {}, {}, "an accessor of VEC3 float"};
const Form kUvs = {{"VEC2"},
                   {kGltfUbyte, kGltfUshort},
                   {},
                   "an accessor of VEC2 float, or of normalized unsigned bytes or shorts"};
const Form kColors = {
    {"VEC3", "VEC4"},
    {kGltfUbyte, kGltfUshort},
    {},
    "an accessor of VEC3 or VEC4 float, or of normalized unsigned bytes or shorts"};
const Form kWeights = {{"VEC4"},
                       {kGltfUbyte, kGltfUshort},
                       {},
                       "an accessor of VEC4 float, or of normalized unsigned bytes or shorts"};

// KHR_mesh_quantization, "Extending Mesh Attributes".
const std::vector<std::int64_t> kSmall = {kGltfByte, kGltfUbyte, kGltfShort, kGltfUshort};
const Form kQuantizedPositions = {
    {"VEC3"}, kSmall, kSmall, "an accessor of VEC3 float, bytes or shorts"};
const Form kQuantizedNormals = {
    {"VEC3"}, {kGltfByte, kGltfShort}, {}, "an accessor of VEC3 float, normalized bytes or shorts"};
const Form kQuantizedUvs = {{"VEC2"}, kSmall, kSmall, "an accessor of VEC2 float, bytes or shorts"};

bool among(const std::vector<std::int64_t>& types, std::int64_t type) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

class Checker {
 public:
  explicit Checker(const JsonPlace& root)
      : accessors_(root.list("accessors")),
        materials_(root.count("materials")),
        quantized_(uses_extension(root, "KHR_mesh_quantization")) {}

  void check_mesh(const JsonPlace& mesh) const {
    const std::vector<JsonPlace> primitives = mesh.at("primitives").items();
    if (primitives.empty()) mesh.at("primitives").refuse("at least one");
    const std::size_t targets = primitives.front().count("targets");
    for (const JsonPlace& primitive : primitives) {
      check_primitive(primitive);
      if (primitive.count("targets") != targets) {
        throw Error(primitive.path() + ": has " + std::to_string(primitive.count("targets")) +
                    " morph targets, expected " + std::to_string(targets) +
                    " as in the first primitive");
      }
    }
    if (const auto weights = mesh.find("weights")) weights->numbers(targets);
  }

 private:
  const JsonPlace& accessor_of(const JsonPlace& use) const {
    return accessors_[use.index(accessors_.size())];
  }

  void check_form(const JsonPlace& use, const Form& form) const {
    const JsonPlace& accessor = accessor_of(use);
    const std::int64_t component = accessor.at("componentType").integer(0, INT32_MAX);
    const bool fits = component == kGltfFloat ||
                      among(is_normalized(accessor) ? form.normalized : form.plain, component);
    const std::string& type = accessor.at("type").text();
    const bool known = std::find(form.types.begin(), form.types.end(), type) != form.types.end();
    if (!known || !fits) use.refuse(form.expected);
  }

  void check_joints(const JsonPlace& use) const {
    const JsonPlace& accessor = accessor_of(use);
    const std::int64_t component = accessor.at("componentType").integer(0, INT32_MAX);
    const bool small = component == kGltfUbyte || component == kGltfUshort;
    if (accessor.at("type").text() != "VEC4" || !small || is_normalized(accessor)) {
      use.refuse("an accessor of VEC4 unsigned bytes or shorts");
    }
  }

  void check_attribute(const JsonPlace& attributes, const std::string& name) const {
    const JsonPlace use = attributes.at(name);
    if (name == "POSITION") check_form(use, quantized_ ? kQuantizedPositions : kVectors);
    if (name == "NORMAL") check_form(use, quantized_ ? kQuantizedNormals : kVectors);
    if (name.starts_with("TEXCOORD_")) check_form(use, quantized_ ? kQuantizedUvs : kUvs);
    if (name.starts_with("JOINTS_")) check_joints(use);
    if (name.starts_with("WEIGHTS_")) check_form(use, kWeights);
    if (name == "COLOR_0") check_form(use, kColors);
  }

  // The attributes of a primitive or of a morph target.
  void check_attributes(const JsonPlace& attributes, std::int64_t vertices) const {
    for (const std::string& name : attributes.keys()) {
      const JsonPlace count = accessor_of(attributes.at(name)).at("count");
      if (count.integer(1, INT32_MAX) != vertices) {
        count.refuse(std::to_string(vertices) + " as in POSITION");
      }
      check_attribute(attributes, name);
    }
  }

  void check_indices(const JsonPlace& use) const {
    const JsonPlace& accessor = accessor_of(use);
    const std::int64_t component = accessor.at("componentType").integer(0, INT32_MAX);
    const bool unsigned_integers =
        component == kGltfUbyte || component == kGltfUshort || component == kGltfUint;
    if (accessor.at("type").text() != "SCALAR" || !unsigned_integers || is_normalized(accessor)) {
      use.refuse("an accessor of SCALAR unsigned integers");
    }
  }

  // Without uncompressed bytes its accessors would read as zeros.
  void check_packing(const JsonPlace& primitive) const {
    constexpr const char* kDraco = "KHR_draco_mesh_compression";
    if (!extension_of(primitive, kDraco)) return;
    const auto check = [&](const JsonPlace& use) {
      const JsonPlace& accessor = accessor_of(use);
      if (accessor.find("bufferView") || accessor.find("sparse")) return;
      throw Error(primitive.path() + ": is packed by Draco (" + kDraco +
                  "), which is not read, expected its bytes in buffer views, too");
    };
    const JsonPlace attributes = primitive.at("attributes");
    for (const std::string& name : attributes.keys()) check(attributes.at(name));
    if (const auto indices = primitive.find("indices")) check(*indices);
  }

  void check_primitive(const JsonPlace& primitive) const {
    const JsonPlace attributes = primitive.at("attributes");
    if (const auto material = primitive.find("material")) material->index(materials_);
    const std::optional<JsonPlace> position = attributes.find("POSITION");
    if (!position) return;  // nothing to draw
    check_packing(primitive);
    const std::int64_t vertices = accessor_of(*position).at("count").integer(1, INT32_MAX);
    check_attributes(attributes, vertices);
    for (const JsonPlace& target : primitive.list("targets")) check_attributes(target, vertices);
    std::int64_t corners = vertices;
    const std::optional<JsonPlace> indices = primitive.find("indices");
    if (indices) {
      check_indices(*indices);
      corners = accessor_of(*indices).at("count").integer(1, INT32_MAX);
    }
    check_corners(gltf_mode_of(primitive), corners, indices ? *indices : *position);
  }

  static void check_corners(GltfMode mode, std::int64_t corners, const JsonPlace& counted) {
    const std::string count = counted.path() + ": " + std::to_string(corners) + " corners";
    if (mode == GltfMode::kTriangles && corners % 3 != 0) {
      throw Error(count + ", expected three a triangle");
    }
    if (is_triangles(mode) && corners < 3) throw Error(count + ", expected at least three");
  }

  std::vector<JsonPlace> accessors_;
  std::size_t materials_;
  bool quantized_;
};

}  // namespace

void check_gltf_meshes(const JsonPlace& root, Undrawable undrawable, GltfFaults& faults) {
  const Checker checker(root);
  faults.meshes = faults_of(root.list("meshes"), undrawable,
                            [&](const JsonPlace& mesh) { checker.check_mesh(mesh); });
}

}  // namespace limpid
