#include "trace/solid.h"

#include <algorithm>
#include <array>

#include <glm/mat3x3.hpp>

#include "limpid/optics/shading.h"

#include "trace/texture.h"

namespace limpid::trace {
namespace {

Rgb<double> rgb_of(const float (&c)[3]) { return {c[0], c[1], c[2]}; }

glm::dvec3 vertex(const float* floats, std::uint32_t index) {
  const float* p = floats + 3 * std::size_t{index};
  return {p[0], p[1], p[2]};
}

glm::dvec2 uv_at(const float* uvs, const std::uint32_t* corner, const glm::dvec3& shares) {
  glm::dvec2 uv(0);
  for (int k = 0; k < 3; ++k) {
    const float* at = uvs + 2 * std::size_t{corner[k]};
    uv += shares[k] * glm::dvec2(at[0], at[1]);
  }
  return uv;
}

/// Where a surface that has these normals at its corners would lie: on the planes across them,
/// mixed as the corners are, but never under the triangle. Hanika 2021, "Hacking the Shadow
/// Terminator".
glm::dvec3 rounded(const glm::dvec3& point, const glm::dvec3& shares,
                   const std::array<glm::dvec3, 3>& corners,
                   const std::array<glm::dvec3, 3>& normals) {
  glm::dvec3 lifted = point;
  for (std::size_t k = 0; k < 3; ++k) {
    const double under = std::min(glm::dot(point - corners[k], normals[k]), 0.0);
    lifted -= shares[static_cast<int>(k)] * under * normals[k];
  }
  return lifted;
}

}  // namespace

glm::dvec3 SolidPoint::off_towards(const glm::dvec3& direction) const {
  return smooth + (glm::dot(face, direction) < 0 ? -hit.slack : hit.slack) * face;
}

Solid::Solid(const Model& model, const glm::dvec3& eye) : model_(model), triangles_(made(eye)) {}

Triangles Solid::made(const glm::dvec3& eye) {
  std::vector<Triangles::Part> parts;
  for (const Instance& instance : model_.model.instances) {
    if (!instance.water) add(instance, eye, parts);
  }
  return Triangles(std::move(parts));
}

void Solid::add(const Instance& instance, const glm::dvec3& eye,
                std::vector<Triangles::Part>& parts) {
  const std::size_t number = static_cast<std::size_t>(instance.mesh);
  const raster::PreparedMesh& mesh = model_.meshes[number];
  const int material = model_.model.meshes[number].material;
  // Cofactors: the inverse transpose, but for its length.
  const glm::dmat3 m(instance.world_from_mesh);
  const glm::dmat3 turn(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  Triangles::Part part;
  Source source{&mesh, {}, material};
  part.back_shown = model_.model.materials[static_cast<std::size_t>(material)].double_sided;
  for (std::uint32_t i = 0; i < mesh.vertices; ++i) {
    const glm::dvec4 p(vertex(mesh.view.positions, i), 1);
    part.positions.push_back(glm::dvec3(instance.world_from_mesh * p) - eye);
    const glm::dvec3 normal = turn * vertex(mesh.view.normals, i);
    const double size = glm::length(normal);
    source.normals.push_back(size > 0 ? normal / size : normal);
  }
  part.indices = with_area(part.positions, {mesh.view.indices, 3 * std::size_t{mesh.triangles}});
  if (part.indices.empty()) return;
  parts.push_back(std::move(part));
  sources_.push_back(std::move(source));
}

std::optional<SolidPoint> Solid::nearest(const Beam& beam) const {
  const std::optional<Triangles::Hit> hit = nearest(beam.ray);
  if (!hit) return std::nullopt;
  const Source& source = sources_[hit->part];
  const Triangles::Corners corners = triangles_.corners(hit->part, hit->triangle);
  const std::uint32_t* corner =
      triangles_.parts()[hit->part].indices.data() + 3 * std::size_t{hit->triangle};
  const glm::dvec3 shares = corner_shares(corners, hit->point);

  SolidPoint point;
  point.hit = *hit;
  point.material = source.material;
  const bool back = glm::dot(hit->front, beam.ray.direction) > 0;
  point.face = back ? -hit->front : hit->front;
  glm::dvec3 normal(0);
  std::array<glm::dvec3, 3> normals;
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3& own = source.normals[corner[k]];
    normal += shares[k] * own;
    normals[static_cast<std::size_t>(k)] = back ? -own : own;
  }
  point.smooth = rounded(hit->point, shares, {corners.a, corners.b, corners.c}, normals);
  const Vec3<double> unit = normalize_or(formula_of(normal), formula_of(-beam.ray.direction));
  point.normal = back ? -glm_of(unit) : glm_of(unit);
  const float* uvs = source.mesh->view.uvs;
  if (!uvs) return point;
  const auto seen_by = [&](const Ray& ray) {
    const glm::dvec3 at = ray.at(distance_to_plane(ray, corners.a, hit->front));
    return uv_at(uvs, corner, corner_shares(corners, at));
  };
  point.uv = uv_at(uvs, corner, shares);
  point.uv_dx = seen_by(beam.right) - point.uv;
  point.uv_dy = seen_by(beam.below) - point.uv;
  return point;
}

bool Solid::is_lit(const SolidPoint& point) const {
  const Shading shading = model_.materials[static_cast<std::size_t>(point.material)].shading;
  return shading != Shading::kFlat && shading != Shading::kTextured;
}

Rgb<double> Solid::shaded(const SolidPoint& point, const glm::dvec3& to_viewer, const Sunlight& sun,
                          double visible) const {
  const raster::MaterialView& m = model_.materials[static_cast<std::size_t>(point.material)];
  const auto textured = [&](const float(&color)[3], const raster::PyramidView* texture) {
    const Rgb<double> plain = rgb_of(color);
    return texture ? plain * sample(*texture, point.uv, point.uv_dx, point.uv_dy) : plain;
  };
  const Rgb<double> base = textured(m.base, m.base_texture), ambient = rgb_of(m.ambient);
  // Of the sun's own irradiance.
  const double cosine = sun.spread * glm::dot(point.normal, sun.to_sun);
  switch (m.shading) {
    case Shading::kFlat:
    case Shading::kTextured:
      return base;
    case Shading::kLambert:
      return lambert_shading(base, ambient, cosine, visible, sun.color);
    case Shading::kToon:
      return toon_shading(base, ambient, cosine, visible, sun.color);
    case Shading::kPhong:
      return lambert_shading(base, ambient, cosine, visible, sun.color) +
             phong_glint(textured(m.specular, m.specular_texture), double(m.power),
                         formula_of(point.normal), formula_of(to_viewer), formula_of(sun.to_sun),
                         visible, sun.spread * sun.color);
  }
  return base;
}

}  // namespace limpid::trace
