#include "complete/caustics_mirrored.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "complete/rows.h"
#include "op/plain_texture.h"
#include "ops/caustics_kernel.h"

namespace limpid {
namespace {

struct Lookup {
  double grid(const View<const float>& light, Vec2<double> at) const { return grid_at(light, at); }
};

/// A reflection, and the light on the bottom that it mirrors.
class Mirror {
 public:
  Mirror(const Caustics::Params& params, const CausticsTable& table, const Pass& pass,
         const Frame& frame)
      : params_(params),
        table_(table),
        pass_(pass),
        frame_(frame),
        light_(Kernel<Caustics>::light_of(params, pass)),
        image_(frame.plane(PlaneId::kReflectionDepth)),
        depth_(frame.plane(PlaneId::kDepth)),
        shadow_(frame.plane(PlaneId::kShadow)),
        above_(pass.planes.has(PlaneId::kSurfaceShadow) ? frame.plane(PlaneId::kSurfaceShadow)
                                                        : View<const float>{}),
        shown_(depth_.window) {
    if (shadow_) shown_ = intersection(shown_, shadow_.window);
    for (int i = 0; light_.known && i < 3; ++i) {
      for (const PlaneId first : {PlaneId::kColorR, PlaneId::kSunColorR}) {
        shown_ = intersection(shown_, frame.plane(plane_after(first, i)).window);
      }
    }
    const double sine = light_.sine / pass.ior;
    aside_ = 1 / (pass.ior * std::sqrt(1 - sine * sine));
  }

  /// Factor of the light of a pixel, for each color.
  std::array<double, 3> gain_at(int x, int y) const {
    const double far = image_.at(x, y);
    if (!(far > 0 && far < 1e30)) return {1, 1, 1};
    const double at_x = x - pass_.corner.x + 0.5, at_y = y - pass_.corner.y + 0.5;
    const glm::dvec3 ray = pass_.rays.ray_at(at_x, at_y);
    const glm::dvec3 image = pass_.rays.origin_at(at_x, at_y) + far * ray;
    const double deep = pass_.eye_above + glm::dot(pass_.up, image);
    if (!(deep > 0)) return {1, 1, 1};
    const Vec2<double> entry{glm::dot(pass_.map_x, image) + deep * aside_ * light_.level.x,
                             glm::dot(pass_.map_y, image) + deep * aside_ * light_.level.y};
    const double cosine = std::abs(glm::dot(pass_.up, ray)) / glm::length(ray);
    const double texel = caustics_texel(pass_, glm::dot(pass_.forward, image), cosine);
    const double more = params_.strength * (caustics_at(table_, Lookup{}, entry, texel) - 1);
    const glm::dvec3 enters =
        entry.x * pass_.map_x + entry.y * pass_.map_y - pass_.eye_above * pass_.up;
    std::array<double, 3> gain = share_of(image - 2 * deep * pass_.up, enters);
    for (std::size_t i = 0; i < 3; ++i) {
      gain[i] = 1 + gain[i] * more * std::exp(-table_.scattered[i] * deep);
    }
    return gain;
  }

 private:
  /// The pixel in which a point lies, if it is in `window`.
  std::optional<glm::ivec2> pixel_of(const glm::dvec3& point, const Rect& window) const {
    const glm::dvec3 offset =
        point - pass_.rays.origin;  // from the picture's corner, where uv is 0
    const double w = pass_.w_origin + pass_.w_depth * glm::dot(pass_.forward, offset);
    const double x = glm::dot(pass_.to_u, offset) / w * pass_.size.x + pass_.corner.x;
    const double y = glm::dot(pass_.to_v, offset) / w * pass_.size.y + pass_.corner.y;
    if (!(w > 0 && x >= window.x0 && x < window.x1 && y >= window.y0 && y < window.y1)) return {};
    return glm::ivec2(std::floor(x), std::floor(y));
  }

