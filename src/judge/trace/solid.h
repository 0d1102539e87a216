#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include <glm/vec4.hpp>

#include "limpid/raster/model.h"

#include "judge/trace/texture.h"
#include "judge/trace/triangles.h"
#include "raster/prepared.h"

namespace limpid::trace {

/// Sunlight that arrives at a point.
struct Sunlight {
  glm::dvec3 to_sun{0};  ///< unit
  double spread = 1;     ///< share of the sun's own irradiance on a surface that faces it
  Rgb<double> color{0, 0, 0};
};

/// A point of a dry surface, on the visible side.
struct SolidPoint {
  Triangles::Hit hit;
  glm::dvec3 face{0};    ///< unit normal of the triangle
  glm::dvec3 normal{0};  ///< unit, for shading
  glm::dvec3 smooth{0};  ///< the point on the smooth surface of the normals
  int material = 0;
  std::array<TexturePlace, 2> places;  ///< of each set of uvs
  glm::dvec4 color{1};                 ///< of the vertices
  double opacity = 1;                  ///< below 1 a surface behind it is visible as well

  /// The origin of a ray from here in that direction that meets neither its own triangle nor the
  /// facets of a smooth surface.
  glm::dvec3 off_towards(const glm::dvec3& direction) const;
};

/// The points of blended surfaces that exist: AlphaMode. Masked surfaces are the same for all.
enum class Opacity : std::uint8_t { kSeen, kBlocking, kSolid };

/// A model without its water, relative to an eye.
class Solid {
 public:
  /// Throws Error for a model that the rasteriser refuses.
  Solid(const Model& model, const glm::dvec3& eye);

  std::optional<SolidPoint> nearest(const Beam& beam, Opacity least) const;
  /// The surface in a depth buffer. Rays have no footprint: opacity is that of the finest mip
  /// level.
  std::optional<Triangles::Hit> nearest(const Ray& ray) const;
  bool blocks(const Ray& ray) const;

  /// The light reflected back along the beam, by the material. `visible` returns the sun's
  /// visibility, 0 ... 1; called only if it matters.
  template <class Visible>
  Rgb<double> color(const SolidPoint& point, const Beam& beam, const Sunlight& sun,
                    Visible&& visible) const {
    const double cosine = glm::dot(point.normal, sun.to_sun);
    const bool lit = is_lit(point) && sun.color != Rgb<double>{0, 0, 0} && cosine > 0;
    return shaded(point, -beam.ray.direction, sun, lit ? visible() : 0.0);
  }

  /// The part of color() from all around: the ambient light of the material, and all light of an
  /// unlit surface.
  Rgb<double> ambient_light(const SolidPoint& point) const;
  /// Share of indirect light that the surface reflects diffusely, 0 ... 1.
  Rgb<double> albedo(const SolidPoint& point) const;

 private:
  struct Source {  ///< the mesh of a part of the triangles
    const raster::PreparedMesh* mesh;
    std::vector<glm::dvec3> normals;
    int material;
  };

  class Test;

  const raster::MaterialView& material_of(std::uint32_t part) const {
    return model_.materials[static_cast<std::size_t>(sources_[part].material)];
  }
  const std::uint32_t* corner_numbers(std::uint32_t part, std::uint32_t triangle) const {
    return triangles_.parts()[part].indices.data() + 3 * std::size_t{triangle};
  }
  std::array<TexturePlace, 2> places_at(std::uint32_t part, std::uint32_t triangle,
                                        const glm::dvec3& shares, const Beam* beam) const;
  glm::dvec4 color_at(std::uint32_t part, std::uint32_t triangle, const glm::dvec3& shares) const;
  double opacity_at(std::uint32_t part, std::uint32_t triangle, const glm::dvec3& shares,
                    const Beam* beam) const;
  bool is_lit(const SolidPoint& point) const;
  Rgb<double> base_color(const SolidPoint& point) const;
  Rgb<double> shaded(const SolidPoint& point, const glm::dvec3& to_viewer, const Sunlight& sun,
                     double visible) const;
  void add(const Instance& instance, const glm::dvec3& eye, std::vector<Triangles::Part>& parts);
  Triangles made(const glm::dvec3& eye);

  raster::PreparedModel model_;
  std::vector<Source> sources_;
  Triangles triangles_;
};

}  // namespace limpid::trace
