#pragma once
#include <cmath>
#include <numbers>
#include <string>

#include "limpid/op/operator.h"

namespace limpid {

/// The normal of the wavy surface, and its tilt m = (n.t, -n.b) as the camera sees it.
///
/// `plate`: the frame's own surface normals. The planner takes this model whenever there are any.
/// The others make waves; `strength` 0 is calm, 1 the waves as they are. Those with a tiling normal
/// map tie it to the world, one period every tile_size units; its red, green, blue are (2 c - 1)
/// along map x, map y and up.
///
/// `four_maps` ("Realistic Water"): four lookups that drift along +x, -x, +y and -y; n =
/// normalize(mean of lerp(up, n_i, strength)). Blending vectors instead of slopes flattens steep
/// waves; kept as the article has it.
///
/// `two_flows` (Rito15 2021): n = normalize(lerp(up, (n1 + n2 / 2) / 2, strength)), n1 drifts along
/// `direction`, n2, half as densely tiled, back at 0.3 of the speed. The article does not normalise
/// and so reflects less than it means to.
///
/// `dudv` (Digiorgio 2024): a first lookup at (u + move, v), times 0.01, distorts the place (u, v +
/// move) of a second; its normal is (2r - 1, 2g - 1, b) along map x, map y and up: blue is not
/// decoded, which flattens, kept as the article has it. The tilt is not this normal's: the article
/// takes (2r - 1, 2g - 1) for right and down on screen wherever the camera looks, and so does this
/// model, to within -1 ... 1.
///
/// `sines`: the true normals of a sum of sine waves: `waves`, or the scene's own where there are
/// none. Calm when neither has any.
///
/// `slopes`: the lookups of four_maps, but slopes are added: with h the mean of (-n_x, -n_y) / n_z
/// times strength, n = normalize(-h_x, -h_y, 1). n_z below 0.05 counts as 0.05, so no slope passes
/// 20. Mikkelsen 2020, "Surface Gradient-Based Bump Mapping Framework".
struct WaveNormals {
  enum class Model { kFourMaps, kTwoFlows, kDudv, kSines, kSlopes, kPlate };
  struct Params {
    Model model = Model::kSlopes;
    double strength = 0.5;
    double tile_size = 4;
    double speed = 0.3;
    double direction = 135;
    std::string map;
    std::vector<SineWave> waves;
  };

  static constexpr std::string_view kName = "wave_normals";
  static constexpr std::string_view kAbout = "Normal of the wavy surface and its tilt on screen.";
  static constexpr StateSet kUses{};
  static constexpr StateSet kMakes{StatePart::kNormal};
  static std::span<const Field<Params>> fields();
  static PlaneSet reads(const Params& p) {
    return p.model == Model::kPlate ? kSurfaceNormalPlanes : PlaneSet{};
  }
  static Needs needs(const Params& p) {
    const bool from_map = p.model != Model::kPlate && p.model != Model::kSines;
    return {.planes = reads(p), .wave_map = from_map};
  }
  static double reach(const Params&) { return 0; }
  static bool neutral(const Params& p, StateSet) {
    return p.model != Model::kPlate && p.strength == 0;
  }
  static double bound(const Params& params, const Context& c, const Ranges& ranges);

