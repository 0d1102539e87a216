#include "job/motion.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>

#include "job/parallax.h"
#include "job/screen.h"

namespace limpid {
namespace {

/// Slopes of a map that differ from the identity's by more than this in sum are a fold, a jump, or
/// a distortion too strong to be inverted.
constexpr double kMaxBending = 1;

/// How the name of each MotionLayer begins.
constexpr std::string_view kMotion = "motion";

void fit(std::vector<Plane>& planes, std::size_t count, const Rect& window) {
  planes.resize(count);
  for (Plane& plane : planes) {
    if (!plane || plane.view().window != window) plane = Plane(window);
  }
}

float finite_or_0(float value) { return std::isfinite(value) ? value : 0; }

class Map {
 public:
  explicit Map(const LookedUp& looked_up) : of_(looked_up) {}

  bool is_wet(int x, int y) const {
    return of_.surface_depth.window.contains({x, y, x + 1, y + 1}) &&
           std::isfinite(of_.surface_depth.at(x, y));
  }
  /// In pixels, x right and y down.
  Place at(int x, int y) const {
    return {of_.display.x0 + of_.u.at(x, y) * static_cast<double>(of_.display.width()),
            of_.display.y0 + (1 - of_.v.at(x, y)) * static_cast<double>(of_.display.height())};
  }
  /// The motion in the picture, y down, that corresponds to the motion `looked_up` of the place of
  /// the lookup.
  Place motion_of(int x, int y, const Place& looked_up) const {
    if (!is_wet(x - 1, y) || !is_wet(x + 1, y) || !is_wet(x, y - 1) || !is_wet(x, y + 1)) {
      return looked_up;
    }
    const Place left = at(x - 1, y), right = at(x + 1, y), up = at(x, y - 1), down = at(x, y + 1);
    const double xx = (right.x - left.x) / 2, yx = (right.y - left.y) / 2;
    const double xy = (down.x - up.x) / 2, yy = (down.y - up.y) / 2;
    const double bending = (xx - 1) * (xx - 1) + yx * yx + xy * xy + (yy - 1) * (yy - 1);
    const double area = xx * yy - xy * yx;
    if (!(bending < kMaxBending * kMaxBending) || !(area > 0)) return looked_up;
    return {(yy * looked_up.x - xy * looked_up.y) / area,
            (xx * looked_up.y - yx * looked_up.x) / area};
  }

 private:
  const LookedUp& of_;
};

/// Pixels, x right and y down.
class Mirror {
 public:
  explicit Mirror(const Mirrored& mirrored) : of_(mirrored), screen_(mirrored.view) {}

  /// The motion on the picture of what a pixel mirrors, or none.
  template <class MotionAt>
  std::optional<Place> motion(int x, int y, const MotionAt& motion_at) const {
    const Rect pixel{x, y, x + 1, y + 1};
    if (!of_.surface_depth.window.contains(pixel)) return {};
    const double surface = of_.surface_depth.at(x, y), image = of_.reflection_depth.at(x, y);
    if (!(surface < image && image < HUGE_VAL)) return {};
    const Place here{x + 0.5, y + 0.5};
    const glm::dvec3 ray = screen_.ray_at(here), start = screen_.point_at(here, surface);
    const glm::dvec3 normal(of_.normal_x.at(x, y), of_.normal_y.at(x, y), of_.normal_z.at(x, y));
    if (!(glm::dot(ray, normal) < 0)) return {};
    const auto across = [&](const glm::dvec3& point) {
      return point - 2 * glm::dot(normal, point - start) * normal;
    };
    const glm::dvec3 thing = across(start + (image - surface) * ray);
    const std::optional<Place> shown = screen_.place_of(thing);
    if (!shown) return {};
    const double depth = glm::dot(screen_.view().forward, thing - screen_.origin_at(*shown));
    const auto seen = texel_of(*shown, of_.depth.window);
    if (!seen || !(std::abs(of_.depth.at(seen->first, seen->second) - depth) < kSame * depth)) {
      return {};
    }
    const std::optional<Place> moved = motion_at(seen->first, seen->second);
    if (!moved) return {};
    const std::optional<Place> from = screen_.place_of(across(thing));
    const std::optional<Place> to = screen_.place_of(
        across(screen_.point_at({shown->x + moved->x, shown->y + moved->y}, depth)));
    if (!from || !to) return {};
    return Place{to->x - from->x, to->y - from->y};
  }

 private:
  static constexpr double kSame = 0.05;  ///< of a depth: what is mirrored is what is shown

