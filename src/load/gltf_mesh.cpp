#include "load/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/geometric.hpp>

#include "limpid/core/error.h"

namespace limpid {
namespace {

/// The elements of an accessor, where they lie in their buffer.
struct Elements {
  const unsigned char* first;
  std::size_t stride;
  std::size_t count;
  int component, components;

  template <class T>
  T at(std::size_t element, int index) const {
    T value;
    std::memcpy(&value, first + element * stride + index * sizeof(T), sizeof(T));
    return value;
  }
};

Elements elements_of(const tinygltf::Model& gltf, int index) {
  const tinygltf::Accessor& accessor = gltf.accessors.at(index);
  const tinygltf::BufferView& view = gltf.bufferViews.at(accessor.bufferView);
  const unsigned char* bytes = gltf.buffers.at(view.buffer).data.data();
  return {bytes + view.byteOffset + accessor.byteOffset,
          static_cast<std::size_t>(accessor.ByteStride(view)), accessor.count,
          accessor.componentType, tinygltf::GetNumComponentsInType(accessor.type)};
}

std::string shown(glm::vec3 v) {
  return "(" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ")";
}

[[noreturn]] void refuse(const std::string& label, std::size_t vertex, const std::string& phrase) {
  throw Error(label + " vertex " + std::to_string(vertex) + ": " + phrase);
}

std::vector<glm::vec3> read_vectors(const Elements& elements, const std::string& label,
                                    const char* name) {
  std::vector<glm::vec3> vectors(elements.count);
  for (std::size_t i = 0; i < elements.count; ++i) {
    const glm::vec3 v(elements.at<float>(i, 0), elements.at<float>(i, 1), elements.at<float>(i, 2));
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
      refuse(label, i, std::string(name) + " " + shown(v) + ", expected finite numbers");
    }
    vectors[i] = v;
  }
  return vectors;
}

// A float, or an integer as a share of the largest one.
float share_at(const Elements& elements, std::size_t vertex, int index) {
  switch (elements.component) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return static_cast<float>(elements.at<std::uint8_t>(vertex, index)) / 255.0f;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return static_cast<float>(elements.at<std::uint16_t>(vertex, index)) / 65535.0f;
    default:
      return elements.at<float>(vertex, index);
  }
}

std::vector<glm::vec2> read_uvs(const Elements& elements, const std::string& label) {
  std::vector<glm::vec2> uvs(elements.count);
  for (std::size_t i = 0; i < elements.count; ++i) {
    uvs[i] = {share_at(elements, i, 0), share_at(elements, i, 1)};
    for (const float c : {uvs[i].x, uvs[i].y}) {
      if (!std::isfinite(c)) refuse(label, i, "uv " + std::to_string(c) + ", expected a number");
    }
  }
  return uvs;
}

// None where all are white and opaque. Numbers below 0 become 0.
std::vector<glm::vec4> read_colors(const Elements& elements, const std::string& label) {
  std::vector<glm::vec4> colors(elements.count, glm::vec4(1));
  bool some = false;
  for (std::size_t i = 0; i < elements.count; ++i) {
    for (int c = 0; c < elements.components; ++c) {
      const float value = share_at(elements, i, c);
      if (!std::isfinite(value)) {
        refuse(label, i, "color " + std::to_string(value) + ", expected a number");
      }
      colors[i][c] = std::max(value, 0.0f);
    }
    some = some || colors[i] != glm::vec4(1);
  }
  if (!some) colors.clear();
  return colors;
}

/// Those of the sets that the material asks for; of none asked for, the first that there is.
void add_uvs(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive,
             const GltfMaterial& looks, const std::string& label, Mesh& mesh) {
  const bool textured = !looks.uv_sets.empty();
  const std::vector<int> sets = textured ? looks.uv_sets : std::vector<int>{0};
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::string key = "TEXCOORD_" + std::to_string(sets[i]);
    const auto found = primitive.attributes.find(key);
    if (found != primitive.attributes.end()) {
      (i == 0 ? mesh.uvs : mesh.second_uvs) = read_uvs(elements_of(gltf, found->second), label);
    } else if (textured) {
      throw Error(label + ": expected " + key + ", because material '" + looks.material.name +
                  "' has a texture");
    }
  }
}

std::uint32_t index_at(const Elements& elements, std::size_t corner) {
  switch (elements.component) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return elements.at<std::uint8_t>(corner, 0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return elements.at<std::uint16_t>(corner, 0);
    default:
      return elements.at<std::uint32_t>(corner, 0);
  }
}

