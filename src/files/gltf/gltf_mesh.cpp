#include "files/gltf/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "limpid/core/error.h"

#include "files/gltf/gltf_nodes.h"
#include "files/gltf/gltf_triangles.h"

namespace limpid {
namespace {

std::string shown(glm::vec3 v) {
  return "(" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ")";
}

[[noreturn]] void refuse(const std::string& label, std::size_t vertex, const std::string& phrase) {
  throw Error(label + " vertex " + std::to_string(vertex) + ": " + phrase);
}

void expect_finite(const std::vector<glm::vec3>& vectors, const std::string& label,
                   const char* name) {
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const glm::vec3& v = vectors[i];
    if (std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z)) continue;
    refuse(label, i, std::string(name) + " " + shown(v) + ", expected finite numbers");
  }
}

std::vector<glm::vec3> read_vectors(const GltfElements& elements, const std::string& label,
                                    const char* name) {
  std::vector<glm::vec3> vectors(elements.count());
  for (std::size_t i = 0; i < elements.count(); ++i) vectors[i] = elements.vector(i);
  expect_finite(vectors, label, name);
  return vectors;
}

std::vector<glm::vec2> read_transformed(const GltfElements& elements, const UvTransform& transform,
                                        const std::string& label) {
  std::vector<glm::vec2> uvs(elements.count());
  for (std::size_t i = 0; i < elements.count(); ++i) {
    uvs[i] = transform.apply({elements.number(i, 0), elements.number(i, 1)});
    for (const float c : {uvs[i].x, uvs[i].y}) {
      if (!std::isfinite(c)) refuse(label, i, "uv " + std::to_string(c) + ", expected a number");
    }
  }
  return uvs;
}

