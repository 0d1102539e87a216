#include "raster/prepared.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "limpid/core/error.h"

#include "raster/material_view.h"

namespace limpid::raster {
namespace {

void expect_index(const std::string& what, std::int64_t index, std::size_t count) {
  if (index < 0 || index >= static_cast<std::int64_t>(count)) {
    throw Error(what + " = " + std::to_string(index) + ": expected less than " +
                std::to_string(count));
  }
}

glm::dvec3 face_normal(const Mesh& mesh, std::size_t first_index) {
  const auto corner = [&](std::size_t k) {
    return glm::dvec3(mesh.positions[mesh.indices[first_index + k]]);
  };
  return glm::cross(corner(1) - corner(0), corner(2) - corner(0));
}

void check(const Mesh& mesh, const Model& model) {
  const std::string name = "mesh '" + mesh.name + "'";
  if (mesh.indices.size() % 3 != 0) {
    throw Error(name + " has " + std::to_string(mesh.indices.size()) +
                " indices, expected three a triangle");
  }
  if (mesh.indices.size() / 3 > (1u << 28) || mesh.positions.size() > (1u << 28)) {
    throw Error(name + " has more than 2^28 vertices or triangles");
  }
  for (std::uint32_t index : mesh.indices) {
    if (index >= mesh.positions.size())
      expect_index(name + ": index", index, mesh.positions.size());
  }
  const auto fits = [&](std::size_t size) { return size == 0 || size == mesh.positions.size(); };
  if (!fits(mesh.normals.size()) || !fits(mesh.uvs.size())) {
    throw Error(name + " has " + std::to_string(mesh.positions.size()) + " positions, " +
                std::to_string(mesh.normals.size()) + " normals and " +
                std::to_string(mesh.uvs.size()) + " uvs, expected one a vertex or none");
  }
  if (!fits(mesh.second_uvs.size()) || !fits(mesh.colors.size())) {
    throw Error(name + " has " + std::to_string(mesh.positions.size()) + " positions, " +
                std::to_string(mesh.second_uvs.size()) + " second uvs and " +
                std::to_string(mesh.colors.size()) + " colors, expected one a vertex or none");
  }
  expect_index(name + ": material", mesh.material, model.materials.size());
}

/// Gives each triangle three vertices of its own, with the face's normal.
void split_faces(const Mesh& mesh, PreparedMesh& out) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::dvec3 normal = face_normal(mesh, i);
    const double size = glm::length(normal);
    const glm::vec3 unit(size > 0 ? normal / size : normal);
    for (std::size_t k = i; k < i + 3; ++k) {
      const glm::vec3& p = mesh.positions[mesh.indices[k]];
      out.positions.insert(out.positions.end(), {p.x, p.y, p.z});
      out.normals.insert(out.normals.end(), {unit.x, unit.y, unit.z});
      if (!mesh.uvs.empty()) {
        const glm::vec2& uv = mesh.uvs[mesh.indices[k]];
        out.uvs.insert(out.uvs.end(), {uv.x, uv.y});
      }
      if (!mesh.second_uvs.empty()) {
        const glm::vec2& uv = mesh.second_uvs[mesh.indices[k]];
        out.second_uvs.insert(out.second_uvs.end(), {uv.x, uv.y});
      }
      if (!mesh.colors.empty()) {
        const glm::vec4& c = mesh.colors[mesh.indices[k]];
        out.colors.insert(out.colors.end(), {c.r, c.g, c.b, c.a});
      }
      out.indices.push_back(static_cast<std::uint32_t>(k));
    }
  }
  const auto some = [](const std::vector<float>& list) {
    return list.empty() ? nullptr : list.data();
  };
  out.view = {out.positions.data(), out.normals.data(), some(out.uvs),
              some(out.second_uvs), some(out.colors),   out.indices.data()};
  out.vertices = static_cast<std::uint32_t>(mesh.indices.size());
}

PreparedMesh prepared(const Mesh& mesh) {
  PreparedMesh out;
  out.triangles = static_cast<std::uint32_t>(mesh.indices.size() / 3);
  if (out.triangles == 0) return out;
  if (mesh.normals.empty()) {
    split_faces(mesh, out);
  } else {
    const auto some = [](const auto& list) { return list.empty() ? nullptr : &list[0].x; };
    out.view = {&mesh.positions[0].x,  &mesh.normals[0].x, some(mesh.uvs),
                some(mesh.second_uvs), some(mesh.colors),  mesh.indices.data()};
    out.vertices = static_cast<std::uint32_t>(mesh.positions.size());
  }
  return out;
}

}  // namespace

MoreAttributes more_of(const MeshView& mesh, std::uint32_t vertex) {
  MoreAttributes more;
  if (mesh.colors) {
    const float* color = mesh.colors + 4 * std::ptrdiff_t{vertex};
    std::copy(color, color + 4, more.color);
  }
  if (mesh.second_uvs) {
    more.u = mesh.second_uvs[2 * std::ptrdiff_t{vertex}];
    more.v = mesh.second_uvs[2 * std::ptrdiff_t{vertex} + 1];
  }
  return more;
}

PreparedModel::PreparedModel(const Model& from) : model(from) {
  static_assert(sizeof(glm::vec4) == 16 && sizeof(glm::vec3) == 12 && sizeof(glm::vec2) == 8);
  if (model.materials.empty()) throw Error("model without materials: expected at least one");
  for (const ModelTexture& texture : model.textures) pyramids.emplace_back(texture);
  for (const Material& m : model.materials) {
    materials.push_back(material_view(m, model, pyramids, {}));
  }
  std::vector<std::int64_t> degenerate;
  for (const Mesh& mesh : model.meshes) {
    check(mesh, model);
    meshes.push_back(prepared(mesh));
    meshes.back().material = mesh.material;
    if (!mesh.colors.empty()) {
      meshes.back().material = static_cast<int>(materials.size());
      const Material& m = model.materials[static_cast<std::size_t>(mesh.material)];
      materials.push_back(material_view(m, model, pyramids, mesh.colors));
    }
    degenerate.push_back(0);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const glm::dvec3 n = face_normal(mesh, i);
      degenerate.back() += !(std::abs(n.x) + std::abs(n.y) + std::abs(n.z) > 0);
    }
  }
  std::int64_t vertices = 0;
  for (const Instance& instance : model.instances) {
    expect_index("instance: mesh", instance.mesh, meshes.size());
    vertices += meshes[static_cast<std::size_t>(instance.mesh)].vertices;
    degenerate_triangles += degenerate[static_cast<std::size_t>(instance.mesh)];
  }
  if (vertices > (1 << 28)) {
    throw Error("model with " + std::to_string(vertices) + " vertices: expected at most 2^28");
  }
}

}  // namespace limpid::raster
