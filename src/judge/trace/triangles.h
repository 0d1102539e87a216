#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "judge/trace/beam.h"

namespace limpid::trace {

/// Which sides of triangles a ray can hit. Corners run counter-clockwise around the front.
enum class Sides : std::uint8_t {
  kShown,  ///< as each part says
  kFront,
  kBack,
};

/// Says of points of a triangle whether anything is there.
class PointTest {
 public:
  virtual ~PointTest() = default;
  /// `shares` of the corners.
  virtual bool there(std::uint32_t part, std::uint32_t triangle,
                     const glm::dvec3& shares) const = 0;
};

/// Triangles that rays are traced through: Embree behind an interface. It searches in float; where
/// exactly a ray meets the triangle that was found is worked out in double, by its plane.
class Triangles {
 public:
  struct Part {
    std::vector<glm::dvec3> positions;
    std::vector<std::uint32_t> indices;  ///< three a triangle
    bool back_shown = true;              ///< for Sides::kShown
    bool tested = false;                 ///< where it is, a PointTest says
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
    double slack = 0;     ///< as far off its triangle as the search may see the point
    friend bool operator==(const Hit&, const Hit&) = default;
  };

  /// Each part must have triangles. Throws Error where memory ends.
  explicit Triangles(std::vector<Part> parts);
  ~Triangles();

  /// Without a test, parts that are tested are there everywhere.
  std::optional<Hit> nearest(const Ray& ray, Sides sides, const PointTest* test = nullptr) const;
  /// Whether anything, from whichever side, is in the ray's way.
  bool block(const Ray& ray, const PointTest* test = nullptr) const;

  bool empty() const { return parts_.empty(); }
  Corners corners(std::uint32_t part, std::uint32_t triangle) const;
  const std::vector<Part>& parts() const { return parts_; }

 private:
  struct State;
  std::vector<Part> parts_;
  std::unique_ptr<State> state_;
};

/// Those triangles, of three indices each, that have an area.
std::vector<std::uint32_t> with_area(const std::vector<glm::dvec3>& positions,
                                     std::span<const std::uint32_t> indices);

/// Shares of the corners in a point of the triangle's plane; outside of it some are below 0.
glm::dvec3 corner_shares(const Triangles::Corners& corners, const glm::dvec3& point);

}  // namespace limpid::trace
