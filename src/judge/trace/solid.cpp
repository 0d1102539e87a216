#include "judge/trace/solid.h"

#include <algorithm>
#include <array>

#include <glm/mat3x3.hpp>

#include "optics/shading.h"

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

/// White without a texture.
Texel texel_of(const raster::PyramidView* texture, const TextureLookup& lookup,
               const std::array<TexturePlace, 2>& places) {
  if (!texture) return {};
  return sample(*texture, lookup, places[static_cast<std::size_t>(lookup.uv_set)]);
}

/// The point on a smooth surface with these normals at its corners: on the planes normal to them,
/// interpolated like the corners, but never under the triangle. Hanika 2021, "Hacking the Shadow
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

/// Rejects holes of masked surfaces, and blended surfaces below a threshold of opacity.
class Solid::Test final : public PointTest {
 public:
  Test(const Solid& solid, Opacity least, const Beam* beam = nullptr)
      : solid_(solid), least_(least), beam_(beam) {}

  bool there(std::uint32_t part, std::uint32_t triangle, const glm::dvec3& shares) const override {
    const raster::MaterialView& m = solid_.material_of(part);
    const bool blends = m.alpha_mode == AlphaMode::kBlend;
    const double from = blends && least_ == Opacity::kSeen ? kSeenFrom
                        : least_ == Opacity::kBlocking     ? double{m.blocks_from}
                                                           : double{m.solid_from};
    return solid_.opacity_at(part, triangle, shares, beam_) >= from;
  }

