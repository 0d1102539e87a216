#include "limpid/raster/rasterise.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <string>
#include <utility>

#include "limpid/core/error.h"
#include "limpid/core/simd.h"

#include "raster/group.h"
#include "raster/prepared.h"
#include "raster/project.h"
#include "raster/raster_job.h"
#include "raster/shadow_map.h"

namespace limpid {

namespace raster {

// One for each instruction set that the build names, defined in raster_target.cpp.
#define LIMPID_TARGET(name, highway) extern const RasterTarget kRaster_##name;
#include "core/targets.inc"
#undef LIMPID_TARGET

namespace {

constexpr const RasterTarget* kTargets[] = {
#define LIMPID_TARGET(name, highway) &kRaster_##name,
#include "core/targets.inc"
#undef LIMPID_TARGET
};

constexpr int kVerticesATask = 16384;
constexpr std::size_t kMaxGroups = 65535;  ///< a pixel's id holds 16 bits of group

void check(const RasterView& view) {
  view.camera.validate();
  const auto check_rect = [](const char* name, const Rect& r) {
    const std::string size = std::to_string(r.width()) + "x" + std::to_string(r.height());
    if (r.empty() || r.width() > 32000 || r.height() > 32000) {
      throw Error(std::string("raster ") + name + " of " + size +
                  " pixels: expected 1x1 to 32000x32000");
    }
  };
  check_rect("display", view.display);
  check_rect("window", view.window);
  if (!view.clip_plane) return;
  for (int i = 0; i < 4; ++i) {
    if (!std::isfinite((*view.clip_plane)[i])) throw Error("clip plane has a number not finite");
  }
}

/// Allocates `plane` over the window if wanted, else empties it; returns its first pixel.
float* pixels(bool wanted, const Rect& window, Plane& plane) {
  if (!wanted) {
    plane = Plane();
    return nullptr;
  }
  if (!plane || plane.view().window != window) plane = Plane(window);
  return plane.view().data;
}

void copy(const glm::dvec3& from, double* to) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}
void copy(const Rgb<double>& from, float* to) {
  to[0] = static_cast<float>(from.r);
  to[1] = static_cast<float>(from.g);
  to[2] = static_cast<float>(from.b);
}

ShadowView shadow_view(const ShadowMap& map, const glm::dvec3& eye) {
  const View<const float> depth = map.depth.view();
  ShadowView v{};
  v.depth = depth.data;
  v.size = depth.window.width();
  v.y_stride = static_cast<int>(depth.y_stride);
  const glm::dvec4 at_eye = map.map_from_world * glm::dvec4(eye, 1);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) v.map[r][c] = static_cast<float>(map.map_from_world[c][r]);
    v.map[r][3] = static_cast<float>(at_eye[r]);
  }
  for (int r = 0; r < 2; ++r) {
    for (int c = 0; c < 3; ++c) v.side[r][c] = static_cast<float>(map.sun_from_world[c][r]);
  }
  v.bias_texels = static_cast<float>(ShadowMap::kBiasTexels * map.texel);
  v.max_slope = static_cast<float>(ShadowMap::kMaxSlope);
  v.bias = static_cast<float>(map.bias);
  return v;
}

/// Reduces materials to their response to the sun.
std::vector<MaterialView> answers_to_sun(std::vector<MaterialView> materials) {
  for (MaterialView& m : materials) {
    const bool unlit = m.shading == Shading::kFlat || m.shading == Shading::kTextured;
    std::fill(std::begin(m.ambient), std::end(m.ambient), 0.0f);
    std::fill(std::begin(m.emission), std::end(m.emission), 0.0f);
    if (unlit) std::fill(std::begin(m.base), std::end(m.base), 0.0f);
  }
  return materials;
}

