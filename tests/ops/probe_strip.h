#pragma once
#include <cmath>
#include <concepts>
#include <vector>

#include <gtest/gtest.h>

#include "op/pass.h"
#include "op/pixel.h"
#include "op/plain_texture.h"
#include "support.h"

namespace limpid::test {

/// Pixels in any state, to which an operator is applied alone, in double. The samplers give noise
/// and record their lookups.
class ProbeStrip {
 public:
  using Number = double;

  std::vector<Pixel<double>> pixels;
  double greatest = 6;  ///< value of a texel
  PlaneSet tapped;
  bool map_tapped = false, environment_tapped = false;
  double farthest = 0;  ///< tap, in uv along either axis

  template <class Fn>
  void each(Fn&& fn) {
    for (Pixel<double>& p : pixels) fn(p);
  }
  template <class Into>
  void own(PlaneId plane, Into&& into) {
    tapped = tapped | PlaneSet{plane};
    for (std::size_t i = 0; i < pixels.size(); ++i) into(pixels[i], texel(i, plane));
  }
  template <class Into>
  void own3(PlaneId first, Into&& into) {
    tapped = tapped | three(first);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      into(pixels[i], Vec3<double>{texel(i, first), texel(i, plane_after(first, 1)),
                                   texel(i, plane_after(first, 2))});
    }
  }
  template <class Into>
  void around3(PlaneId first, Into&& into) {
    tapped = tapped | three(first);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      Around<double> values;
      for (std::size_t k = 0; k < 9; ++k) {
        values.at[k] = {texel(i + k, first), texel(i + k, plane_after(first, 1)),
                        texel(i + k, plane_after(first, 2))};
      }
      into(pixels[i], values);
    }
  }
  template <class Where, class Into>
  void nearest(PlaneId plane, Where&& where, Into&& into) {
    note(where);
    own(plane, into);
  }
  template <class Where, class Into>
  void bilinear(PlaneId plane, Where&& where, Into&& into) {
    note(where);
    own(plane, into);
  }
  template <class Where, class Into>
  void bilinear_rgb(PlaneId first, Where&& where, Into&& into) {
    note(where);
    own3(first, [&](Pixel<double>& p, Vec3<double> v) { into(p, Rgb<double>{v.x, v.y, v.z}); });
  }
  template <class Where, class Into>
  void tiled_rgb(const Texture&, Where&& where, Into&& into) {
    map_tapped = true;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const Vec2<double> at = where(pixels[i]);
      const auto wave = [&](int c) { return 0.5 + 0.4 * std::sin(7 * at.x + 5 * at.y + c); };
      into(pixels[i], Rgb<double>{wave(0), wave(1), wave(2)});
    }
  }

  template <class Width, class Where, class Into>
  void tiled_rgb(const Texture& texture, Width&& width, Where&& where, Into&& into) {
    for (const Pixel<double>& p : pixels) EXPECT_GE(width(p), 0);
    tiled_rgb(texture, where, into);
  }
  template <class Wanted, class Where, class Into>
  void tiled_rgb_if(const Texture& texture, Wanted&& wanted, Where&& where, Into&& into) {
    tiled_rgb(texture, where, [&](Pixel<double>& p, Rgb<double> color) {
      if (wanted(p)) into(p, color);
    });
  }
  template <class Wanted, class Width, class Where, class Into>
  void tiled_slopes_if(const SlopeLevels&, Wanted&& wanted, Width&& width, Where&& where,
                       Into&& into) {
    tiled_rgb_if({}, wanted, where, [&](Pixel<double>& p, Rgb<double> color) {
      EXPECT_GE(width(p), 0);
      into(p, SlopeMoments<double>{{color.r, color.g}, {1, color.b, 1}});
    });
  }

  struct Quad {
    Vec2<double> shift;
    double weight(int) const { return 0.25; }
  };
  struct Tap {
    ProbeStrip& strip;
    std::size_t i;
    double nearest(PlaneId plane, Vec2<double> shift) const {
      strip.note(shift);
      return read(plane, {shift})[0];
    }
    double own(PlaneId plane) const {
      strip.tapped = strip.tapped | PlaneSet{plane};
      return strip.texel(i, plane);
    }
    Quad quad(Vec2<double> shift) const {
      strip.note(shift);
      return {shift};
    }
    Four<double> read(PlaneId plane, const Quad&) const {
      strip.tapped = strip.tapped | PlaneSet{plane};
      const auto at = [&](std::size_t k) { return strip.texel(i + k, plane); };
      return {at(0), at(1), at(2), at(3)};
    }
    Vec2<double> place(PlaneId, const Quad& q, int) const { return q.shift; }
    static SeenHeights heights(PlaneId, bool, Vec2<double>, Vec2<double>) { return {}; }
    static SeenRange range(PlaneId, bool, Vec2<double>, Vec2<double>) { return {}; }
    static bool wet() { return true; }
    static double grid(const View<const float>& table, Vec2<double> at) {
      return grid_at(table, at);
    }
    Rgb<double> lat_long_rgb(const Texture&, Vec2<double> at) const {
      strip.environment_tapped = true;
      EXPECT_TRUE(at.y >= 0 && at.y <= 1) << at.y;
      return {at.x, at.y, 0.5};
    }
  };
  template <class Fn>
  void probe(Fn&& fn) {
    for (std::size_t i = 0; i < pixels.size(); ++i) fn(pixels[i], Tap{*this, i});
  }

 private:
  static PlaneSet three(PlaneId first) {
    return {first, plane_after(first, 1), plane_after(first, 2)};
  }
  double texel(std::size_t i, PlaneId plane) const {
    return greatest * noise(static_cast<int>(i), index_of(plane), 80);
  }
  void note(Vec2<double> shift) {
    farthest = max(farthest, max(std::abs(shift.x), std::abs(shift.y)));
  }
  template <class Where>
  requires std::invocable < Where, const Pixel<double>
  & > void note(Where&& where) {
    for (const Pixel<double>& p : pixels) note(where(p));
  }
};

