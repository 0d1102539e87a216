#include "raster/clip.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "raster/prepared.h"

namespace limpid::raster {
namespace {

/// Normal and uv; for a mesh that has any of them, also color and second uv.
constexpr std::size_t kFew = 5, kAll = 11;

struct Vertex {
  std::array<double, VertexTransform::kRows> row;
  std::array<double, kAll> attribute;
  std::size_t attributes;         ///< number of attributes
  const Corner* whole = nullptr;  ///< the corner of the vertex stage, if it was inside

  double w(const VertexTransform& t) const {
    return t.perspective ? row[VertexTransform::kDepth] : 1;
  }
};

constexpr int kPlanes = 7;

/// In the order of ClipBits.
double signed_distance(const VertexTransform& t, const Vertex& v, int plane) {
  const double reach = kGuard * v.w(t);
  switch (plane) {
    case 0:
      return v.row[VertexTransform::kNearDistance];
    case 1:
      return v.row[VertexTransform::kFarDistance];
    case 2:
      return v.row[VertexTransform::kUserDistance];
    case 3:
      return reach + v.row[VertexTransform::kX];
    case 4:
      return reach - v.row[VertexTransform::kX];
    case 5:
      return reach + v.row[VertexTransform::kY];
    default:
      return reach - v.row[VertexTransform::kY];
  }
}

/// A vertex that the vertex stage found inside is inside here, too, in spite of rounding: unclipped
/// neighbours share it.
double distance(const VertexTransform& t, const Vertex& v, int plane) {
  const double d = signed_distance(t, v, plane);
  return v.whole ? std::max(d, 0.0) : d;
}

struct Polygon {
  std::array<Vertex, 3 + kPlanes> corners;
  int count = 0;
  void add(const Vertex& v) { corners[static_cast<std::size_t>(count++)] = v; }
};

/// Always from the inside out, so that both triangles of an edge compute the same point.
Vertex between(const Vertex& inside, const Vertex& outside, double t) {
  Vertex v;
  for (std::size_t i = 0; i < v.row.size(); ++i) {
    v.row[i] = inside.row[i] + t * (outside.row[i] - inside.row[i]);
  }
  v.attributes = inside.attributes;
  for (std::size_t i = 0; i < v.attributes; ++i) {
    v.attribute[i] = inside.attribute[i] + t * (outside.attribute[i] - inside.attribute[i]);
  }
  return v;
}

void cut(const VertexTransform& transform, int plane, Polygon& polygon) {
  Polygon kept;
  for (int i = 0; i < polygon.count; ++i) {
    const Vertex& a = polygon.corners[static_cast<std::size_t>(i)];
    const Vertex& b = polygon.corners[static_cast<std::size_t>((i + 1) % polygon.count)];
    const double at_a = distance(transform, a, plane), at_b = distance(transform, b, plane);
    if (at_a >= 0) kept.add(a);
    if (at_a >= 0 && at_b < 0) kept.add(between(a, b, at_a / (at_a - at_b)));
    if (at_a < 0 && at_b >= 0) kept.add(between(b, a, at_b / (at_b - at_a)));
  }
  polygon = kept;
}

Vertex transformed(const DrawnInstance& instance, const Corner* corners, std::uint32_t index) {
  const float* p = instance.mesh.positions + 3 * std::ptrdiff_t{index};
  const float* n = instance.mesh.normals + 3 * std::ptrdiff_t{index};
  Vertex v{};
  const Corner& corner = corners[instance.first_vertex + index];
  if (corner.x >= -kGuard) v.whole = &corner;
  for (std::size_t r = 0; r < v.row.size(); ++r) {
    const double* row = instance.transform.row[r];
    v.row[r] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
  }
  glm::dvec3 normal;
  for (int r = 0; r < 3; ++r) {
    const double* row = instance.transform.normal[r];
    normal[r] = row[0] * n[0] + row[1] * n[1] + row[2] * n[2];
  }
  const double size = glm::length(normal);
  for (int c = 0; c < 3; ++c)
    v.attribute[static_cast<std::size_t>(c)] = size > 0 ? normal[c] / size : 0;
  if (instance.mesh.uvs) {
    v.attribute[3] = instance.mesh.uvs[2 * std::ptrdiff_t{index}];
    v.attribute[4] = instance.mesh.uvs[2 * std::ptrdiff_t{index} + 1];
  }
  v.attributes = has_more(instance.mesh) ? kAll : kFew;
  if (v.attributes == kFew) return v;
  const MoreAttributes more = more_of(instance.mesh, index);
  std::copy(more.color, more.color + 4, v.attribute.begin() + kFew);
  v.attribute[9] = more.u;
  v.attribute[10] = more.v;
  return v;
}

double dot(const double* a, const glm::dvec3& b) { return a[0] * b.x + a[1] * b.y + a[2] * b.z; }

/// The plane of the whole triangle; false if its corners are collinear or not finite.
bool set_plane(const DrawnInstance& instance, std::uint32_t triangle, Triangle& out) {
  const std::uint32_t* index = instance.mesh.indices + 3 * std::ptrdiff_t{triangle};
  const auto position = [&](int k) {
    const float* p = instance.mesh.positions + 3 * std::ptrdiff_t{index[k]};
    return glm::dvec3(p[0], p[1], p[2]);
  };
  const glm::dvec3 p0 = position(0), n = glm::cross(position(1) - p0, position(2) - p0);
  if (!(std::abs(n.x) + std::abs(n.y) + std::abs(n.z) > 0)) return false;
  const PlaneRays& r = instance.rays;
  const double d = r.determinant * glm::dot(n, p0) + dot(r.offset, n);
  const double divisor = r.perspective ? d : dot(r.axis, n);
  out.a = dot(r.ray_dx, n) / divisor;
  out.b = dot(r.ray_dy, n) / divisor;
  out.c = (r.perspective ? dot(r.ray, n) : dot(r.ray, n) - d) / divisor;
  return true;
}

int first_pixel(std::int32_t low) { return (low + kSubpixels / 2 - 1) >> 8; }
int last_pixel(std::int32_t high) { return (high - kSubpixels / 2) >> 8; }

Corner corner_of(const VertexTransform& t, const Vertex& v) {
  if (v.whole) return *v.whole;
  const double w = v.w(t);
  const auto fixed = [&](double along) {
    const double position = std::nearbyint(along / w);
    return static_cast<std::int32_t>(std::clamp<double>(position, -kGuard, kGuard));
  };
  const double depth = v.row[VertexTransform::kDepth];
  const double q = t.perspective ? std::min(1 / depth, 1e30) : -depth;
  return {fixed(v.row[VertexTransform::kX]), fixed(v.row[VertexTransform::kY]),
          static_cast<float>(q), static_cast<float>(v.attribute[0])};
}

/// Limits q to the range of the corners; the same rule as in set_up() for whole triangles.
void bound_depth(const std::array<float, 3>& q, bool perspective, Triangle& out) {
  const double least = std::min({q[0], q[1], q[2]}), most = std::max({q[0], q[1], q[2]});
  const bool has_slope = std::abs(out.a) + std::abs(out.b) + std::abs(out.c) < 1e30;
  if (!has_slope) {
    out.a = out.b = 0;
    out.c = most;
  }
  const double slack = 0.01 * std::min(std::abs(out.a) + std::abs(out.b), most - least);
  const double lowest = least - slack;
  out.q_min = static_cast<float>(perspective ? std::max(lowest, 0.5 * least) : lowest);
  out.q_max = static_cast<float>(most + slack);
}

}  // namespace

void ClippedPieces::clear() {
  corners.clear();
  attributes.clear();
  more.clear();
  pieces.clear();
}

void clip(const DrawnInstance& instance, const Screen& screen, const Corner* corners,
          std::uint32_t triangle, ClippedPieces& out) {
  Triangle whole{};
  if (!set_plane(instance, triangle, whole)) return;
  const VertexTransform& t = instance.transform;
  Polygon polygon;
  for (int k = 0; k < 3; ++k) {
    polygon.add(
        transformed(instance, corners, instance.mesh.indices[3 * std::ptrdiff_t{triangle} + k]));
    for (double value : polygon.corners[static_cast<std::size_t>(k)].row) {
      if (!std::isfinite(value)) return;
    }
  }
  for (int plane = 0; plane < kPlanes && polygon.count >= 3; ++plane) cut(t, plane, polygon);
  if (polygon.count < 3) return;
  for (int i = 0; i < polygon.count; ++i) {
    if (!(polygon.corners[static_cast<std::size_t>(i)].w(t) > 0)) return;  // at the eye itself
  }
  const std::uint32_t base = static_cast<std::uint32_t>(out.corners.size());
  for (int i = 0; i < polygon.count; ++i) {
    const Vertex& v = polygon.corners[static_cast<std::size_t>(i)];
    out.corners.push_back(corner_of(t, v));
    const auto attribute = [&](std::size_t k) { return static_cast<float>(v.attribute[k]); };
    out.attributes.push_back({attribute(1), attribute(2), attribute(3), attribute(4)});
    if (v.attributes == kFew) continue;
    out.more.push_back(
        {{attribute(5), attribute(6), attribute(7), attribute(8)}, attribute(9), attribute(10)});
  }
  for (int i = 1; i + 1 < polygon.count; ++i) {
    const Corner* all = out.corners.data() + base;
    const Corner &a = all[0], &b = all[i], &c = all[i + 1];
    const std::int64_t area = (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
                              (std::int64_t{c.x} - a.x) * (std::int64_t{b.y} - a.y);
    const bool front = instance.flip ? area > 0 : area < 0;
    if (area == 0 || (instance.cull && !front)) continue;
    ClippedPieces::Piece piece{whole, 0, 0, 0, 0};
    piece.x0 = std::max(first_pixel(std::min({a.x, b.x, c.x})), screen.x0);
    piece.y0 = std::max(first_pixel(std::min({a.y, b.y, c.y})), screen.y0);
    piece.x1 = std::min(last_pixel(std::max({a.x, b.x, c.x})), screen.x1 - 1);
    piece.y1 = std::min(last_pixel(std::max({a.y, b.y, c.y})), screen.y1 - 1);
    if (piece.x1 < piece.x0 || piece.y1 < piece.y0) continue;
    const std::uint32_t second = base + static_cast<std::uint32_t>(i);
    piece.triangle.corner[0] = base;
    piece.triangle.corner[1] = area > 0 ? second : second + 1;
    piece.triangle.corner[2] = area > 0 ? second + 1 : second;
    piece.triangle.material = instance.material | (front ? 0 : Triangle::kBack);
    bound_depth({a.q, b.q, c.q}, t.perspective, piece.triangle);
    out.pieces.push_back(piece);
  }
}

}  // namespace limpid::raster
