#pragma once
#include <algorithm>
#include <cmath>

#include "limpid/core/frame.h"

#include "op/height_bound.h"
#include "op/plain_texture.h"
#include "run/checks.h"

namespace limpid {

/// Lookups of one pixel in the planes of a frame (op/operator.h), in double and as simple as
/// possible: the standard for the fast lookups.
class PlainTaps {
 public:
  PlainTaps(const Frame& frame, int x, int y) : frame_(frame), x_(x), y_(y) {}

  /// Four texels around a place.
  struct Quad {
    int x, y;
    double u, v;
    double weight(int k) const { return (k & 1 ? u : 1 - u) * (k & 2 ? v : 1 - v); }
  };

  double own(PlaneId plane) const { return texel(plane, x_, y_); }
  /// A neighbour 0 ... 8, row after row; 4 is the pixel itself.
  double beside(PlaneId plane, int k) const { return texel(plane, x_ + k % 3 - 1, y_ + k / 3 - 1); }
  double nearest(PlaneId plane, Vec2<double> shift) const {
    const Vec2<double> at = position(shift);
    return texel(plane, clamped_floor(at.x + 0.5), clamped_floor(at.y + 0.5));
  }
  double bilinear(PlaneId plane, Vec2<double> shift) const {
    const Quad q = quad(shift);
    const Four<double> texels = read(plane, q);
    return lerp(lerp(texels[0], texels[1], q.u), lerp(texels[2], texels[3], q.u), q.v);
  }
  Quad quad(Vec2<double> shift) const {
    const Vec2<double> at = position(shift);
    return {clamped_floor(at.x), clamped_floor(at.y), at.x - std::floor(at.x),
            at.y - std::floor(at.y)};
  }
  Four<double> read(PlaneId plane, const Quad& q) const {
    return {texel(plane, q.x, q.y), texel(plane, q.x + 1, q.y), texel(plane, q.x, q.y + 1),
            texel(plane, q.x + 1, q.y + 1)};
  }
  Vec2<double> place(PlaneId plane, const Quad& q, int k) const {
    const Rect& w = frame_.plane(plane).window;
    const int column = std::clamp(q.x + (k & 1), w.x0, w.x1 - 1);
    const int row = std::clamp(q.y + (k >> 1), w.y0, w.y1 - 1);
    return {double(column - x_) / frame_.display.width(),
            double(row - y_) / frame_.display.height()};
  }
  /// The reference takes every step of a march.
  static SeenHeights heights(PlaneId, bool, Vec2<double>, Vec2<double>) { return {}; }
  static SeenRange range(PlaneId, bool, Vec2<double>, Vec2<double>) { return {}; }
  static bool wet() { return true; }
  static Rgb<double> lat_long_rgb(const Texture& map, Vec2<double> at) {
    return lat_long_rgb_at(map, at);
  }
  static double grid(const View<const float>& table, Vec2<double> at) { return grid_at(table, at); }

 private:
  /// Texel coordinates (centres at integers) of a shift from the pixel.
  Vec2<double> position(Vec2<double> shift) const {
    return {x_ + shift.x * frame_.display.width(), y_ + shift.y * frame_.display.height()};
  }
  static int clamped_floor(double v) {
    return static_cast<int>(std::floor(max(min(v, 1e9), -1e9)));
  }
  double texel(PlaneId plane, int x, int y) const {
    const View<const float>& view = frame_.plane(plane);
    if (!view) return missing_value(plane);
    return view.at(std::clamp(x, view.window.x0, view.window.x1 - 1),
                   std::clamp(y, view.window.y0, view.window.y1 - 1));
  }

  const Frame& frame_;
  int x_, y_;
};

}  // namespace limpid
