#include "judge/trace/caustics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "judge/trace/bend.h"
#include "judge/trace/samples.h"
#include "optics/fresnel.h"

namespace limpid::trace {
namespace {

constexpr int kViewsAcross = 64, kChunk = 4096;
constexpr double kGrazing = 0.05;

/// Depth over sideways distance from the calm entry point: how far waves spread light.
constexpr double kSideways = 0.5;

}  // namespace

Caustics::Caustics(const Scenery& scenery, const Eye& eye, Size size, int photons,
                   std::uint64_t seed, Executor& executor)
    : scenery_(scenery),
      band_(scenery.medium.bands[scenery.medium.common]),
      seed_(seed),
      rise_in_air_(glm::dot(scenery.to_sun, scenery.view.up)),
      rise_(glm::dot(band_.light.to_sun, scenery.view.up)) {
  choose_region(eye, size);
  const glm::dvec2 sides = high_sent_ - low_sent_;
  if (!(sides.x * sides.y > 0)) return;
  radius_ = std::sqrt(kCounted / std::numbers::pi / photons * sides.x * sides.y);
  expected_ = kCounted;

  photons_.resize(static_cast<std::size_t>(photons));
  run_each(executor, (photons + kChunk - 1) / kChunk, [&](int chunk) {
    const std::size_t first = std::size_t(chunk) * kChunk;
    const std::size_t end = std::min(first + kChunk, photons_.size());
    for (std::size_t i = first; i < end; ++i) photons_[i] = sent(i);
  });
  std::erase_if(photons_, [](const Photon& p) { return p.weight == 0; });
  std::stable_sort(photons_.begin(), photons_.end(),
                   [](const Photon& a, const Photon& b) { return a.cell < b.cell; });
}

/// The entry point of sunlight for a point of the bottom on the calm plane, relative to the point
/// under the eye.
glm::dvec2 Caustics::entry_of(const glm::dvec3& point) const {
  const WaterView& c = scenery_.view;
  const glm::dvec3 entry = point + scenery_.sun_path.depth_of(point) / rise_ * band_.light.to_sun;
  return {glm::dot(entry, c.map_x), glm::dot(entry, c.map_y)};
}

std::optional<Triangles::Hit> Caustics::bottom_seen(const Ray& view) const {
  Ray before = view;
  if (const auto dry = scenery_.solid.nearest(view)) before.to = dry->distance;
  if (scenery_.view.eye_above < 0) {  // it may see the bottom mirrored in the surface
    const auto mirror = scenery_.surface.nearest(before, false);
    return scenery_.solid.nearest(mirror ? mirrored_down({view, view, view}, *mirror).ray : view);
  }
  const auto wet = scenery_.surface.nearest(before, true);
  if (!wet) return std::nullopt;
  return scenery_.solid.nearest(refracted_in({view, view, view}, *wet, band_.ior).ray);
}

/// Bottom much farther away than most would take all photons.
void Caustics::choose_region(const Eye& eye, Size size) {
  struct Seen {
    double distance, depth;
    glm::dvec2 entry;
  };
  std::vector<Seen> seen;
  for (int j = 0; j < kViewsAcross; ++j) {
    for (int i = 0; i < kViewsAcross; ++i) {
      const Beam beam = eye.beam_at((i + 0.5) / kViewsAcross * size.width,
                                    (j + 0.5) / kViewsAcross * size.height, 1);
      const auto hit = bottom_seen(beam.ray);
      if (!hit || scenery_.sun_path.depth_of(hit->point) <= 0) continue;
      seen.push_back(
          {glm::length(hit->point), scenery_.sun_path.depth_of(hit->point), entry_of(hit->point)});
    }
  }
  if (seen.empty()) return;
  std::sort(seen.begin(), seen.end(),
            [](const Seen& a, const Seen& b) { return a.distance < b.distance; });
  const double farthest = 4 * seen[seen.size() / 2].distance;
  low_ = high_ = seen.front().entry;
  double depth = 0;
  for (const Seen& s : seen) {
    if (s.distance > farthest) break;
    low_ = glm::min(low_, s.entry);
    high_ = glm::max(high_, s.entry);
    depth = std::max(depth, s.depth);
  }
  const glm::dvec2 between = (high_ - low_) * (1.0 / kViewsAcross);
  low_ -= between;
  high_ += between;
  low_sent_ = low_ - kSideways * depth;
  high_sent_ = high_ + kSideways * depth;
}

Caustics::Photon Caustics::sent(std::uint64_t number) const {
  const WaterView& c = scenery_.view;
  Samples samples(seed_, static_cast<int>(number), 0, 0);
  const double u = samples.next(), v = samples.next();
  const glm::dvec2 at = low_sent_ + glm::dvec2(u, v) * (high_sent_ - low_sent_);
  const glm::dvec3 calm = at.x * c.map_x + at.y * c.map_y - c.eye_above * c.up;
  // From above the crests.
  const double over = scenery_.surface.crest() + c.eye_above;
  const Ray down{calm + (over * 1.001 + 1e-3) / rise_in_air_ * scenery_.to_sun, -scenery_.to_sun};
  const auto wet = scenery_.surface.nearest(down, true);
  if (!wet || scenery_.solid.blocks({wet->point, scenery_.to_sun})) return {};
  const auto hit = scenery_.solid.nearest(refracted_in({down, down, down}, *wet, band_.ior).ray);
  if (!hit) return {};
  double weight = 1;
  if (scenery_.medium.crosses) {
    weight = (1 - fresnel_exact(glm::dot(scenery_.to_sun, wet->normal), band_.ior)) /
             (1 - fresnel_exact(rise_in_air_, band_.ior));
  }
  const glm::dvec3 face = glm::dot(hit->front, down.direction) > 0 ? -hit->front : hit->front;
  return {glm::vec3(hit->point), glm::vec3(face), static_cast<float>(weight),
          cell_of(hit->point, 0, 0, 0)};
}

/// Cells as wide as the disc.
std::uint64_t Caustics::cell_of(const glm::dvec3& place, int dx, int dy, int dz) const {
  const auto part = [&](double x, int step) {
    const double cell = std::clamp(std::floor(x / radius_), -1e6, 1e6) + step;
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(cell) + (1 << 20)) & 0x1fffff;
  };
  return part(place.x, dx) << 42 | part(place.y, dy) << 21 | part(place.z, dz);
}

std::optional<double> Caustics::at(const SolidPoint& point) const {
  if (!(expected_ > 0)) return std::nullopt;
  const glm::dvec2 entry = entry_of(point.hit.point);
  const bool within =
      entry.x > low_.x && entry.y > low_.y && entry.x < high_.x && entry.y < high_.y;
  const double faces = glm::dot(point.face, band_.light.to_sun);
  if (!within || faces < kGrazing) return std::nullopt;
  double sum = 0;
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      // Cells along z are consecutive.
      const std::uint64_t first = cell_of(point.hit.point, dx, dy, -1),
                          last = cell_of(point.hit.point, dx, dy, 1);
      auto photon =
          std::lower_bound(photons_.begin(), photons_.end(), first,
                           [](const Photon& p, std::uint64_t cell) { return p.cell < cell; });
      for (; photon != photons_.end() && photon->cell <= last; ++photon) {
        const glm::dvec3 off = glm::dvec3(photon->place) - point.hit.point;
        const bool near = glm::dot(off, off) < radius_ * radius_;
        if (near && glm::dot(glm::dvec3(photon->face), point.face) > 0.9) sum += photon->weight;
      }
    }
  }
  return sum / (expected_ * faces / rise_);
}

}  // namespace limpid::trace
