#pragma once
#include <cmath>
#include <numbers>
#include <string>

#include "limpid/ops/wave_normals.h"

#include "op/footprint.h"
#include "op/operator.h"
#include "optics/wind.h"

namespace limpid {

template <>
struct Kernel<WaveNormals> : WaveNormals {
  static constexpr StateSet kUses{};
  static constexpr StateSet kMakes{StatePart::kNormal, StatePart::kSlopeVariance};
  static PlaneSet reads(const Params& p) {
    return p.model == Model::kPlate ? kSurfaceNormalPlanes : PlaneSet{};
  }
  static Needs needs(const Params& p) {
    const bool from_map = p.model != Model::kPlate && p.model != Model::kSines;
    return {.planes = reads(p), .wave_map = from_map};
  }
  /// Waves with known heights raise the water. A plate's own surface depth is better; maps and the
  /// frame's normals give slopes, but no heights.
  static PlaneSet wants(const Params& p, const AtHand& has) {
    const bool known = p.model == Model::kSines && (!p.waves.empty() || has.waves);
    return known && p.strength != 0 ? PlaneSet{PlaneId::kSurfaceDepth} : PlaneSet{};
  }
  static double reach(const Params&) { return 0; }
  static bool neutral(const Params& p, StateSet) {
    return p.model != Model::kPlate && p.strength == 0;
  }
  /// Whether it reads Pass::wave_slopes.
  static bool needs_slope_map(const Params& p) {
    return p.model == Model::kSlopes && p.filter != Filter::kNone;
  }
  /// The drift of maps at a time in s, in periods of tile_size.
  LIMPID_INLINE static double drift(const Params& params, double time) {
    return params.speed * time / params.tile_size;
  }
  /// The shifts of the lookups of four_maps and slopes at a time in s.
  LIMPID_INLINE static FourShifts four_shifts(const Params& params, double time) {
    if (params.wind > 0) {
      FourShifts shifts;
      for (int i = 0; i < 4; ++i) {
        shifts.of[i] = kTrains[i].begin - run(params, kTrains[i], time);
      }
      return shifts;
    }
    const double move = drift(params, time);
    return {{{move, 0}, {-move, 0}, {0, move}, {0, -move}}};
  }
  /// Whether it reads Pass::wave_variance.
  static bool needs_wave_variance(const Params& p) { return p.wind > 0 && needs(p).wave_map; }
  /// Variance of these waves at strength 1 without the wind's scale, at a time in s.
  static Sym2<double> wave_variance(const Params& params, const TextureLevels& map, double time);
  static double bound(const Params& params, const Pass& c, const Ranges& ranges);
  /// Normals of the plate are better than computed normals.
  static std::string_view prefer(Params& params, const AtHand& has);
  static Swell swell(const Params& params) { return {true, params.waves, params.strength}; }
  static double ns(const Params& params, const Running& running);

  template <class Strip>
  static void apply(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    const bool variance = params.filter == Filter::kVariance;
    if (!variance || (params.model != Model::kPlate && params.model != Model::kSines)) {
      strip.each([](Pixel<F>& p) { p.slope_variance = {F(0), F(0), F(0)}; });
    }
    switch (params.model) {
      case Model::kPlate:
        if (variance) {
          plate_sample(c, strip);
        } else {
          strip.own3(PlaneId::kSurfaceNormalX, [](Pixel<F>& p, Vec3<F> n) { p.normal = n; });
        }
        break;
      case Model::kFourMaps:
        four_maps(params, c, strip);
        break;
      case Model::kTwoFlows:
        two_flows(params, c, strip);
        break;
      case Model::kDudv:
        return dudv(params, c, strip);
      case Model::kSines:
        sines(params, c, strip);
        break;
      case Model::kSlopes:
        slopes(params, c, strip);
        break;
    }
    const Vec3<F> t = vec3_of<F>(c.t), b = vec3_of<F>(c.b);
    strip.each([&](Pixel<F>& p) { p.tilt = {dot(p.normal, t), F(0) - dot(p.normal, b)}; });
  }

