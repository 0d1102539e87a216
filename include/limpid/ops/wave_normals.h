#pragma once
#include <cmath>
#include <string>

#include "limpid/op/operator.h"

namespace limpid {

/// The normal of the wavy surface, and its tilt m = (n.t, -n.b) as the camera sees it.
///
/// `plate`: the frame's own surface normals. The planner takes this model whenever there are any.
/// `four_maps` ("Realistic Water"): a tiling normal map looked up four times, drifting along +x,
/// -x, +y and -y of the water plane; n = normalize(mean of lerp(up, n_i, strength)). The map is
/// tied to the world, one period every tile_size units; its red, green, blue are (2 c - 1) along
/// map x, map y and up. Blending vectors instead of slopes flattens steep waves; kept as the
/// article has it.
struct WaveNormals {
  enum class Model { kFourMaps, kPlate };
  struct Params {
    Model model = Model::kFourMaps;
    double strength = 0.5;
    double tile_size = 4;
    double speed = 0.3;
    std::string map;
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
    return {.planes = reads(p), .wave_map = p.model == Model::kFourMaps};
  }
  static double reach(const Params&) { return 0; }
  static bool neutral(const Params& p, StateSet) {
    return p.model == Model::kFourMaps && p.strength == 0;
  }

  template <class Strip>
  static void apply(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    if (params.model == Model::kPlate) {
      strip.own3(PlaneId::kSurfaceNormalX, [](Pixel<F>& p, Vec3<F> n) { p.normal = n; });
    } else {
      four_maps(params, c, strip);
    }
    const Vec3<F> t = vec3_of<F>(c.t), b = vec3_of<F>(c.b);
    strip.each([&](Pixel<F>& p) { p.tilt = {dot(p.normal, t), F(0) - dot(p.normal, b)}; });
  }

 private:
  template <class Strip>
  static void four_maps(const Params& params, const Context& c, Strip& strip) {
    using F = typename Strip::Number;
    // Periods of the map since the world's origin, kept small in double before they become floats.
    const auto wrapped = [](double periods) { return periods - std::floor(periods); };
    const double scale = 1 / params.tile_size;
    const double eye_u = wrapped(along(c.eye, c.map_x) * scale);
    const double eye_v = wrapped(along(c.eye, c.map_y) * scale);
    const double drift = wrapped(std::fmod(params.speed * c.time * scale, 1.0));
    const Vec3<F> map_x = vec3_of<F>(c.map_x), map_y = vec3_of<F>(c.map_y), up = vec3_of<F>(c.up);
    const F per_unit(scale);
    strip.each([&](Pixel<F>& p) { p.normal = {F(0), F(0), F(0)}; });
    constexpr int kDirections[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (const auto& [along_u, along_v] : kDirections) {
      const F u0(eye_u + along_u * drift), v0(eye_v + along_v * drift);
      strip.tiled_rgb(
          c.wave_map,
          [&](const Pixel<F>& p) -> Vec2<F> {
            return {u0 + per_unit * dot(p.surface_point, map_x),
                    v0 + per_unit * dot(p.surface_point, map_y)};
          },
          [](Pixel<F>& p, Rgb<F> map) {
            p.normal = p.normal + Vec3<F>{map.r, map.g, map.b};
          });
    }
    const F strength(params.strength);
    strip.each([&](Pixel<F>& p) {
      const Vec3<F> sum =
          p.normal;  // of four lookups in 0 ... 1; their mean decodes as sum / 2 - 1
      const Vec3<F> mean = (F(0.5) * sum.x - F(1)) * map_x + (F(0.5) * sum.y - F(1)) * map_y +
                           (F(0.5) * sum.z - F(1)) * up;
      p.normal = normalize_or(up + strength * (mean - up), up);
    });
  }

  static double along(const glm::dvec3& a, const glm::dvec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
};

}  // namespace limpid