/// The job without the pointers to the scene's buffers.
ShadeJob shade_job(const RasterView& view, const Screen& screen, const RasterLighting& lighting,
                   const Model& model, RasterWanted wanted, RasterImage& image) {
  ShadeJob job{};
  job.screen = screen;
  job.perspective = !view.camera.orthographic();
  job.tiles_across = (view.window.width() + kTile - 1) / kTile;
  const Rays rays = rays_of(view.camera, {view.display.width(), view.display.height()});
  const double x = screen.origin_x - view.display.x0, y = screen.origin_y - view.display.y0;
  copy(rays.origin_at(x, y), job.origin);
  copy(rays.origin_dx, job.origin_dx);
  copy(rays.origin_dy, job.origin_dy);
  copy(rays.ray_at(x, y), job.ray);
  copy(rays.ray_dx, job.ray_dx);
  copy(rays.ray_dy, job.ray_dy);
  if (!lighting.sun_alone) copy(model.background, job.background);
  const glm::dvec3& sun = lighting.sun.direction;
  copy(Rgb<double>{sun.x, sun.y, sun.z}, job.sun_direction);
  copy(lighting.sun.color, job.sun_color);
  if (lighting.shadow) job.shadow = shadow_view(*lighting.shadow, view.camera.eye());
  job.lit = wanted.color || wanted.shadow || wanted.normal;
  const int width = view.window.width();
  job.y_stride = (width + 15) / 16 * 16;
  for (std::size_t c = 0; c < 3; ++c) {
    job.color[c] = pixels(wanted.color, view.window, image.color[c]);
    job.normal[c] = pixels(wanted.normal, view.window, image.normal[c]);
  }
  job.depth = pixels(wanted.depth, view.window, image.depth);
  job.coverage = pixels(wanted.coverage, view.window, image.coverage);
  job.shadow_out = pixels(wanted.shadow, view.window, image.shadow);
  return job;
}

}  // namespace
}  // namespace raster

struct __attribute__((visibility("hidden"))) Rasteriser::State {
  explicit State(const Model& model) : prepared(model) {}

  raster::PreparedModel prepared;
  std::vector<raster::DrawnInstance> instances;
  std::deque<raster::Group> groups;
  std::size_t group_count = 0;
  std::vector<raster::GroupView> views;
  raster::Buffer<raster::Corner> corners;
  raster::Buffer<raster::Attributes> attributes;
  std::vector<raster::MaterialView> sun_materials;      ///< for a picture of sunlight only
  std::vector<raster::MoreAttributes> more_attributes;  ///< one per corner, or empty

  std::uint32_t transform_vertices(const raster::RasterTarget& target, Executor& executor);
  void make_groups();
  void add_clipped_corners(std::uint32_t vertices);
  void add_more_attributes(std::uint32_t corner_count);
  bool all_plain() const;
  int groups_up_to(AlphaMode alpha) const;
};

std::uint32_t Rasteriser::State::transform_vertices(const raster::RasterTarget& target,
                                                    Executor& executor) {
  struct Task {
    const raster::DrawnInstance* instance;
    int first, count;
  };
  std::vector<Task> tasks;
  std::uint32_t vertices = 0;
  for (const raster::DrawnInstance& instance : instances) {
    vertices = instance.first_vertex + instance.vertices;
    const int count = static_cast<int>(instance.vertices);
    for (int first = 0; first < count; first += raster::kVerticesATask) {
      tasks.push_back({&instance, first, std::min(raster::kVerticesATask, count - first)});
    }
  }
  const std::size_t room = vertices + vertices / 16 + 4096;  // clipping adds some
  raster::Corner* to = corners.take(room);
  raster::Attributes* more = attributes.take(room);
  run_each(executor, static_cast<int>(tasks.size()), [&](int index) {
    const Task& t = tasks[static_cast<std::size_t>(index)];
    target.transform(*t.instance, t.first, t.count, to + t.instance->first_vertex,
                     more + t.instance->first_vertex);
  });
  return vertices;
}

void Rasteriser::State::make_groups() {
  group_count = 0;
  for (const raster::DrawnInstance& instance : instances) {
    const int triangles = static_cast<int>(instance.triangles);
    for (int first = 0; first < triangles; first += raster::kGroup) {
      const int count = std::min(raster::kGroup, triangles - first);
      if (group_count == groups.size()) {
        groups.emplace_back(instance, first, count);
      } else {
        groups[group_count].reset(instance, first, count);
      }
      ++group_count;
    }
  }
  if (group_count > raster::kMaxGroups) {
    throw Error("model with " + std::to_string(group_count) + " runs of at most " +
                std::to_string(raster::kGroup) + " triangles: expected at most " +
                std::to_string(raster::kMaxGroups));
  }
}