  template <class Strip>
  static void apply(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    switch (params.model) {
      case Model::kPlate:
        strip.own3(PlaneId::kSurfaceNormalX, [](Pixel<F>& p, Vec3<F> n) { p.normal = n; });
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
  // While the models gather, p.normal holds their sums, in the axes of the map.

  template <class Strip>
  static void four_maps(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    drifting_four(params, c, strip, [](Pixel<F>& p, Rgb<F> map) {
      p.normal = p.normal + Vec3<F>{map.r, map.g, map.b};
    });
    strip.each([&](Pixel<F>& p) {  // four colors in 0 ... 1: their mean decodes as sum / 2 - 1
      p.normal = F(0.5) * p.normal - Vec3<F>{F(1), F(1), F(1)};
    });
    blend_from_calm(params, c, strip);
  }

  template <class Strip>
  static void two_flows(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    const double angle = params.direction * (std::numbers::pi / 180);
    const Vec2<double> flow = drift(params, c) * Vec2<double>{std::cos(angle), std::sin(angle)};
    strip.tiled_rgb(c.wave_map, Place<F>(params, c, 1, flow), [](Pixel<F>& p, Rgb<F> map) {
      p.normal = {map.r, map.g, map.b};
    });
    strip.tiled_rgb(c.wave_map, Place<F>(params, c, 0.5, -0.3 * flow), [](Pixel<F>& p, Rgb<F> map) {
      // ((2 c1 - 1) + (2 c2 - 1) / 2) / 2
      const Vec3<F> both = p.normal + F(0.5) * Vec3<F>{map.r, map.g, map.b};
      p.normal = both - Vec3<F>{F(0.75), F(0.75), F(0.75)};
    });
    blend_from_calm(params, c, strip);
  }

  template <class Strip>
  static void dudv(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    const double move = drift(params, c);
    strip.tiled_rgb(c.wave_map, Place<F>(params, c, 1, {move, 0}), [](Pixel<F>& p, Rgb<F> map) {
      p.tilt = F(0.01) * Vec2<F>{map.r, map.g};
    });
    const Place<F> place(params, c, 1, {0, move});
    const F strength(params.strength);
    strip.tiled_rgb(
        c.wave_map, [&](const Pixel<F>& p) { return place(p) + p.tilt; },
        [&](Pixel<F>& p, Rgb<F> map) {
          const F x = F(2) * map.r - F(1), y = F(2) * map.g - F(1);
          const auto scaled = [&](F v) { return min(max(lerp(F(0), v, strength), F(-1)), F(1)); };
          p.normal = {x, y, map.b};
          p.tilt = {scaled(x), scaled(y)};
        });
    blend_from_calm(params, c, strip);
  }

  template <class Strip>
  static void sines(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    constexpr double kTurn = 2 * std::numbers::pi;
    const Vec3<F> map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y);
    strip.each([&](Pixel<F>& p) { p.normal = {F(0), F(0), F(0)}; });
    for (const SineWave& wave : params.waves.empty() ? c.waves : params.waves) {
      // Phases in turns, those below the eye reduced in double.
      const F begin(c.phase_at_eye(wave) / kTurn);
      const Vec3<F> step = F(wave.k_x / kTurn) * map_x + F(wave.k_y / kTurn) * map_y;
      const auto steepest = [&](double k) {
        return F(min(max(wave.amplitude * k, -kSteepest), kSteepest));
      };
      const F slope_x = steepest(wave.k_x), slope_y = steepest(wave.k_y);
      strip.each([&](Pixel<F>& p) {
        const F turns = begin + dot(p.surface_point, step);
        // Too far for a float to tell crest from trough: they average out.
        const auto known = abs(turns) < F(1e6);
        const F within = select(known, turns - floor(turns), F(0));
        const F rise = select(known, cos(F(kTurn) * within), F(0));
        p.normal = p.normal - Vec3<F>{rise * slope_x, rise * slope_y, F(0)};
      });
    }
    lean(params.strength, c, strip);
  }

  template <class Strip>
  static void slopes(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    drifting_four(params, c, strip, [](Pixel<F>& p, Rgb<F> map) {
      const F per_z = F(1) / max(F(2) * map.b - F(1), F(0.05));
      const Vec3<F> leans{(F(2) * map.r - F(1)) * per_z, (F(2) * map.g - F(1)) * per_z, F(0)};
      p.normal = p.normal + leans;
    });
    lean(0.25 * params.strength, c, strip);
  }

  /// The four lookups of four_maps; gather(p, color of the map) adds each to p.normal.
  template <class Strip, class Gather>
  static void drifting_four(const Params& params, const Context& c, Strip& strip, Gather&& gather) {
    using F = typename Strip::Number;
    const double move = drift(params, c);
    strip.each([&](Pixel<F>& p) { p.normal = {F(0), F(0), F(0)}; });
    constexpr Vec2<double> kDirections[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (const Vec2<double>& along : kDirections) {
      strip.tiled_rgb(c.wave_map, Place<F>(params, c, 1, move * along), gather);
    }
  }

  /// From a vector in the axes of the map to the normal: normalize(lerp(up, vector, strength)).
  template <class Strip>
  static void blend_from_calm(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    const Vec3<F> map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y), up = vec3_of<F>(c.up);
    const F strength(params.strength);
    strip.each([&](Pixel<F>& p) {
      const Vec3<F> n = p.normal.x * map_x + p.normal.y * map_y + p.normal.z * up;
      p.normal = normalize_or(up + strength * (n - up), up);
    });
  }

  /// From downhill slopes along the axes of the map to the normal.
  template <class Strip>
  static void lean(double scale, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    const Vec3<F> map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y), up = vec3_of<F>(c.up);
    const F s(scale);
    strip.each([&](Pixel<F>& p) {
      p.normal = normalize_or(up + (s * p.normal.x) * map_x + (s * p.normal.y) * map_y, up);
    });
  }

  static constexpr double kSteepest = 1e9;  ///< slope of one wave; its square is finite in float

  /// How far maps have drifted, in periods of tile_size.
  LIMPID_INLINE static double drift(const Params& params, const Context& c) {
    return params.speed * c.time / params.tile_size;
  }

  /// Where a pixel lies in the map, in periods since the world's origin; kept small in double
  /// before it becomes a float.
  template <class F>
  struct Place {
    F u0, v0;
    Vec3<F> u_step, v_step;

    Place(const Params& params, const Context& c, double tiling, Vec2<double> moved) {
      const double scale = tiling / params.tile_size;
      const auto begin = [&](const glm::dvec3& axis, double move) {
        const double at = c.eye.x * axis.x + c.eye.y * axis.y + c.eye.z * axis.z;
        const double rest = std::fmod(at * scale, 1.0) + std::fmod(move, 1.0);
        return F(rest - std::floor(rest));
      };
      u0 = begin(c.map_x, moved.x), v0 = begin(c.map_y, moved.y);
      u_step = F(scale) * vec3_of<F>(c.map_x), v_step = F(scale) * vec3_of<F>(c.map_y);
    }
    LIMPID_INLINE Vec2<F> operator()(const Pixel<F>& p) const {
      return {u0 + dot(p.surface_point, u_step), v0 + dot(p.surface_point, v_step)};
    }
  };
};

}  // namespace limpid
