#include "raster/project.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace limpid::raster {
namespace {

glm::dvec4 row_of(const glm::dmat4& m, int r) { return {m[0][r], m[1][r], m[2][r], m[3][r]}; }

/// The matrix of cofactors: cross(M a, M b) = cofactors(M) cross(a, b), also for a singular M.
glm::dmat3 cofactors(const glm::dmat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

void copy(const glm::dvec3& from, double* to) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

VertexTransform transform_of(const RasterView& view, const Screen& screen,
                             const glm::dmat4& world_from_mesh) {
  const Camera& camera = view.camera;
  const bool perspective = !camera.orthographic();
  const glm::dmat4 view_from_mesh = camera.view * world_from_mesh;
  const glm::dmat4& p = camera.projection;
  // Scaled so that w is the eye depth, or 1.
  const glm::dmat4 clip_from_mesh = p * view_from_mesh * (perspective ? -1 / p[2][3] : 1 / p[3][3]);
  const glm::dvec4 x = row_of(clip_from_mesh, 0), y = row_of(clip_from_mesh, 1),
                   z = row_of(clip_from_mesh, 2), w = row_of(clip_from_mesh, 3);
  const double half_width = 0.5 * view.display.width(), half_height = 0.5 * view.display.height();
  const double left = view.display.x0 - screen.origin_x, top = view.display.y0 - screen.origin_y;
  glm::dvec4 rows[VertexTransform::kRows];
  rows[VertexTransform::kX] = double{kSubpixels} * (half_width * x + (half_width + left) * w);
  rows[VertexTransform::kY] = double{kSubpixels} * ((half_height + top) * w - half_height * y);
  rows[VertexTransform::kDepth] = -row_of(view_from_mesh, 2);
  const bool reversed = camera.clip == ClipSpace::kReversed;
  const glm::dvec4 low = camera.clip == ClipSpace::kGl ? z + w : z, high = w - z;
  rows[VertexTransform::kNearDistance] = reversed ? high : low;
  rows[VertexTransform::kFarDistance] = reversed ? low : high;
  rows[VertexTransform::kUserDistance] =
      view.clip_plane ? *view.clip_plane * world_from_mesh : glm::dvec4(0, 0, 0, 1);
  VertexTransform t{};
  for (int r = 0; r < VertexTransform::kRows; ++r) {
    for (int c = 0; c < 4; ++c) t.row[r][c] = rows[r][c];
  }
  const glm::dmat3 linear(world_from_mesh);
  const double sign = glm::determinant(linear) < 0 ? -1 : 1;
  const glm::dmat3 normal = sign * cofactors(linear);  // the inverse transpose, up to its length
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) t.normal[r][c] = normal[c][r];
  }
  t.perspective = perspective;
  return t;
}

/// The n of PlaneRays is that of the mesh; N = cofactors n is that of the world, and N.r =
/// n.(cofactors^T r). cofactors^T M = determinant.
PlaneRays plane_rays(const RasterView& view, const Screen& screen,
                     const glm::dmat4& world_from_mesh) {
  const Camera& camera = view.camera;
  const Rays rays = rays_of(camera, {view.display.width(), view.display.height()});
  const double x = screen.origin_x - view.display.x0, y = screen.origin_y - view.display.y0;
  const glm::dmat3 linear(world_from_mesh);
  const glm::dmat3 to_mesh = glm::transpose(cofactors(linear));
  PlaneRays out{};
  out.perspective = !camera.orthographic();
  out.determinant = glm::determinant(linear);
  copy(to_mesh * (glm::dvec3(world_from_mesh[3]) - camera.eye()), out.offset);
  if (out.perspective) {
    copy(to_mesh * rays.ray_at(x, y), out.ray);
    copy(to_mesh * rays.ray_dx, out.ray_dx);
    copy(to_mesh * rays.ray_dy, out.ray_dy);
  } else {
    copy(to_mesh * rays.origin_at(x, y), out.ray);
    copy(to_mesh * rays.origin_dx, out.ray_dx);
    copy(to_mesh * rays.origin_dy, out.ray_dy);
    copy(to_mesh * rays.ray, out.axis);
  }
  return out;
}

}  // namespace

Screen screen_of(const RasterView& view) {
  const Rect& w = view.window;
  // Whole vectors of pixels stay whole: the origin is a multiple of 64 pixels from the corner.
  const int x = w.x0 + w.width() / 2 / 64 * 64, y = w.y0 + w.height() / 2 / 64 * 64;
  return {x, y, w.x0 - x, w.y0 - y, w.x1 - x, w.y1 - y};
}

std::vector<DrawnInstance> drawn_instances(const PreparedModel& prepared, const RasterView& view,
                                           const Screen& screen) {
  std::vector<DrawnInstance> drawn;
  for (const Instance& instance : prepared.model.instances) {
    if (instance.water != (view.subject == RasterSubject::kWater)) continue;
    const PreparedMesh& mesh = prepared.meshes[static_cast<std::size_t>(instance.mesh)];
    if (mesh.triangles == 0) continue;
    const Mesh& source = prepared.model.meshes[static_cast<std::size_t>(instance.mesh)];
    DrawnInstance d{};
    d.mesh = mesh.view;
    d.transform = transform_of(view, screen, instance.world_from_mesh);
    d.rays = plane_rays(view, screen, instance.world_from_mesh);
    d.vertices = mesh.vertices;
    d.triangles = mesh.triangles;
    d.material = static_cast<std::uint32_t>(mesh.material);
    d.alpha = prepared.materials[d.material].alpha_mode;
    const bool mirrored = glm::determinant(glm::dmat3(instance.world_from_mesh)) < 0;
    d.flip = mirrored != view.flip_winding;
    d.cull = view.cull &&
             !prepared.model.materials[static_cast<std::size_t>(source.material)].double_sided;
    drawn.push_back(d);
  }
  std::stable_sort(drawn.begin(), drawn.end(), [](const DrawnInstance& a, const DrawnInstance& b) {
    return a.alpha < b.alpha;
  });
  std::uint32_t vertices = 0;
  for (DrawnInstance& d : drawn) {
    d.first_vertex = vertices;
    vertices += d.vertices;
  }
  return drawn;
}

}  // namespace limpid::raster
