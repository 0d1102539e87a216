#pragma once
#include <array>
#include <cmath>

#include "op/pass.h"

/// @file
/// Sunlight on the bottom, focused by waves.

namespace limpid {

/// Sunlight on the bottom over sunlight under calm water, by the entry point under calm water: P -
/// D t for a point P of the bottom at depth D below the calm surface, where light travels t
/// sideways per unit of depth. In these coordinates calm light is 1 everywhere, for any slope of
/// the bottom. Made by complete/. A frame has several levels of this table, each with texels twice
/// as wide as those of the level before, over the area that the picture sees at that size.
struct CausticsTable {
  static constexpr int kMaxLevels = 8;
  struct Level {
    View<const float> light;
    /// The centre of the first texel, along map_x and map_y from the point of the calm surface
    /// below the eye, in scene units.
    glm::dvec2 corner{0, 0};
    double texel = 1;  ///< in scene units
  };
  int count = 0;  ///< 0: the light is 1 everywhere
  int first = 0;  ///< index of the first level among the levels of all tables of the frame
  std::array<Level, kMaxLevels> levels;
  double scale = 1;  ///< width of a texel over caustics_texel()
  /// On sunlit bottoms: the sun's light over all other light, for frames with shadow; else 0.
  std::array<double, 3> sun_over_rest{};
  double slopes = 0;      ///< 1 if the depth is fine enough to tell the slope of the bottom
  double under_land = 0;  ///< 1 if the surface goes on under land, as calm and completed ones do
  /// Share of the focused light that the water scatters, and so spreads, per unit of depth, of red,
  /// green, blue.
  std::array<double, 3> scattered{};
  double least = 1, most = 1;  ///< bounds on all values
  /// The same light above `depth`, for light shafts in the water; null if no operator needs it.
  const CausticsTable* in_water = nullptr;
  double depth = HUGE_VAL;
};

/// Width of texels, in scene units, for a bottom seen at eye depth `depth` by a view at this cosine
/// from the vertical above the water: the size of the pixel, which is longer than wide there.
template <class F>
LIMPID_INLINE F caustics_texel(const WaterView& c, F depth, F cosine) {
  const auto length = [](const glm::dvec3& v, const char* name) {
    return given<F>(std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z), name);
  };
  const F wide = length(c.rays.origin_dx, "camera.origin_width") +
                 depth * length(c.rays.ray_dx, "camera.ray_width");
  return wide / sqrt(max(cosine, F(0.05)));
}

/// Calls look(level, at, share, per_texel) for each level that a pixel with texels of the width
/// `texel` takes a share of its light from, with the place `entry` in texels, of which `per_texel`
/// make a scene unit. It may be called for lanes whose share is 0. The finest level first; the next
/// level where a pixel is wider than a texel, or the level ends. Returns the share beyond the last
/// level, where the light is 1.
template <class F, class Look>
LIMPID_INLINE F each_level(const CausticsTable& table, Vec2<F> entry, F texel, Look&& look) {
  F rest(1);
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
    if_any(share > F(0), [&] { look(level, at, share, per_texel); });
    rest = rest - share;
  }
  return rest;
}

/// The table's value at a place, for pixels that want texels of this width. Never below 0.
template <class F, class Tap>
F caustics_at(const CausticsTable& table, const Tap& tap, Vec2<F> entry, F texel) {
  F light(0);
  const F rest = each_level(table, entry, texel, [&](const auto& level, Vec2<F> at, F share, F) {
    light = light + select(share > F(0), share * tap.grid(level.light, at), F(0));
  });
  return max(light + rest, F(0));
}

/// The same for the places of red, green and blue. The place of green decides which levels count.
template <class F, class Tap>
Rgb<F> caustics_of_colors(const CausticsTable& table, const Tap& tap,
                          const std::array<Vec2<F>, 3>& entries, F texel) {
  const Vec2<F>&red = entries[0], &green = entries[1], &blue = entries[2];
  Rgb<F> light{F(0), F(0), F(0)};
  const auto look = [&](const auto& level, Vec2<F> at, F share, F per_texel) {
    each<F>(3, [&](auto i) {
      const Vec2<F> place{at.x + per_texel * (pick<F>(i, red.x, green.x, blue.x) - green.x),
                          at.y + per_texel * (pick<F>(i, red.y, green.y, blue.y) - green.y)};
      const F more = select(share > F(0), share * tap.grid(level.light, place), F(0));
      only<F>(i, 0, [&] { light.r = light.r + more; });
      only<F>(i, 1, [&] { light.g = light.g + more; });
      only<F>(i, 2, [&] { light.b = light.b + more; });
    });
  };
  const F rest = each_level(table, green, texel, look);
  return {max(light.r + rest, F(0)), max(light.g + rest, F(0)), max(light.b + rest, F(0))};
}

}  // namespace limpid