  double depth_at(const glm::ivec2& pixel) const {
    const Rect& window = depth_.window;
    return depth_.at(std::clamp(pixel.x, window.x0, window.x1 - 1),
                     std::clamp(pixel.y, window.y0, window.y1 - 1));
  }

  /// The sun's share in the light of a point whose sunlight enters at another point.
  std::array<double, 3> share_of(const glm::dvec3& point, const glm::dvec3& enters) const {
    const double near = glm::dot(pass_.forward, point);
    const std::optional<glm::ivec2> pixel = pixel_of(point, shown_);
    const int x = pixel ? pixel->x : 0, y = pixel ? pixel->y : 0;
    constexpr double kSame = Kernel<Caustics>::kSameDepth;
    const double there = pixel ? depth_.at(x, y) : 0;
    const bool shown = there > kSame * near && kSame * there < near;
    double lit = shown && shadow_ ? shadow_.at(x, y) : 1;
    if (!shown && above_) {
      const std::optional<glm::ivec2> at = pixel_of(enters, above_.window);
      const double far = glm::dot(pass_.forward, enters);
      const bool hidden = at && kSame * far > depth_at(*at);
      if (at) lit = hidden ? 0 : above_.at(at->x, at->y);
    }
    std::array<double, 3> share;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (!light_.known) {
        const double direct = lit * light_.sun[k];
        share[k] = direct / std::max(direct + light_.ambient[k], 1e-30);
      } else if (shown) {
        const double whole = frame_.plane(plane_after(PlaneId::kColorR, i)).at(x, y);
        const double sun = frame_.plane(plane_after(PlaneId::kSunColorR, i)).at(x, y);
        share[k] = whole > 0 ? std::clamp(sun / whole, 0.0, 1.0) : 0;
      } else {
        share[k] = lit * light_.around[k];
      }
    }
    return share;
  }

  const Caustics::Params& params_;
  const CausticsTable& table_;
  const Pass& pass_;
  const Frame& frame_;
  const Kernel<Caustics>::Light light_;
  const View<const float>&image_, &depth_, &shadow_;
  const View<const float> above_;  ///< none if the plan does not read it
  Rect shown_;                     ///< where all planes are that show a point
  double aside_;  ///< sideways travel of calm light per unit of depth, over the sun's sine
};

}  // namespace

void MirroredCaustics::light(const Caustics::Params& params, const CausticsTable& table,
                             const Pass& pass, Executor& executor, Frame& frame) {
  const bool shows = pass.planes.covers(kReflectionPlanes | PlaneSet{PlaneId::kReflectionDepth});
  if (!(pass.eye_above < 0) || !shows || table.count == 0 || params.strength == 0) return;
  Pass lit = pass;
  lit.caustics = &table;
  const Mirror mirror(params, table, lit, frame);
  const Rect known = frame.plane(PlaneId::kReflectionDepth).window;
  std::array<View<const float>, 3> from;
  std::array<View<float>, 3> to;
  Rect window = known;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    from[k] = frame.plane(plane_after(PlaneId::kReflectionR, i));
    if (!color_[k] || color_[k].view().window != from[k].window) color_[k] = Plane(from[k].window);
    to[k] = color_[k].view();
    window = intersection(window, from[k].window);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    each_row(executor, from[k].window, [&](int y) {
      for (int x = from[k].window.x0; x < from[k].window.x1; ++x) {
        to[k].at(x, y) = from[k].at(x, y);
      }
    });
  }
  each_row(executor, window, [&](int y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const std::array<double, 3> gain = mirror.gain_at(x, y);
      for (std::size_t k = 0; k < 3; ++k) {
        to[k].at(x, y) = static_cast<float>(gain[k] * from[k].at(x, y));
      }
    }
  });
  for (int i = 0; i < 3; ++i) {
    frame.planes[index_of(plane_after(PlaneId::kReflectionR, i))] =
        color_[static_cast<std::size_t>(i)].view();
  }
}

}  // namespace limpid