  const Mirrored& of_;
  Screen screen_;
};

}  // namespace

void carry_motion(const LookedUp& looked_up, View<const float> x, View<const float> y,
                  View<float> to_x, View<float> to_y) {
  const Map map(looked_up);
  const Rect &from = x.window, &window = to_x.window;
  const auto texel = [](double place, int first, int end) {
    return static_cast<int>(std::clamp<double>(std::floor(place), first, end - 1));
  };
  for (int row = window.y0; row < window.y1; ++row) {
    for (int column = window.x0; column < window.x1; ++column) {
      const bool wet = map.is_wet(column, row);
      const Place place = wet ? map.at(column, row) : Place{column + 0.5, row + 0.5};
      const int at_x = texel(place.x, from.x0, from.x1), at_y = texel(place.y, from.y0, from.y1);
      const Place moved{finite_or_0(x.at(at_x, at_y)), -finite_or_0(y.at(at_x, at_y))};
      const Place seen = wet ? map.motion_of(column, row, moved) : moved;
      to_x.at(column, row) = static_cast<float>(seen.x);
      to_y.at(column, row) = static_cast<float>(-seen.y);
    }
  }
}

void reflect_motion(const Mirrored& mirrored, View<const float> x, View<const float> y,
                    View<float> to_x, View<float> to_y) {
  const Mirror mirror(mirrored);
  const Rect& from = x.window;
  const auto motion_at = [&](int column, int row) -> std::optional<Place> {
    if (!from.contains({column, row, column + 1, row + 1})) return {};
    return Place{finite_or_0(x.at(column, row)), -finite_or_0(y.at(column, row))};
  };
  const Rect& window = to_x.window;
  for (int row = window.y0; row < window.y1; ++row) {
    for (int column = window.x0; column < window.x1; ++column) {
      const Place seen = mirror.motion(column, row, motion_at).value_or(Place{0, 0});
      to_x.at(column, row) = static_cast<float>(seen.x);
      to_y.at(column, row) = static_cast<float>(-seen.y);
    }
  }
}

void MotionChannels::read(const Plate& plate, std::vector<MotionLayer> layers) {
  layers_ = std::move(layers);
  dry_ = plate.read_motion(layers_);
}

void MotionChannels::expect_second(std::vector<MotionLayer> layers) {
  layers_ = std::move(layers);
  dry_.clear();
}

void MotionChannels::carry(const Parallax& parallax, const LookedUp& looked_up,
                           View<const float> depth, const Rect& window, Executor& executor) {
  fit(seen_, 2, window);
  parallax.seen(looked_up, depth, seen_[0].view(), seen_[1].view(), executor);
}

void MotionChannels::reflect(const Parallax& parallax, const Mirrored& mirrored, const Rect& window,
                             Executor& executor) {
  fit(reflected_, 2, window);
  parallax.reflected(mirrored, reflected_[0].view(), reflected_[1].view(), executor);
}

void MotionChannels::carry(const LookedUp& looked_up, const Rect& window) {
  fit(seen_, dry_.size(), window);
  for (std::size_t i = 0; i + 1 < dry_.size(); i += 2) {
    carry_motion(looked_up, dry_[i].view(), dry_[i + 1].view(), seen_[i].view(),
                 seen_[i + 1].view());
  }
}

void MotionChannels::reflect(const Mirrored& mirrored, const Rect& window) {
  fit(reflected_, dry_.size(), window);
  for (std::size_t i = 0; i + 1 < dry_.size(); i += 2) {
    reflect_motion(mirrored, dry_[i].view(), dry_[i + 1].view(), reflected_[i].view(),
                   reflected_[i + 1].view());
  }
}

std::vector<ExrOutputChannel> MotionChannels::channels(const OutputChoice& choice) const {
  std::vector<ExrOutputChannel> channels;
  const auto add = [&](const std::vector<Plane>& planes, bool reflected) {
    auto plane = planes.begin();
    for (const MotionLayer& layer : layers_) {
      for (const std::string& name : motion_names(layer, choice.aov_names, reflected)) {
        channels.push_back({name, (plane++)->view(), !choice.store_float});
      }
    }
  };
  if (choice.motion) add(seen_, false);
  if (choice.motion_reflected) add(reflected_, true);
  return channels;
}

std::vector<std::string> motion_names(const MotionLayer& layer, AovNames names, bool reflected) {
  std::string name = layer.name;
  if (reflected) name.insert(kMotion.size(), "_reflected");
  std::vector<std::string> channels;
  for (const std::string& suffix : layer.suffixes) {
    channels.push_back(aov_layer(name, names) + "." + suffix);
  }
  return channels;
}

}  // namespace limpid