 private:
  /// Waves of one length, in tiles, that run along `course`: along the wind and across it. Each
  /// train's lookup begins at its own offset, in periods, so that no two trains show the same
  /// waves.
  struct Train {
    double length;
    Vec2<double> course, begin;
  };
  static constexpr Train kAhead{0.125, {1, 0}, {0, 0}};
  static constexpr Train kTrains[4] = {{0.25, {0.965926, 0.258819}, {0, 0}},
                                       {0.176777, {0.906308, -0.422618}, {0.7549, 0.5698}},
                                       {0.125, {0.766044, 0.642788}, {0.5098, 0.1397}},
                                       {0.088388, {0.766044, -0.642788}, {0.2647, 0.7095}}};

  /// Unit, along the axes of the map.
  LIMPID_INLINE static Vec2<double> downwind(const Params& params) {
    const double angle = params.direction * (std::numbers::pi / 180);
    return {std::cos(angle), std::sin(angle)};
  }
  /// The distance that waves have run at a time in s, in periods of tile_size.
  LIMPID_INLINE static Vec2<double> run(const Params& params, const Train& train, double time) {
    const Vec2<double> ahead = downwind(params), aside{-ahead.y, ahead.x};
    const double speed = phase_speed(train.length * params.tile_size);
    const Vec2<double> of_skin = skin_drift(params.wind) * ahead;
    return time / params.tile_size *
           (of_skin + speed * (train.course.x * ahead + train.course.y * aside));
  }
  /// Factors by which the wind multiplies slopes, along it and across it.
  LIMPID_INLINE static Vec2<double> wind_factors(const Params& params, const Pass& c) {
    const Vec2<double> ahead = downwind(params);
    const WindSlopes wanted = wind_slopes(params.wind);
    const auto factor = [&](Vec2<double> axis, double square) {
      const double is = along(c.wave_variance, axis);
      return is > kFlattest ? std::sqrt(square / is) : 1.0;
    };
    return {factor(ahead, wanted.along), factor({-ahead.y, ahead.x}, wanted.across)};
  }
  static constexpr double kFlattest = 4e-5;  ///< bytes one step apart vary by 3e-5

  /// Scales vectors in the axes of the map, and their variance, by the wind factors.
  template <class Strip>
  static void stretch(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    if (!(params.wind > 0)) return;
    const Vec2<double> ahead = downwind(params), factors = wind_factors(params, c);
    const double more = factors.x - factors.y;  // factors.y everywhere, and more along the wind
    const char* name = "wave_normals.stretch";
    const F xx = given<F>(factors.y + more * ahead.x * ahead.x, name, 0);
    const F xy = given<F>(more * ahead.x * ahead.y, name, 1);
    const F yy = given<F>(factors.y + more * ahead.y * ahead.y, name, 2);
    strip.each([&](Pixel<F>& p) {
      const F x = p.normal.x, y = p.normal.y;
      p.normal.x = xx * x + xy * y;
      p.normal.y = xy * x + yy * y;
    });
    if (params.model != Model::kSlopes || params.filter != Filter::kVariance) return;
    strip.each([&](Pixel<F>& p) {
      const Sym2<F> v = p.slope_variance;
      const F mixed = xx * (xy * v.xx + yy * v.xy) + xy * (xy * v.xy + yy * v.yy);
      p.slope_variance = {max(along(v, Vec2<F>{xx, xy}), F(0)), mixed,
                          max(along(v, Vec2<F>{xy, yy}), F(0))};
    });
  }

