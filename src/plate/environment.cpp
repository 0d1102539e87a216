#include "plate/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace limpid {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double mix(double a, double b, double t) { return a + t * (b - a); }

/// Columns are mirrored and rotated; rows stay.
Plane turned(const View<const float>& file, double rotation) {
  const Rect& from = file.window;
  const int width = from.width();
  // Column x shows the file's column width - 1 - x + shift, split into an integer and a fraction.
  const double shift = std::remainder(rotation, kTurn) / kTurn * width;
  const double whole = std::floor(shift + 1e-6);
  const double rest = shift - whole < 1e-6 ? 0 : shift - whole;
  const auto column = [&](int x) { return from.x0 + ((x % width) + width) % width; };
  Plane plane(rect_of({width, from.height()}));
  for (int y = 0; y < from.height(); ++y) {
    for (int x = 0; x < width; ++x) {
      const int at = width - 1 - x + static_cast<int>(whole);
      const double a = file.at(column(at), from.y0 + y), b = file.at(column(at + 1), from.y0 + y);
      plane.view().at(x, y) = static_cast<float>(mix(a, b, rest));
    }
  }
  return plane;
}

/// A face of the cube and the directions of right and down in its picture, as in ImfEnvmap.h.
struct Face {
  glm::dvec3 front, right, down;
};
constexpr Face kFaces[] = {
    {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},  {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}},  {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
    {{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}}, {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}},
};

/// Four texels of a face and their weights in bilinear filtering.
struct Tap {
  int x0, x1, y0, y1;
  double along, down;

  double of(const View<const float>& file) const {
    const auto at = [&](int x, int y) -> double {
      return file.at(file.window.x0 + x, file.window.y0 + y);
    };
    return mix(mix(at(x0, y0), at(x1, y0), along), mix(at(x0, y1), at(x1, y1), along), down);
  }
};

Tap tap_at(const glm::dvec3& direction, int side) {
  int face = 0;
  for (int f = 1; f < 6; ++f) {
    if (glm::dot(kFaces[f].front, direction) > glm::dot(kFaces[face].front, direction)) face = f;
  }
  const double depth = glm::dot(kFaces[face].front, direction);
  const auto place = [&](const glm::dvec3& axis) {
    return 0.5 * (glm::dot(axis, direction) / depth + 1) * (side - 1);
  };
  const double x = place(kFaces[face].right), y = place(kFaces[face].down);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y), top = face * side;
  return {x0,    std::min(x0 + 1, side - 1), top + y0, top + std::min(y0 + 1, side - 1), x - x0,
          y - y0};
}

/// The file's +Y is up, its +Z in the middle.
std::vector<Plane> unfolded(std::span<const Plane> file, double rotation) {
  const int side = file[0].view().window.width();
  const Size size = lat_long_of_cube(side);
  std::vector<Plane> planes;
  for (std::size_t c = 0; c < file.size(); ++c) planes.emplace_back(rect_of(size));
  for (int y = 0; y < size.height; ++y) {
    const double latitude = std::numbers::pi * (0.5 - (y + 0.5) / size.height);
    for (int x = 0; x < size.width; ++x) {
      const double longitude = kTurn * ((x + 0.5) / size.width - 0.5) - rotation;
      const Tap tap = tap_at({std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                              std::cos(latitude) * std::cos(longitude)},
                             side);
      for (std::size_t c = 0; c < file.size(); ++c) {
        planes[c].view().at(x, y) = static_cast<float>(tap.of(file[c].view()));
      }
    }
  }
  return planes;
}

}  // namespace

Size lat_long_of_cube(int face) { return {4 * face, 2 * face}; }

std::vector<Plane> environment_planes(std::span<const Plane> file, EnvironmentLayout layout,
                                      double rotation) {
  if (layout == EnvironmentLayout::kCube) return unfolded(file, rotation);
  std::vector<Plane> planes;
  for (const Plane& plane : file) planes.push_back(turned(plane.view(), rotation));
  return planes;
}

}  // namespace limpid
