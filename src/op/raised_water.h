#pragma once
#include <numbers>
#include <vector>

#include "core/water_view.h"

/// @file
/// The intersection of rays with water that sine waves raise.

namespace limpid {

/// A sine wave relative to the eye: its height is amplitude sin(2 pi (begin + k_x u + k_y v)) at
/// (u, v), along WaterView::map_x and map_y from the point below the eye. N: float or double.
template <class N>
struct WaveTerm {
  N amplitude, k_x, k_y, begin;
};

/// All sine waves of the water.
template <class N>
struct RaisedWater {
  std::vector<WaveTerm<N>> waves;
  N crest = 0;     ///< the largest height over the calm surface; no wave is lower than its negative
  N steepest = 0;  ///< the largest slope of the water

  /// From WaterView::waves. Allocates no memory if there are no more waves than before.
  void make(const WaterView& c) {
    constexpr double kTurn = 2 * std::numbers::pi;
    double height = 0, slope = 0;
    waves.clear();
    for (const SineWave& wave : c.waves) {
      const double amplitude = c.wave_scale * wave.amplitude;
      waves.push_back({static_cast<N>(amplitude), static_cast<N>(wave.k_x / kTurn),
                       static_cast<N>(wave.k_y / kTurn),
                       static_cast<N>(c.phase_at_eye(wave) / kTurn)});
      height += std::abs(amplitude);
      slope += std::abs(amplitude) * std::hypot(wave.k_x, wave.k_y);
    }
    crest = static_cast<N>(height);
    steepest = static_cast<N>(slope);
  }
};

/// One ray and the water: the ray's height over the water at each eye depth.
template <class F, class N>
class RaisedRay {
 public:
  /// x: as in RowRays.
  LIMPID_INLINE RaisedRay(const WaterView& c, const RaisedWater<N>& water, const RowRays<F>& row,
                          F x)
      : water_(water),
        over_(F(0) - (row.calm_over + x * row.calm_over_dx)),
        under_(row.calm_under + x * row.calm_under_dx) {
    const Vec3<F> map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y);
    const Vec3<F> origin = row.origin_at(x), ray = row.ray_at(x);
    u_ = dot(map_x, origin), v_ = dot(map_y, origin);
    u_step_ = dot(map_x, ray), v_step_ = dot(map_y, ray);
    start_ = F(c.w_depth == 0 ? 0 : c.near);
  }

  /// Eye depth of the first intersection, +inf if there is none. Six steps between the highest and
  /// the lowest possible water search a change of sides, and the point is refined between two of
  /// them. A ray that sinks faster than any wave has a single intersection and needs no steps.
  LIMPID_INLINE F first_meeting() const {
    const F crest(water_.crest), infinite(HUGE_VAL);
    const auto level = abs(under_) < F(1e-30);
    const F per_under = F(1) / select(level, F(1e-30), under_);
    const F top = (crest - over_) * per_under, bottom = (F(-1) * crest - over_) * per_under;
    const F begin = max(min(top, bottom), start_), end = min(max(top, bottom), F(kFarthest));
    const auto in_reach = end > begin;
    F depth = infinite;
    if_any(in_reach, [&] {
      const F first = calm_height(start_);
      const auto inside = abs(first) < crest;
      F clear = select(inside, F(0), first);
      if_any(inside && in_reach, [&] { clear = select(inside, height(start_), first); });
      // From here on heights are positive on the side where the ray begins.
      const F side = select(clear < F(0), F(-1), F(1));
      const auto comes = side * under_ < F(0);  // it leaves the water on the other side
      const auto sinks =
          abs(under_) > F(water_.steepest) * sqrt(u_step_ * u_step_ + v_step_ * v_step_);
      Bracket b{begin, end, select(inside, abs(clear), crest), F(-1) * crest,
                select(comes && sinks && in_reach, F(1), F(0))};
      if_any(in_reach && !sinks,
             [&] { look_for_change(side, inside, in_reach && !sinks, comes, b); });
      if_any(b.found > F(0.5),
             [&] { depth = select(b.found > F(0.5), narrowed(side, b), infinite); });
    });
    return select(depth < F(kFarthest), depth, infinite);
  }

 private:
  static constexpr int kSteps = 6, kRefinements = 12;
  static constexpr double kSettled = 3e-7;  ///< rounding, as a share of the depth
  static constexpr double kFarthest = 1e30;

  /// Two eye depths and the ray's heights there: above 0, and not.
  struct Bracket {
    F near, far, at_near, at_far;
    F found;  ///< 1 or 0
  };

  LIMPID_INLINE F calm_height(F depth) const { return over_ + depth * under_; }

  /// Height over the water.
  LIMPID_INLINE F height(F depth) const {
    const F u = u_ + depth * u_step_, v = v_ + depth * v_step_;
    F height = calm_height(depth);
    for (const WaveTerm<N>& wave : water_.waves) {
      const F turns = F(wave.begin) + F(wave.k_x) * u + F(wave.k_y) * v;
      // Beyond this a number cannot resolve the phase: the waves average out.
      const auto known = abs(turns) < F(1e6);
      const F within = select(known, turns - floor(turns), F(0));
      height = height - F(wave.amplitude) * sin(F(2 * std::numbers::pi) * within);
    }
    return height;
  }

  template <class M>
  LIMPID_INLINE void look_for_change(F side, M inside, M seeks, M comes, Bracket& b) const {
    const F begin = b.near, span = b.far - b.near;
    F open = select(seeks, F(1), F(0)), near = b.near, at_near = b.at_near;
    steps<F>(1, kSteps + 1, [&](auto i) {
      const F even = Loop<F>::ratio(i, kSteps);
      // A ray that begins between the waves has smaller steps at its begin.
      const F depth = begin + select(inside, even * even, even) * span;
      const F here = side * height(depth);
      const auto last = comes && even > F(1 - 0.5 / kSteps);  // despite rounding
      const auto met = open > F(0.5) && (here <= F(0) || last);
      b.near = select(met, near, b.near), b.at_near = select(met, at_near, b.at_near);
      b.far = select(met, depth, b.far), b.at_far = select(met, min(here, F(0)), b.at_far);
      b.found = select(met, F(1), b.found);
      open = select(met, F(0), open);
      near = depth, at_near = here;
      return open > F(0.5);
    });
  }

  /// Narrows the bracket by secants, by bisection if a secant leads out.
  LIMPID_INLINE F narrowed(F side, Bracket& b) const {
    F slope = (b.at_far - b.at_near) / (b.far - b.near);
    F depth = b.near - b.at_near / slope, last = b.near, at_last = b.at_near, open = b.found;
    steps<F>(0, kRefinements, [&](auto) {
      const F here = side * height(depth), change = here - at_last;
      // For nearly equal heights rounding would decide the slope.
      slope = select(abs(change) > F(1e-4 * water_.crest), change / (depth - last), slope);
      const auto before = here > F(0);
      b.near = select(before, depth, b.near);
      b.far = select(before, b.far, depth);
      last = depth, at_last = here;
      F next = depth - here / slope;
      next = select(next >= b.near && next <= b.far, next, F(0.5) * (b.near + b.far));
      const auto goes_on = open > F(0.5) && abs(next - depth) > F(kSettled) * depth;
      depth = select(open > F(0.5), next, depth);
      open = select(goes_on, F(1), F(0));
      return goes_on;
    });
    return depth;
  }

  const RaisedWater<N>& water_;
  F over_, under_;  ///< height over the calm surface at the eye, and its gain with eye depth
  F u_, v_, u_step_, v_step_;
  F start_;  ///< eye depth at which the view begins
};

}  // namespace limpid
