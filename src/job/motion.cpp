#include "job/motion.h"

#include <algorithm>
#include <cmath>

namespace limpid {
namespace {

/// Slopes of a map that differ from the identity's by more than this in sum are a fold, a jump, or
/// a distortion too strong to be inverted.
constexpr double kMaxBending = 1;

struct Place {
  double x, y;
};

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

void MotionChannels::read(const Plate& plate, std::vector<MotionLayer> layers) {
  layers_ = std::move(layers);
  dry_ = plate.read_motion(layers_);
}

void MotionChannels::carry(const LookedUp& looked_up, const Rect& window) {
  seen_.resize(dry_.size());
  for (std::size_t i = 0; i + 1 < dry_.size(); i += 2) {
    for (const std::size_t plane : {i, i + 1}) {
      if (!seen_[plane] || seen_[plane].view().window != window) seen_[plane] = Plane(window);
    }
    carry_motion(looked_up, dry_[i].view(), dry_[i + 1].view(), seen_[i].view(),
                 seen_[i + 1].view());
  }
}

std::vector<ExrOutputChannel> MotionChannels::channels(const OutputChoice& choice) const {
  std::vector<ExrOutputChannel> channels;
  for (const MotionLayer& layer : layers_) {
    for (const std::string& name : motion_names(layer, choice.aov_names)) {
      channels.push_back({name, seen_[channels.size()].view(), !choice.store_float});
    }
  }
  return channels;
}

std::vector<std::string> motion_names(const MotionLayer& layer, AovNames names) {
  std::vector<std::string> channels;
  for (const std::string& suffix : layer.suffixes) {
    channels.push_back(aov_layer(layer.name, names) + "." + suffix);
  }
  return channels;
}

}  // namespace limpid