// Empty if all are white and opaque. Numbers below 0 become 0.
std::vector<glm::vec4> read_colors(const GltfElements& elements, const std::string& label) {
  std::vector<glm::vec4> colors(elements.count(), glm::vec4(1));
  bool some = false;
  for (std::size_t i = 0; i < elements.count(); ++i) {
    for (int c = 0; c < elements.components(); ++c) {
      const float value = elements.number(i, c);
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

// Twice the triangle's area, along its normal.
glm::dvec3 area_vector(const Mesh& mesh, const std::uint32_t corners[3]) {
  const glm::dvec3 a = mesh.positions[corners[0]];
  return glm::cross(glm::dvec3(mesh.positions[corners[1]]) - a,
                    glm::dvec3(mesh.positions[corners[2]]) - a);
}

// Strips connect rows by degenerate triangles with two corners in one place.
bool joins_strips(const Mesh& mesh, GltfMode mode, const std::uint32_t corners[3]) {
  const auto at = [&](int k) { return mesh.positions[corners[k]]; };
  return mode == GltfMode::kStrip && (at(0) == at(1) || at(1) == at(2) || at(2) == at(0));
}

// Fills mesh.indices with the triangles of nonzero area; returns the number of others.
template <class IndexOf>
std::int64_t add_triangles(Mesh& mesh, GltfMode mode, std::size_t corners, const std::string& label,
                           IndexOf index_of) {
  std::int64_t skipped = 0;
  const std::size_t count = triangle_count(mode, corners);
  mesh.indices.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t triangle[3];
    const std::array<std::size_t, 3> corner = corners_of_triangle(mode, i);
    for (int k = 0; k < 3; ++k) {
      triangle[k] = index_of(corner[k]);
      if (triangle[k] < mesh.positions.size()) continue;
      throw Error(label + " corner " + std::to_string(corner[k]) + ": index " +
                  std::to_string(triangle[k]) + ", expected one below " +
                  std::to_string(mesh.positions.size()));
    }
    if (area_vector(mesh, triangle) != glm::dvec3(0)) {
      mesh.indices.insert(mesh.indices.end(), triangle, triangle + 3);
    } else if (!joins_strips(mesh, mode, triangle)) {
      ++skipped;
    }
  }
  return skipped;
}

// Triangles that joints mirror keep their front.
void turn_mirrored(const std::vector<bool>& mirrored, Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    if (mirrored[mesh.indices[i]]) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  }
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

const JsonPlace& GltfMeshes::mesh_of(int mesh) const {
  if (!faults_.at(mesh).empty()) throw Error(faults_[mesh]);
  return meshes_[mesh];
}

std::size_t GltfMeshes::corners_of(const JsonPlace& primitive) const {
  const auto indices = primitive.find("indices");
  const JsonPlace counted = indices ? *indices : primitive.at("attributes").at("POSITION");
  return accessors_.count(counted.index(INT32_MAX));
}

std::int64_t GltfMeshes::triangles(int mesh) const {
  std::size_t triangles = 0;
  for (const JsonPlace& primitive : mesh_of(mesh).list("primitives")) {
    const GltfMode mode = gltf_mode_of(primitive);
    if (!is_triangles(mode) || !primitive.at("attributes").find("POSITION")) continue;
    triangles += triangle_count(mode, corners_of(primitive));
  }
  return static_cast<std::int64_t>(triangles);
}

std::vector<double> GltfMeshes::weights(int mesh) const {
  const auto weights = mesh_of(mesh).find("weights");
  return weights ? weights->numbers(mesh_of(mesh).count("weights")) : std::vector<double>{};
}

bool GltfMeshes::is_drawn(const JsonPlace& primitive, const std::string& label) const {
  const GltfMode mode = gltf_mode_of(primitive);
  if (mode == GltfMode::kPoints) {
    warnings_.add("points are not drawn", label);
  } else if (!is_triangles(mode)) {
    warnings_.add("lines are not drawn", label);
  } else if (!primitive.at("attributes").find("POSITION")) {
    warnings_.add("primitives without POSITION are not drawn", label);
  } else {
    return true;
  }
  return false;
}

// The uvs that the material needs; if it needs none, the first that exist.
void GltfMeshes::read_uvs(const JsonPlace& attributes, const std::string& label, Mesh& mesh) const {
  const GltfMaterial& looks = materials_.at(mesh.material);
  const bool textured = !looks.uvs.empty();
  const std::vector<UvSource> sources = textured ? looks.uvs : std::vector<UvSource>{UvSource{}};
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const std::string name = sources[i].attribute();
    if (const auto found = attributes.find(name)) {
      (i == 0 ? mesh.uvs : mesh.second_uvs) =
          read_transformed(accessors_.of(found->index(INT32_MAX)), sources[i].transform, label);
    } else if (textured) {
      throw Error(label + ": expected " + name + ", because material '" + looks.material.name +
                  "' has a texture");
    }
  }
}

Mesh GltfMeshes::read_vertices(const JsonPlace& primitive, const std::string& label) const {
  const JsonPlace attributes = primitive.at("attributes");
  Mesh mesh;
  const auto material = primitive.find("material");
  mesh.material =
      material ? material->index(materials_.size()) : static_cast<int>(materials_.size()) - 1;
  const GltfMaterial& looks = materials_[mesh.material];
  if (!looks.fault.empty()) throw Error(looks.fault);
  mesh.positions =
      read_vectors(accessors_.of(attributes.at("POSITION").index(INT32_MAX)), label, "position");
  if (const auto normals = attributes.find("NORMAL")) {
    mesh.normals = read_vectors(accessors_.of(normals->index(INT32_MAX)), label, "normal");
  }
  read_uvs(attributes, label, mesh);
  if (const auto colors = attributes.find("COLOR_0")) {
    mesh.colors = read_colors(accessors_.of(colors->index(INT32_MAX)), label);
  }
  return mesh;
}

Mesh GltfMeshes::read_part(const JsonPlace& primitive, const std::string& label,
                           const GltfPose& pose, std::int64_t& skipped) const {
  const GltfMode mode = gltf_mode_of(primitive);
  const std::size_t corners = corners_of(primitive);
  const std::size_t vertices =
      accessors_.count(primitive.at("attributes").at("POSITION").index(INT32_MAX));
  budget_.take(static_cast<std::int64_t>(vertices * kBytesAVertex +
                                         3 * triangle_count(mode, corners) * sizeof(std::uint32_t)),
               label);
  Mesh mesh = read_vertices(primitive, label);
  apply_morph_targets(primitive, pose.weights, accessors_, budget_, warnings_, label, mesh);
  std::vector<bool> mirrored;
  if (pose.joints) {
    mirrored = apply_skin(primitive, *pose.joints, accessors_, budget_, label, mesh);
  }
  expect_finite(mesh.positions, label, "posed position");
  expect_finite(mesh.normals, label, "posed normal");
  std::optional<GltfElements> indices;
  if (const auto use = primitive.find("indices")) indices = accessors_.of(use->index(INT32_MAX));
  skipped += add_triangles(mesh, mode, corners, label, [&](std::size_t corner) {
    return indices ? indices->integer(corner, 0) : static_cast<std::uint32_t>(corner);
  });
  if (pose.joints) turn_mirrored(mirrored, mesh);
  make_unit_normals(mesh);
  return mesh;
}

GltfMesh GltfMeshes::read(int index, const GltfPose& pose) const {
  const JsonPlace& place = mesh_of(index);
  const std::string label = gltf_label(place);
  const auto name = place.find("name");
  // Nodes may have weights for a mesh without triangles.
  budget_.take(pose.weights.size(), sizeof(double), label);
  budget_.take(place.count("primitives"), sizeof(Mesh), label);
  GltfMesh read;
  for (const JsonPlace& primitive : place.list("primitives")) {
    if (!is_drawn(primitive, label)) continue;
    Mesh mesh = read_part(primitive, label, pose, read.skipped_triangles);
    if (name) mesh.name = name->text();
    if (!mesh.indices.empty()) read.parts.push_back(std::move(mesh));
  }
  return read;
}

}  // namespace limpid