 private:
  const Solid& solid_;
  Opacity least_;
  const Beam* beam_;
};

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
  // Cofactors: the inverse transpose, up to its length.
  const glm::dmat3 m(instance.world_from_mesh);
  const glm::dmat3 turn(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  Triangles::Part part;
  Source source{&mesh, {}, mesh.material};
  const int material = model_.model.meshes[number].material;
  part.back_shown = model_.model.materials[static_cast<std::size_t>(material)].double_sided;
  part.tested =
      model_.materials[static_cast<std::size_t>(mesh.material)].alpha_mode != AlphaMode::kOpaque;
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

std::array<TexturePlace, 2> Solid::places_at(std::uint32_t part, std::uint32_t triangle,
                                             const glm::dvec3& shares, const Beam* beam) const {
  const raster::MeshView& mesh = sources_[part].mesh->view;
  const std::uint32_t* corner = corner_numbers(part, triangle);
  std::array<TexturePlace, 2> places;
  for (std::size_t set = 0; set < 2; ++set) {
    const float* uvs = set == 0 ? mesh.uvs : mesh.second_uvs;
    if (!uvs) continue;
    TexturePlace& place = places[set];
    place.uv = uv_at(uvs, corner, shares);
    if (!beam) continue;
    const Triangles::Corners corners = triangles_.corners(part, triangle);
    const glm::dvec3 front = glm::normalize(corners.cross());
    const auto seen_by = [&](const Ray& ray) {
      const glm::dvec3 at = ray.at(distance_to_plane(ray, corners.a, front));
      return uv_at(uvs, corner, corner_shares(corners, at));
    };
    place.dx = seen_by(beam->right) - place.uv;
    place.dy = seen_by(beam->below) - place.uv;
  }
  return places;
}

glm::dvec4 Solid::color_at(std::uint32_t part, std::uint32_t triangle,
                           const glm::dvec3& shares) const {
  const float* colors = sources_[part].mesh->view.colors;
  if (!colors) return glm::dvec4(1);
  const std::uint32_t* corner = corner_numbers(part, triangle);
  glm::dvec4 color(0);
  for (int k = 0; k < 3; ++k) {
    const float* at = colors + 4 * std::size_t{corner[k]};
    color += shares[k] * glm::dvec4(at[0], at[1], at[2], at[3]);
  }
  return color;
}

double Solid::opacity_at(std::uint32_t part, std::uint32_t triangle, const glm::dvec3& shares,
                         const Beam* beam) const {
  const raster::MaterialView& m = material_of(part);
  double opacity = m.alpha;
  if (m.base_texture) {
    const std::array<TexturePlace, 2> places = places_at(part, triangle, shares, beam);
    opacity *= texel_of(m.base_texture, m.base_lookup, places).alpha;
  }
  return std::min(opacity * color_at(part, triangle, shares).a, 1.0);
}

std::optional<Triangles::Hit> Solid::nearest(const Ray& ray) const {
  const Test test(*this, Opacity::kBlocking);
  return triangles_.nearest(ray, Sides::kShown, &test);
}

bool Solid::blocks(const Ray& ray) const {
  const Test test(*this, Opacity::kBlocking);
  return triangles_.block(ray, &test);
}

std::optional<SolidPoint> Solid::nearest(const Beam& beam, Opacity least) const {
  const Test test(*this, least, &beam);
  const std::optional<Triangles::Hit> hit = triangles_.nearest(beam.ray, Sides::kShown, &test);
  if (!hit) return std::nullopt;
  const Source& source = sources_[hit->part];
  const Triangles::Corners corners = triangles_.corners(hit->part, hit->triangle);
  const std::uint32_t* corner = corner_numbers(hit->part, hit->triangle);
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
  point.places = places_at(hit->part, hit->triangle, shares, &beam);
  point.color = color_at(hit->part, hit->triangle, shares);
  const raster::MaterialView& m = material_of(hit->part);
  if (m.alpha_mode == AlphaMode::kBlend) {
    const double opacity = opacity_at(hit->part, hit->triangle, shares, &beam);
    point.opacity = opacity < m.solid_from ? opacity : 1;
  }
  return point;
}

bool Solid::is_lit(const SolidPoint& point) const {
  const Shading shading = model_.materials[static_cast<std::size_t>(point.material)].shading;
  return shading != Shading::kFlat && shading != Shading::kTextured;
}

Rgb<double> Solid::base_color(const SolidPoint& point) const {
  const raster::MaterialView& m = model_.materials[static_cast<std::size_t>(point.material)];
  const Rgb<double> tint{point.color.r, point.color.g, point.color.b};
  return tint * rgb_of(m.base) * texel_of(m.base_texture, m.base_lookup, point.places).color;
}

Rgb<double> Solid::ambient_light(const SolidPoint& point) const {
  const Rgb<double> base = base_color(point);
  if (!is_lit(point)) return base;
  return base * rgb_of(model_.materials[static_cast<std::size_t>(point.material)].ambient);
}

Rgb<double> Solid::albedo(const SolidPoint& point) const {
  if (!is_lit(point)) return {0, 0, 0};
  const Rgb<double> base = base_color(point);
  return {saturate(base.r), saturate(base.g), saturate(base.b)};
}

Rgb<double> Solid::shaded(const SolidPoint& point, const glm::dvec3& to_viewer, const Sunlight& sun,
                          double visible) const {
  const raster::MaterialView& m = model_.materials[static_cast<std::size_t>(point.material)];
  const auto textured = [&](const float(&color)[3], const raster::PyramidView* texture,
                            const TextureLookup& lookup) {
    return rgb_of(color) * texel_of(texture, lookup, point.places).color;
  };
  const Rgb<double> tint{point.color.r, point.color.g, point.color.b};
  const Rgb<double> base = tint * textured(m.base, m.base_texture, m.base_lookup),
                    ambient = rgb_of(m.ambient);
  // Relative to the sun's own irradiance.
  const double cosine = sun.spread * glm::dot(point.normal, sun.to_sun);
  const Rgb<double> emitted = textured(m.emission, m.emissive_texture, m.emissive_lookup);
  switch (m.shading) {
    case Shading::kFlat:
    case Shading::kTextured:
      return emitted + base;
    case Shading::kLambert:
      return emitted + lambert_shading(base, ambient, cosine, visible, sun.color);
    case Shading::kToon:
      return emitted + toon_shading(base, ambient, cosine, visible, sun.color);
    case Shading::kPhong:
      return emitted + lambert_shading(base, ambient, cosine, visible, sun.color) +
             phong_glint(textured(m.specular, m.specular_texture, m.specular_lookup),
                         double(m.power), formula_of(point.normal), formula_of(to_viewer),
                         formula_of(sun.to_sun), visible, sun.spread * sun.color);
  }
  return base;
}

}  // namespace limpid::trace