/// Calls fn(member of a, member of b) for every number of a part of the running state.
template <class P, class Q, class Fn>
void each_number(P& a, Q& b, StatePart part, Fn&& fn) {
  const auto two = [&](auto& v, auto& w) { fn(v.x, w.x), fn(v.y, w.y); };
  const auto rgb = [&](auto& v, auto& w) { fn(v.r, w.r), fn(v.g, w.g), fn(v.b, w.b); };
  switch (part) {
    case StatePart::kNormal:
      fn(a.normal.x, b.normal.x), fn(a.normal.y, b.normal.y), fn(a.normal.z, b.normal.z);
      return two(a.tilt, b.tilt);
    case StatePart::kSlopeVariance:
      fn(a.slope_variance.xx, b.slope_variance.xx), fn(a.slope_variance.xy, b.slope_variance.xy);
      return fn(a.slope_variance.yy, b.slope_variance.yy);
    case StatePart::kPrism:
      two(a.prism_r, b.prism_r), two(a.prism_g, b.prism_g), two(a.prism_b, b.prism_b);
      return rgb(a.dispersion, b.dispersion);
    case StatePart::kPosition:
      two(a.shift, b.shift), two(a.shift_r, b.shift_r), two(a.shift_g, b.shift_g);
      return two(a.shift_b, b.shift_b), fn(a.hit_depth, b.hit_depth);
    case StatePart::kPath:
      return fn(a.path, b.path);
    case StatePart::kTransmittance:
      return rgb(a.transmittance, b.transmittance);
    case StatePart::kDryBottom:
      rgb(a.dry_bottom, b.dry_bottom);
      fn(a.dry_lit, b.dry_lit), fn(a.dry_lit_known, b.dry_lit_known);
      return fn(a.filled, b.filled);
    case StatePart::kTransmitted:
      return rgb(a.transmitted, b.transmitted);
    case StatePart::kInScatter:
      return rgb(a.in_scatter, b.in_scatter);
    case StatePart::kSunScatter:
      return rgb(a.sun_near, b.sun_near), rgb(a.sun_far, b.sun_far);
    case StatePart::kFresnel:
      return fn(a.fresnel, b.fresnel);
    case StatePart::kReflected:
      return rgb(a.reflected, b.reflected);
    case StatePart::kMirrorSources:
      return rgb(a.mirror_sources, b.mirror_sources);
    case StatePart::kHighlight:
      return rgb(a.highlight, b.highlight);
    case StatePart::kConfidence:
      return fn(a.confidence, b.confidence);
  }
}

