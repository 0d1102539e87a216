#pragma once
#include <cmath>
#include <vector>

#include "limpid/op/context.h"

#include "support.h"

namespace limpid::test {

/// Pixels in any state, to which an operator is applied alone, in double. Its samplers give noise
/// and remember what was asked of them.
class ProbeStrip {
 public:
  using Number = double;

  std::vector<Pixel<double>> pixels;
  PlaneSet tapped;
  bool map_tapped = false;
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

 private:
  static PlaneSet three(PlaneId first) {
    return {first, plane_after(first, 1), plane_after(first, 2)};
  }
  static double texel(std::size_t i, PlaneId plane) {
    return 6 * noise(static_cast<int>(i), index_of(plane), 80);
  }
  template <class Where>
  void note(Where&& where) {
    for (const Pixel<double>& p : pixels) {
      const Vec2<double> shift = where(p);
      farthest = max(farthest, max(std::abs(shift.x), std::abs(shift.y)));
    }
  }
};

/// A part of the running state as numbers, to see whether it changed.
inline std::vector<double> values_of(const Pixel<double>& p, StatePart part) {
  switch (part) {
    case StatePart::kNormal:
      return {p.normal.x, p.normal.y, p.normal.z, p.tilt.x, p.tilt.y};
    case StatePart::kPrism:
      return {p.prism_r.x, p.prism_r.y, p.prism_g.x, p.prism_g.y, p.prism_b.x, p.prism_b.y};
    case StatePart::kPosition:
      return {p.shift.x, p.shift.y, p.hit_depth};
    case StatePart::kPath:
      return {p.path};
    case StatePart::kTransmitted:
      return {p.transmitted.r, p.transmitted.g, p.transmitted.b};
    case StatePart::kInScatter:
      return {p.in_scatter.r, p.in_scatter.g, p.in_scatter.b};
    case StatePart::kFresnel:
      return {p.fresnel};
    case StatePart::kReflected:
      return {p.reflected.r, p.reflected.g, p.reflected.b};
    case StatePart::kHighlight:
      return {p.highlight.r, p.highlight.g, p.highlight.b};
    case StatePart::kConfidence:
      return {p.confidence};
  }
  return {};
}

constexpr StatePart kStateParts[] = {
    StatePart::kNormal,      StatePart::kPrism,     StatePart::kPosition, StatePart::kPath,
    StatePart::kTransmitted, StatePart::kInScatter, StatePart::kFresnel,  StatePart::kReflected,
    StatePart::kHighlight,   StatePart::kConfidence};

/// What the fixed part of a pixel says, then random state in the given parts; elsewhere it is as
/// before the first operator.
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
  p.normal = up;
  p.hit_depth = p.dry_depth;
  p.confidence = 1;
  p.transmitted = rgb();
  if (random.has(StatePart::kNormal)) {
    p.normal = normalize_or<double>({0.4 * number(), 1, 0.4 * number()}, up);
    p.tilt = {p.normal.x, p.normal.z};
  }
  if (random.has(StatePart::kPrism)) {
    p.prism_r = {0.01 * number(), 0};
    p.prism_g = {0.01 * number(), 0.01 * number()};
    p.prism_b = {0, 0.01 * number()};
  }
  if (random.has(StatePart::kPosition)) {
    p.shift = {0.05 * number(), 0.05 * number()};
    p.hit_depth = p.surface_depth + 2 + number();
  }
  if (random.has(StatePart::kPath)) p.path = 2 + number();
  if (random.has(StatePart::kTransmitted)) p.transmitted = rgb();
  if (random.has(StatePart::kInScatter)) p.in_scatter = rgb();
  if (random.has(StatePart::kFresnel)) p.fresnel = 0.5 + 0.5 * number();
  if (random.has(StatePart::kReflected)) p.reflected = rgb();
  if (random.has(StatePart::kHighlight)) p.highlight = rgb();
  if (random.has(StatePart::kConfidence)) p.confidence = 0.5 + 0.5 * number();
  return p;
}

}  // namespace limpid::test