  /// A normal of the plate is one sample of the waves in the pixel. For a Gaussian field with that
  /// sample, the expected mean over a footprint S is `kept` times the sample, and the visible
  /// slopes vary around that mean by the rest. Where neighbours have equal normals there are no
  /// waves.
  template <class Strip>
  static void plate_sample(const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    const auto of_plate = [](const Sym2<double>& s, const char* name) {
      return Sym2<F>{given<F>(s.xx, name, 0), given<F>(s.xy, name, 1), given<F>(s.yy, name, 2)};
    };
    const Sym2<F> variance = of_plate(c.plate_waves.variance, "plate_waves.variance");
    const Sym2<F> turn = of_plate(c.plate_waves.turn, "plate_waves.turn");
    const F turn_area = max(turn.xx * turn.yy - turn.xy * turn.xy, F(0));
    // A footprint is 1/12 of what lies between neighbouring pixels.
    const F smooth = given<F>(12 * c.plate_waves.smooth, "plate_waves.smooth");
    const F enough = F(kWavy) * max(variance.xx + variance.yy, F(1e-12));
    const Vec3<F> up = vec3_of<F>(c.up);
    strip.around3(PlaneId::kSurfaceNormalX, [&](Pixel<F>& p, const Around<F>& normals) {
      const Vec3<F> n = normals[4];
      const Sym2<F> s = footprint(c, p);
      const F along = max(turn.xx * s.xx + F(2) * turn.xy * s.xy + turn.yy * s.yy, F(0));
      const F area = max(s.xx * s.yy - s.xy * s.xy, F(0)), less = F(1) / (F(1) + smooth * along);
      const F square = F(1) / (F(1) + less * (along + less * turn_area * area));
      const F kept = sqrt(square), rise = dot(n, up);
      p.normal = n;
      p.slope_variance = {F(0), F(0), F(0)};
      const auto coarse = square < F(kResolved);
      if_any(coarse, [&] {
        Vec3<F> sum{F(0), F(0), F(0)};
        for (int k = 0; k < 9; ++k) sum = sum + normals[k];
        // The mean of unit normals that differ little is shorter by half their variance.
        const F differ = max(F(1) - dot(sum, sum) * F(1.0 / 81), F(0));
        const F wavy = min(differ / enough, F(1));
        const F lost = select(coarse, wavy * (F(1) - kept), F(0));
        p.normal = select(coarse, normalize_or(n + lost * (rise * up - n), up), n);
        p.slope_variance = select(coarse, wavy * (F(1) - square), F(0)) * variance;
      });
    });
  }
  static constexpr double kResolved = 0.9999;  ///< of a wave's variance
  /// Share of the frame's slope variance that nine neighbours show where there are waves.
  static constexpr double kWavy = 0.3;

  // While the models gather, p.normal holds their sums, in the axes of the map.

  template <class Strip>
  static void four_maps(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    measure(params.filter != Filter::kNone, params, c, strip);
    drifting_four(params, c, strip, [&](const Place<F>& place) {
      strip.tiled_rgb(c.wave_map, Wide<F>{}, place, [](Pixel<F>& p, Rgb<F> map) {
        p.normal = p.normal + Vec3<F>{map.r, map.g, map.b};
      });
    });
    strip.each([&](Pixel<F>& p) {  // four colors in 0 ... 1: their mean decodes as sum / 2 - 1
      p.normal = F(0.5) * p.normal - Vec3<F>{F(1), F(1), F(1)};
    });
    blend_from_calm(params, c, strip);
  }

  template <class Strip>
  static void two_flows(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    const Vec2<double> flow = drift(params, c.time) * downwind(params);
    const bool windy = params.wind > 0;
    const Vec2<double> first = windy ? -1.0 * run(params, kAhead, c.time) : flow;
    const Vec2<double> second = windy ? -0.5 * run(params, kTrains[0], c.time) : -0.3 * flow;
    measure(params.filter != Filter::kNone, params, c, strip);
    strip.tiled_rgb(c.wave_map, Wide<F>{}, Place<F>(params, c, 0, 1, first),
                    [](Pixel<F>& p, Rgb<F> map) {
                      p.normal = {map.r, map.g, map.b};
                    });
    strip.tiled_rgb(c.wave_map, Wide<F>{0.5}, Place<F>(params, c, 1, 0.5, second),
                    [](Pixel<F>& p, Rgb<F> map) {
                      // ((2 c1 - 1) + (2 c2 - 1) / 2) / 2
                      const Vec3<F> both = p.normal + F(0.5) * Vec3<F>{map.r, map.g, map.b};
                      p.normal = both - Vec3<F>{F(0.75), F(0.75), F(0.75)};
                    });
    blend_from_calm(params, c, strip);
  }