// Twice the triangle's area, along its normal.
glm::dvec3 area_vector(const Mesh& mesh, const std::uint32_t corners[3]) {
  const glm::dvec3 a = mesh.positions[corners[0]];
  return glm::cross(glm::dvec3(mesh.positions[corners[1]]) - a,
                    glm::dvec3(mesh.positions[corners[2]]) - a);
}

// Fills mesh.indices with the triangles that have an area; returns how many have none.
template <class IndexOf>
std::int64_t add_triangles(Mesh& mesh, std::size_t corners, const std::string& label,
                           IndexOf index_of) {
  std::int64_t skipped = 0;
  mesh.indices.reserve(corners);
  for (std::size_t corner = 0; corner < corners; corner += 3) {
    std::uint32_t triangle[3];
    for (int k = 0; k < 3; ++k) {
      triangle[k] = index_of(corner + k);
      if (triangle[k] < mesh.positions.size()) continue;
      throw Error(label + " corner " + std::to_string(corner + k) + ": index " +
                  std::to_string(triangle[k]) + ", expected one below " +
                  std::to_string(mesh.positions.size()));
    }
    if (area_vector(mesh, triangle) == glm::dvec3(0)) {
      ++skipped;
    } else {
      mesh.indices.insert(mesh.indices.end(), triangle, triangle + 3);
    }
  }
  return skipped;
}

void make_unit_normals(Mesh& mesh) {
  std::vector<glm::dvec3> around;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    glm::dvec3 normal = mesh.normals[i];
    if (normal == glm::dvec3(0)) {
      if (around.empty()) {
        around.resize(mesh.positions.size());
        for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
          around[mesh.indices[corner]] += area_vector(mesh, &mesh.indices[corner / 3 * 3]);
        }
      }
      normal = around[i] == glm::dvec3(0) ? glm::dvec3(0, 1, 0) : around[i];
    }
    mesh.normals[i] = glm::vec3(glm::normalize(normal));
  }
}

}  // namespace

void MemoryBudget::take(std::int64_t bytes, const std::string& what) {
  if (bytes > left) {
    throw Error(what + ": needs " + std::to_string(bytes) + " bytes of memory, expected at most " +
                std::to_string(left) + " that are left of the limit");
  }
  left -= bytes;
}

std::string gltf_label(const char* list, int index, const std::string& name) {
  const std::string place = std::string(list) + "[" + std::to_string(index) + "]";
  return name.empty() ? place : place + " '" + name + "'";
}

GltfMesh read_gltf_mesh(const tinygltf::Model& gltf, int index,
                        const std::vector<GltfMaterial>& materials, MemoryBudget& budget) {
  const tinygltf::Mesh& source = gltf.meshes.at(index);
  const std::string label = gltf_label("meshes", index, source.name);
  GltfMesh read;
  for (const tinygltf::Primitive& primitive : source.primitives) {
    const auto& attributes = primitive.attributes;
    const Elements positions = elements_of(gltf, attributes.at("POSITION"));
    const bool indexed = primitive.indices >= 0;
    const Elements indices = indexed ? elements_of(gltf, primitive.indices) : Elements{};
    const std::size_t corners = indexed ? indices.count : positions.count;
    const int material =
        primitive.material >= 0 ? primitive.material : static_cast<int>(materials.size()) - 1;
    const GltfMaterial& looks = materials.at(material);
    const std::size_t bytes_a_vertex =
        2 * sizeof(glm::vec3) + std::max<std::size_t>(looks.uv_sets.size(), 1) * sizeof(glm::vec2) +
        attributes.count("COLOR_0") * sizeof(glm::vec4);
    budget.take(static_cast<std::int64_t>(positions.count * bytes_a_vertex +
                                          corners * sizeof(std::uint32_t)),
                label);
    Mesh mesh;
    mesh.name = source.name;
    mesh.material = material;
    mesh.positions = read_vectors(positions, label, "position");
    if (const auto found = attributes.find("NORMAL"); found != attributes.end()) {
      mesh.normals = read_vectors(elements_of(gltf, found->second), label, "normal");
    }
    add_uvs(gltf, primitive, looks, label, mesh);
    if (const auto found = attributes.find("COLOR_0"); found != attributes.end()) {
      mesh.colors = read_colors(elements_of(gltf, found->second), label);
    }
    read.skipped_triangles += add_triangles(mesh, corners, label, [&](std::size_t corner) {
      return indexed ? index_at(indices, corner) : static_cast<std::uint32_t>(corner);
    });
    make_unit_normals(mesh);
    if (!mesh.indices.empty()) read.parts.push_back(std::move(mesh));
  }
  return read;
}

}  // namespace limpid
