#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "judge/trace/beam.h"

namespace limpid::trace {

/// The sides of triangles that a ray can hit. Corners run counter-clockwise around the front.
enum class Sides : std::uint8_t {
  kShown,  ///< by the setting of each part
  kFront,
  kBack,
};

/// Tests whether points of a triangle exist.
class PointTest {
 public:
  virtual ~PointTest() = default;
  /// `shares`: barycentric coordinates.
  virtual bool there(std::uint32_t part, std::uint32_t triangle,
                     const glm::dvec3& shares) const = 0;
};

/// Triangles for ray tracing: Embree behind an interface. It searches in float; the exact point on
/// the triangle found is computed in double, from its plane.
class Triangles {
 public:
  struct Part {
    std::vector<glm::dvec3> positions;
    std::vector<std::uint32_t> indices;  ///< three per triangle
    bool back_shown = true;              ///< for Sides::kShown
    bool tested = false;                 ///< whether a PointTest decides
  };
  struct Corners {
    glm::dvec3 a, b, c;
    glm::dvec3 cross() const { return glm::cross(b - a, c - a); }
  };
  struct Hit {
    std::uint32_t part = 0, triangle = 0;
    double distance = 0;
    glm::dvec3 point{0};
    glm::dvec3 front{0};  ///< unit normal of the front side
    double slack = 0;     ///< how far off its triangle the search may report the point
    friend bool operator==(const Hit&, const Hit&) = default;
  };

  /// Each part must have triangles. Throws Error if memory runs out.
  explicit Triangles(std::vector<Part> parts);
  ~Triangles();

  /// Without a test, all points of tested parts exist.
  std::optional<Hit> nearest(const Ray& ray, Sides sides, const PointTest* test = nullptr) const;
  /// Whether any triangle, from either side, blocks the ray.
  bool block(const Ray& ray, const PointTest* test = nullptr) const;

  bool empty() const { return parts_.empty(); }
  Corners corners(std::uint32_t part, std::uint32_t triangle) const;
  const std::vector<Part>& parts() const { return parts_; }

 private:
  struct State;
  std::vector<Part> parts_;
  std::unique_ptr<State> state_;
};

/// The triangles, of three indices each, with nonzero area.
std::vector<std::uint32_t> with_area(const std::vector<glm::dvec3>& positions,
                                     std::span<const std::uint32_t> indices);

/// Barycentric coordinates of a point of the triangle's plane; outside of it some are below 0.
glm::dvec3 corner_shares(const Triangles::Corners& corners, const glm::dvec3& point);

}  // namespace limpid::trace