/// A part of the running state as numbers, for comparing the state before and after an operator.
inline std::vector<double> values_of(const Pixel<double>& p, StatePart part) {
  std::vector<double> values;
  each_number(p, p, part, [&](double v, double) { values.push_back(v); });
  return values;
}

inline void copy_part(const Pixel<double>& from, StatePart part, Pixel<double>& to) {
  each_number(from, to, part, [](double v, double& w) { w = v; });
}

constexpr StatePart kStateParts[] = {
    StatePart::kNormal,        StatePart::kSlopeVariance, StatePart::kPrism,
    StatePart::kPosition,      StatePart::kPath,          StatePart::kTransmittance,
    StatePart::kDryBottom,     StatePart::kTransmitted,   StatePart::kInScatter,
    StatePart::kSunScatter,    StatePart::kFresnel,       StatePart::kReflected,
    StatePart::kMirrorSources, StatePart::kHighlight,     StatePart::kConfidence};

/// The fixed part of a pixel, then random state in the given parts; the other parts are as before
/// the first operator.
inline Pixel<double> random_pixel(int seed, StateSet random) {
  int next = 0;
  const auto number = [&] { return 2.0 * noise(seed, next++, 90) - 1; };
  const auto rgb = [&] { return Rgb<double>{number() + 1, number() + 1, number() + 1}; };
  const Vec3<double> up{0, 1, 0};
  Pixel<double> p{};
  p.to_viewer = normalize_or<double>({number(), 1.2, number()}, up);
  p.surface_point = (-3 - number()) * p.to_viewer;
  p.surface_depth = 3 + number();
  p.dry_depth = p.surface_depth + 1.5 + number();
  p.ray_length = 1.2;
  p.side = 1;
  p.uv = {0.5 + 0.4 * number(), 0.5 + 0.4 * number()};
  p.transmittance = {1, 1, 1};
  p.normal = up;
  p.hit_depth = p.dry_depth;
  p.confidence = 1;
  p.transmitted = rgb();
  if (random.has(StatePart::kNormal)) {
    p.normal = normalize_or<double>({0.4 * number(), 1, 0.4 * number()}, up);
    p.tilt = {p.normal.x, p.normal.z};
  }
  if (random.has(StatePart::kSlopeVariance)) {
    const double x = 0.3 * number(), y = 0.3 * number();
    p.slope_variance = {x * x, 0.5 * x * y, y * y};
  }
  if (random.has(StatePart::kPrism)) {
    p.prism_r = {0.01 * number(), 0};
    p.prism_g = {0.01 * number(), 0.01 * number()};
    p.prism_b = {0, 0.01 * number()};
    p.dispersion = {-0.003, 0.001 * number(), 0.004};
  }
  if (random.has(StatePart::kPosition)) {
    p.shift = {0.05 * number(), 0.05 * number()};
    p.shift_r = p.shift_b = p.shift;
    p.shift_g = {0.05 * number(), 0.05 * number()};
    p.hit_depth = p.surface_depth + 2 + number();
  }
  if (random.has(StatePart::kPath)) p.path = 2 + number();
  if (random.has(StatePart::kTransmittance)) p.transmittance = 0.5 * rgb();
  if (random.has(StatePart::kSunScatter)) {
    p.sun_near = 0.1 * rgb(), p.sun_far = 0.1 * rgb();
    p.sun_entry = {0.3, 0, 0.2}, p.mean_scatter_distance = 0.8;
  }
  if (random.has(StatePart::kDryBottom))
    p.dry_bottom = rgb(), p.dry_lit = p.dry_lit_known = p.filled = 0.5;
  if (random.has(StatePart::kTransmitted)) p.transmitted = rgb();
  if (random.has(StatePart::kInScatter)) p.in_scatter = rgb();
  if (random.has(StatePart::kFresnel)) p.fresnel = 0.5 + 0.5 * number();
  if (random.has(StatePart::kReflected)) p.reflected = rgb();
  if (random.has(StatePart::kMirrorSources)) p.mirror_sources = rgb();
  if (random.has(StatePart::kHighlight)) p.highlight = rgb();
  if (random.has(StatePart::kConfidence)) p.confidence = 0.5 + 0.5 * number();
  return p;
}

}  // namespace limpid::test