  template <class Strip>
  static void dudv(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    const double move = drift(params, c.time);
    const bool windy = params.wind > 0;
    const Vec2<double> first =
        windy ? -1.0 * run(params, kTrains[2], c.time) : Vec2<double>{move, 0};
    const Vec2<double> second = windy ? -1.0 * run(params, kAhead, c.time) : Vec2<double>{0, move};
    measure(params.filter != Filter::kNone, params, c, strip);
    strip.tiled_rgb(c.wave_map, Wide<F>{}, Place<F>(params, c, 0, 1, first),
                    [](Pixel<F>& p, Rgb<F> map) {
                      p.normal = F(0.01) * Vec3<F>{map.r, map.g, F(0)};
                    });
    const Place<F> place(params, c, 1, 1, second);
    const Vec2<double> factors = windy ? wind_factors(params, c) : Vec2<double>{1, 1};
    const double steeper = windy ? std::hypot(factors.x, factors.y) / std::numbers::sqrt2 : 1;
    const F strength = given<F>(params.strength * steeper, "wave_normals.steepness");
    strip.tiled_rgb(
        c.wave_map, Wide<F>{},
        [&](const Pixel<F>& p) {
          return place(p) + Vec2<F>{p.normal.x, p.normal.y};
        },
        [&](Pixel<F>& p, Rgb<F> map) {
          const F x = F(2) * map.r - F(1), y = F(2) * map.g - F(1);
          const auto scaled = [&](F v) { return min(max(lerp(F(0), v, strength), F(-1)), F(1)); };
          p.normal = {x, y, map.b};
          p.tilt = {scaled(x), scaled(y)};
        });
    blend_from_calm(params, c, strip);
  }

  template <class Strip>
  static void sines(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    constexpr double kTurn = 2 * std::numbers::pi;
    const Vec3<F> map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y);
    const bool variance = params.filter == Filter::kVariance;
    strip.each([&](Pixel<F>& p) {
      p.normal = {F(0), F(0), F(0)};
      if (variance) p.slope_variance = {F(0), F(0), F(0)};
    });
    int nth = -1;
    for (const SineWave& wave : params.waves.empty() ? c.waves : params.waves) {
      ++nth;
      // Phases in turns; phases below the eye are reduced in double.
      const F begin = given<F>(c.phase_at_eye(wave) / kTurn, "waves.begin", nth);
      const Vec3<F> step = given<F>(wave.k_x / kTurn, "waves.turns_x", nth) * map_x +
                           given<F>(wave.k_y / kTurn, "waves.turns_y", nth) * map_y;
      const auto steepest = [&](double k) {
        return min(max(wave.amplitude * k, -kSteepest), kSteepest);
      };
      const F slope_x = given<F>(steepest(wave.k_x), "waves.slope_x", nth);
      const F slope_y = given<F>(steepest(wave.k_y), "waves.slope_y", nth);
      const Vec2<F> k{given<F>(wave.k_x), given<F>(wave.k_y)};
      strip.each([&](Pixel<F>& p) {
        const F turns = begin + dot(p.surface_point, step);
        // Beyond this a float cannot resolve the phase: the waves average out.
        const auto known = abs(turns) < F(1e6);
        const F within = select(known, turns - floor(turns), F(0));
        const F cosine = select(known, cos(F(kTurn) * within), F(0));
        F rise = cosine;
        if (variance) {
          // Of a wave with many radians in the pixel, e^-40 is left: nothing.
          const F q = select(known, min(max(along(footprint(c, p), k), F(0)), F(40)), F(40));
          if_any(q > F(kLeastRadians), [&] {
            const F kept = exp(F(-0.5) * q), square = kept * kept;
            const F twice = F(2) * cosine * cosine - F(1);
            const F lost = F(0.5) * (F(1) + twice * square * square) - cosine * cosine * square;
            const F unseen = select(q > F(kLeastRadians), max(lost, F(0)), F(0));
            rise = select(q > F(kLeastRadians), kept * cosine, cosine);
            p.slope_variance =
                p.slope_variance +
                unseen * Sym2<F>{slope_x * slope_x, slope_x * slope_y, slope_y * slope_y};
          });
        }
        p.normal = p.normal - Vec3<F>{rise * slope_x, rise * slope_y, F(0)};
      });
    }
    if (variance) {
      const F scale = given<F>(params.strength * params.strength, "wave_normals.square");
      strip.each([&](Pixel<F>& p) { p.slope_variance = scale * p.slope_variance; });
    }
    lean(params.strength, c, strip);
  }
  /// Square of a wave's radians in a pixel below which the pixel resolves the wave.
  static constexpr double kLeastRadians = 1e-3;