void Rasteriser::State::add_clipped_corners(std::uint32_t vertices) {
  std::size_t needed = vertices;
  for (std::size_t g = 0; g < group_count; ++g) needed += groups[g].new_corners();
  if (needed > corners.size()) {
    raster::Buffer<raster::Corner> larger_corners;
    raster::Buffer<raster::Attributes> larger_attributes;
    std::copy(corners.data(), corners.data() + vertices, larger_corners.take(needed + needed / 4));
    std::copy(attributes.data(), attributes.data() + vertices,
              larger_attributes.take(needed + needed / 4));
    std::swap(corners, larger_corners);
    std::swap(attributes, larger_attributes);
  }
  add_more_attributes(static_cast<std::uint32_t>(needed));
  std::uint32_t first = vertices;
  for (std::size_t g = 0; g < group_count; ++g) {
    groups[g].place_new_corners(first, corners.data(), attributes.data(),
                                more_attributes.empty() ? nullptr : more_attributes.data());
    first += groups[g].new_corners();
  }
}

void Rasteriser::State::add_more_attributes(std::uint32_t corner_count) {
  more_attributes.clear();
  for (const raster::DrawnInstance& instance : instances) {
    if (!raster::has_more(instance.mesh)) continue;
    more_attributes.resize(corner_count);
    for (std::uint32_t i = 0; i < instance.vertices; ++i) {
      more_attributes[instance.first_vertex + i] = raster::more_of(instance.mesh, i);
    }
  }
}

bool Rasteriser::State::all_plain() const {
  return std::all_of(instances.begin(), instances.end(), [&](const raster::DrawnInstance& i) {
    return prepared.materials[i.material].plain;
  });
}

/// Groups are in the order of their instances.
int Rasteriser::State::groups_up_to(AlphaMode alpha) const {
  int count = 0;
  while (count < static_cast<int>(group_count) &&
         groups[static_cast<std::size_t>(count)].alpha() <= alpha) {
    ++count;
  }
  return count;
}

Rasteriser::Rasteriser(const Model& model) : state_(std::make_unique<State>(model)) {}
Rasteriser::~Rasteriser() = default;

std::int64_t Rasteriser::degenerate_triangles() const {
  return state_->prepared.degenerate_triangles;
}

void Rasteriser::draw(const RasterView& view, const RasterLighting& lighting, RasterWanted wanted,
                      Executor& executor, RasterImage& image, const std::string& simd) {
  raster::check(view);
  const raster::RasterTarget& target = *raster::kTargets[simd_index(simd)];
  const raster::Screen screen = raster::screen_of(view);
  State& s = *state_;
  s.instances = raster::drawn_instances(s.prepared, view, screen);
  const std::uint32_t vertices = s.transform_vertices(target, executor);
  s.make_groups();
  run_each(executor, static_cast<int>(s.group_count), [&](int index) {
    s.groups[static_cast<std::size_t>(index)].set_up(target, screen, s.corners.data());
  });
  s.add_clipped_corners(vertices);
  s.views.clear();
  for (std::size_t g = 0; g < s.group_count; ++g) s.views.push_back(s.groups[g].view());

  raster::ShadeJob job = raster::shade_job(view, screen, lighting, s.prepared.model, wanted, image);
  job.groups = s.views.data();
  job.opaque_groups = s.groups_up_to(AlphaMode::kOpaque);
  job.unblended_groups = s.groups_up_to(AlphaMode::kMask);
  job.group_count = static_cast<int>(s.group_count);
  job.plain = s.all_plain();
  job.corners = s.corners.data();
  job.attributes = s.attributes.data();
  job.more = s.more_attributes.empty() ? nullptr : s.more_attributes.data();
  job.materials = s.prepared.materials.data();
  if (lighting.sun_alone) {
    s.sun_materials = raster::answers_to_sun(s.prepared.materials);
    job.materials = s.sun_materials.data();
  }
  const int down = (view.window.height() + raster::kTile - 1) / raster::kTile;
  run_each(executor, job.tiles_across * down, [&](int index) { target.draw_tile(job, index); });
}

RasterImage rasterise(const Model& model, const RasterView& view, const RasterLighting& lighting,
                      RasterWanted wanted, Executor& executor, const std::string& simd) {
  RasterImage image;
  Rasteriser(model).draw(view, lighting, wanted, executor, image, simd);
  return image;
}

}  // namespace limpid
