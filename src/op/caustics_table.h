#pragma once
#include <array>
#include <cmath>

#include "op/pass.h"

/// @file
/// Sunlight that waves focus on the bottom.

namespace limpid {

/// The sun's light on the bottom over what it would be under calm water, by the place where calm
/// water would let it in: P - D t for a point P of the bottom, D below the calm surface, and light
/// that goes t aside for each unit that it sinks. In these coordinates calm light is 1 everywhere,
/// whatever the slope of the bottom. Made by complete/. Levels of the same table, each with texels
/// twice as wide as the one before, of what of it the picture sees.
struct CausticsTable {
  static constexpr int kMaxLevels = 8;
  struct Level {
    View<const float> light;
    /// Of the centre of the first texel: along map_x and map_y from the point of the calm surface
    /// below the eye, in scene units.
    glm::dvec2 corner{0, 0};
    double texel = 1;  ///< in scene units
  };
  int count = 0;  ///< 0: the light is 1 everywhere
  int first = 0;  ///< place of the first level among those of all tables of a frame
  std::array<Level, kMaxLevels> levels;
  double scale = 1;  ///< times that of caustics_texel() is what texels are wide
  /// Of sunlit bottoms: the sun's light over the rest, of frames with sun_color; else 0.
  std::array<double, 3> sun_over_rest{};
  /// Share of the focused light that the water scatters, and so spreads, for each unit that it
  /// sinks, of red, green, blue.
  std::array<double, 3> scattered{};
  double least = 1, most = 1;  ///< no value is smaller or larger
  /// The same light where nothing is deeper than `depth`, for what it lights on its way; null where
  /// nobody asks for it.
  const CausticsTable* in_water = nullptr;
  double depth = HUGE_VAL;
};

/// How wide, in scene units, texels shall be where the bottom is seen at eye depth `depth`, by a
/// view whose angle with the vertical has this cosine above the water: as the pixel, which is
/// longer than wide there.
template <class F>
LIMPID_INLINE F caustics_texel(const WaterView& c, F depth, F cosine) {
  const auto length = [](const glm::dvec3& v, const char* name) {
    return given<F>(std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z), name);
  };
  const F wide = length(c.rays.origin_dx, "camera.origin_width") +
                 depth * length(c.rays.ray_dx, "camera.ray_width");
  return wide / sqrt(max(cosine, F(0.05)));
}

/// What the table has at a place, for pixels that ask for texels so wide. Finest level first; the
/// next one where a pixel is wider than a texel, or the level ends; 1 beyond the last. Never below
/// 0.
template <class F, class Tap>
F caustics_at(const CausticsTable& table, const Tap& tap, Vec2<F> entry, F texel) {
  F light(0), rest(1);
  for (int k = 0; k < table.count; ++k) {
    const CausticsTable::Level& level = table.levels[static_cast<std::size_t>(k)];
    const int nth = table.first + k;
    const F per_texel = given<F>(1 / level.texel, "caustics.per_texel", nth);
    const F wider = given<F>(table.scale / level.texel, "caustics.wider", nth);
    const Vec2<F> at{(entry.x - given<F>(level.corner.x)) * per_texel,
                     (entry.y - given<F>(level.corner.y)) * per_texel};
    const auto inside = [](F place, F last) {
      return saturate(F(0.25) * min(place, last - place));
    };
    const auto& window = level.light.window;
    const F within = inside(at.x, given<F>(window.width() - 1, "caustics.last_x", nth)) *
                     inside(at.y, given<F>(window.height() - 1, "caustics.last_y", nth));
    const F share = rest * within * saturate(F(2) - texel * wider);
    if_any(share > F(0),
           [&] { light = light + select(share > F(0), share * tap.grid(level.light, at), F(0)); });
    rest = rest - share;
  }
  return max(light + rest, F(0));
}

}  // namespace limpid