  /// Where a pixel is 1 to 2 texels wide, the four lookups blend into one lookup of the slope map.
  template <class Strip>
  static void slopes(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    const bool filtered = needs_slope_map(params) && c.wave_slopes;
    measure(filtered, params, c, strip);
    drifting_four(params, c, strip, [&](const Place<F>& place) {
      const auto resolved = [](const Pixel<F>& p) { return p.tilt.x < F(2); };
      strip.tiled_rgb_if(c.wave_map, resolved, place, [](Pixel<F>& p, Rgb<F> map) {
        const F per_z = F(1) / max(F(2) * map.b - F(1), F(0.05));
        const Vec3<F> leans{(F(2) * map.r - F(1)) * per_z, (F(2) * map.g - F(1)) * per_z, F(0)};
        p.normal = p.normal + leans;
      });
    });
    if (filtered) far_slopes(params, c, strip);
    stretch(params, c, strip);
    lean(0.25 * params.strength, c, strip);
  }

  template <class Strip>
  static void far_slopes(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    const F per_map_texel = given<F>(1 / c.wave_slopes->map_texels, "wave_map.per_texel");
    const bool variance = params.filter == Filter::kVariance;
    const F scale =
        given<F>(variance ? params.strength * params.strength : 0, "wave_normals.filtered_square");
    strip.tiled_slopes_if(
        *c.wave_slopes, [](const Pixel<F>& p) { return p.tilt.x > F(1); },
        [&](const Pixel<F>& p) { return per_map_texel * max(p.tilt.x, F(2)); },
        Place<F>(params, c, 4, 1, {0, 0}),
        [&](Pixel<F>& p, SlopeMoments<F> far) {
          const F width = p.tilt.x;
          const F share = saturate(width - F(1));
          const Vec2<F> near{F(0.25) * p.normal.x, F(0.25) * p.normal.y};
          const auto all = width >= F(2), some = width > F(1);
          const Vec2<F> mean = select(all, far.mean, near + share * (far.mean - near));
          const auto unseen = [&](F near_xy, F far_xy, F mean_xy) {
            return scale * (select(all, far_xy, lerp(near_xy, far_xy, share)) - mean_xy);
          };
          const F xx = unseen(near.x * near.x, far.square.xx, mean.x * mean.x);
          const F xy = unseen(near.x * near.y, far.square.xy, mean.x * mean.y);
          const F yy = unseen(near.y * near.y, far.square.yy, mean.y * mean.y);
          p.normal.x = select(some, F(4) * mean.x, p.normal.x);
          p.normal.y = select(some, F(4) * mean.y, p.normal.y);
          p.slope_variance = {select(some, max(xx, F(0)), F(0)), select(some, xy, F(0)),
                              select(some, max(yy, F(0)), F(0))};
        });
  }

  /// While a model looks up a map, p.tilt.x is the width of the pixel in texels of the map: 0
  /// without a filter.
  template <class Strip>
  static void measure(bool filtered, const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    if (!filtered) return strip.each([](Pixel<F>& p) { p.tilt.x = F(0); });
    const Rect& window = c.wave_map.channels[0].window;
    const Vec2<double> texels{window.width() / params.tile_size,
                              window.height() / params.tile_size};
    strip.each([&](Pixel<F>& p) { p.tilt.x = texels_wide(footprint(c, p), texels, kNarrowest); });
  }
  /// Least ratio of a footprint's width to its length: the filters of engines give a pixel four
  /// lookups for a footprint four times as long as wide, and one lookup may not blur more.
  static constexpr double kNarrowest = 0.25;

  /// Width in texels of a map with this tiling.
  template <class F>
  struct Wide {
    double tiling = 1;
    LIMPID_INLINE F operator()(const Pixel<F>& p) const { return F(tiling) * p.tilt.x; }
  };

  /// look_up(place) for the four places of four_maps, which add to p.normal.
  template <class Strip, class LookUp>
  static void drifting_four(const Params& params, const Pass& c, Strip& strip, LookUp&& look_up) {
    using F = typename Strip::Number;
    strip.each([&](Pixel<F>& p) { p.normal = {F(0), F(0), F(0)}; });
    const FourShifts shifts = four_shifts(params, c.time);
    for (int i = 0; i < 4; ++i) look_up(Place<F>(params, c, i, 1, shifts.of[i]));
  }

  /// The normal from a vector in the axes of the map: normalize(lerp(up, vector, strength)).
  template <class Strip>
  static void blend_from_calm(const Params& params, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    const Vec3<F> map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y), up = vec3_of<F>(c.up);
    const F strength = given<F>(params.strength);
    stretch(params, c, strip);
    strip.each([&](Pixel<F>& p) {
      const Vec3<F> n = p.normal.x * map_x + p.normal.y * map_y + p.normal.z * up;
      p.normal = normalize_or(up + strength * (n - up), up);
    });
  }

  /// The normal from downhill slopes along the axes of the map.
  template <class Strip>
  static void lean(double scale, const Pass& c, Strip& strip) {
    using F = typename Strip::Number;
    const Vec3<F> map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y), up = vec3_of<F>(c.up);
    const F s = given<F>(scale, "wave_normals.lean");
    strip.each([&](Pixel<F>& p) {
      p.normal = normalize_or(up + (s * p.normal.x) * map_x + (s * p.normal.y) * map_y, up);
    });
  }

  static constexpr double kSteepest = 1e9;  ///< slope of one wave; its square is finite in float

  /// The pixel's place in the map, in periods since the world's origin; reduced in double before it
  /// becomes a float.
  template <class F>
  struct Place {
    F u0, v0;
    Vec3<F> u_step, v_step;

    /// `nth` distinguishes the places of one model.
    Place(const Params& params, const Pass& c, int nth, double tiling, Vec2<double> moved) {
      const double scale = tiling / params.tile_size;
      const auto begin = [&](const glm::dvec3& axis, double move, const char* name) {
        const double at = c.eye.x * axis.x + c.eye.y * axis.y + c.eye.z * axis.z;
        const double rest = std::fmod(at * scale, 1.0) + std::fmod(move, 1.0);
        return given<F>(rest - std::floor(rest), name, nth);
      };
      u0 = begin(c.map_x, moved.x, "wave_map.begin_u");
      v0 = begin(c.map_y, moved.y, "wave_map.begin_v");
      const F tiles = given<F>(scale, "wave_map.tiles", nth);
      u_step = tiles * vec3_of<F>(c.map_x), v_step = tiles * vec3_of<F>(c.map_y);
    }
    LIMPID_INLINE Vec2<F> operator()(const Pixel<F>& p) const {
      return {u0 + dot(p.surface_point, u_step), v0 + dot(p.surface_point, v_step)};
    }
  };
};

}  // namespace limpid
