#pragma once
#include <algorithm>

#include "plan/surveyed.h"

/// Frames as the planner meets them: patches of shore, of deep and of shallow water, of objects
/// before the water, in shadow and in the sun, each large enough to fill cells.

namespace limpid::test {

/// A number in 0 ... 1 that is constant over patches of about 90 x 23 pixels.
inline float patch(int x, int y, int seed) {
  return noise((x + 1000) / 90 + 17 * seed, (y + 1000) / 23, seed);
}

/// Frames one to several cells wide and high, awkward sizes first; now and then with a larger data
/// window (overscan).
inline Rect patchy_display(int seed) {
  constexpr Size kSizes[] = {{1, 1}, {1, 37}, {127, 16}, {128, 17}, {129, 33}, {300, 70}};
  return rect_of(kSizes[static_cast<std::size_t>(seed) % std::size(kSizes)]);
}

inline Buffers patchy_frame(Rect display, int seed) {
  Buffers b(display);
  const int more = seed % 3 == 0 ? 40 : 0;
  const Rect data{display.x0 - more, display.y0 - more / 2, display.x1 + more,
                  display.y1 + more / 2};
  const auto any = [seed](int x, int y, int channel) { return noise(x, y, 100 * seed + channel); };
  const bool calm = any(0, 0, 1) < 0.3f, foreground = any(0, 0, 2) < 0.7f;
  const float bright = any(0, 0, 3) < 0.3f ? 0.05f : any(0, 0, 4) < 0.5f ? 1.0f : 4.0f;
  const float rough = any(0, 0, 5) < 0.5f ? 0.0f : 0.4f;
  for (int c = 0; c < 3; ++c) {
    b.set(
        plane_after(PlaneId::kColorR, c),
        [&](int x, int y) {
          const float own = rough * any(x, y, 10 + c) + (1 - rough) * patch(x, y, seed + c);
          return bright * own;
        },
        data);
    b.set(
        plane_after(PlaneId::kReflectionR, c), [&](int x, int y) { return any(x, y, 20 + c); },
        data);
  }
  // The calm water of simple_scene() is some 2 to 14 units away.
  if (!calm) {
    b.set(
        PlaneId::kSurfaceDepth,
        [&](int x, int y) {
          return patch(x, y, seed + 7) < 0.15f ? kInf : 3 + 0.2f * any(x, y, 6);
        },
        data);
  }
  b.set(
      PlaneId::kDepth,
      [&](int x, int y) {
        const float kind = patch(x, y, seed + 8);
        if (foreground && kind < 0.2f) return 1.5f;
        if (kind < 0.4f) return kInf;
        return (kind < 0.6f ? 60.0f : kind < 0.8f ? 16.0f : 3.4f) + any(x, y, 7);
      },
      data);
  if (any(0, 0, 8) < 0.8f) {
    b.set(PlaneId::kShadow, [&](int x, int y) {
      const float kind = patch(x, y, seed + 9);
      return kind < 0.5f ? 1.0f : kind < 0.7f ? 0.0f : any(x, y, 9);
    });
  }
  if (any(0, 0, 9) < 0.3f) {
    b.set(PlaneId::kSurfaceShadow,
          [&](int x, int y) { return patch(x, y, seed) < 0.5f ? 1.0f : 0.0f; });
  }
  const double lean = any(0, 0, 38) < 0.2f ? 0.02 : 0.6;
  for (int c = 0; c < 3; ++c) {
    b.set(plane_after(PlaneId::kSurfaceNormalX, c), [&](int x, int y) {
      const double sx = lean * (any(x, y, 30) - 0.5), sz = lean * (any(x, y, 31) - 0.5);
      const double n[] = {sx, 1, sz}, length = std::sqrt(sx * sx + 1 + sz * sz);
      return static_cast<float>(n[c] / length);
    });
  }
  if (any(0, 0, 37) < 0.3f) {
    for (int c = 0; c < 3; ++c) {
      b.set(plane_after(PlaneId::kSunColorR, c), [&](int x, int y) {
        return 0.8f * b.frame.plane(plane_after(PlaneId::kColorR, c)).at(x, y);
      });
    }
  }
  if (any(0, 0, 32) < 0.25f) {
    for (int c = 0; c < 3; ++c) {
      b.set(
          plane_after(PlaneId::kBelowR, c),
          [&](int x, int y) { return bright * any(x, y, 33 + c); }, data);
    }
    const bool holes = any(0, 0, 36) < 0.5f;
    b.set(
        PlaneId::kBelowDepth,
        [&](int x, int y) {
          return holes && patch(x, y, seed + 11) < 0.3f ? kInf : 12 + 30 * patch(x, y, seed + 12);
        },
        data);
  }
  return b;
}

inline Scene patchy_scene(Rect display) { return simple_scene(display.size()); }

/// A look in which the planner can skip operators: any models, murky water, short and long reaches.
inline Look patchy_look(int seed) {
  int next = 0;
  const auto any = [&] { return static_cast<double>(noise(seed, next++, 77)); };
  const auto one_of = [&](int count) {
    return std::min(static_cast<int>(any() * count), count - 1);
  };
  Look look;
  look.of<PrismSplit>() = {static_cast<PrismSplit::Model>(one_of(2)), 0.02 * any(),
                           any() < 0.3 ? 0 : 20 * any()};
  Refraction::Params& refraction = look.of<Refraction>();
  refraction.model = static_cast<Refraction::Model>(one_of(3));
  refraction.rejection = static_cast<Refraction::Rejection>(one_of(3));
  refraction.off_frame = static_cast<Refraction::OffFrame>(one_of(4));
  refraction.strength = any() < 0.2 ? 0 : 0.15 * any();
  refraction.steps = one_of(4) - 1;
  DepthFog::Params& fog = look.of<DepthFog>();
  fog.model = static_cast<DepthFog::Model>(one_of(3));
  fog.distance = static_cast<DepthFog::Distance>(one_of(3));
  fog.density = any() < 0.5 ? 0.3 * any() : 0.003 * any();
  fog.offset = any() < 0.5 ? 0 : any() - 0.5;
  fog.alpha = any() < 0.5 ? 1 : any() < 0.5 ? 0 : any();
  fog.color = {0.5 * any(), 0.5 * any(), 0.5 * any()};
  fog.water_type = WaterType::kCustom;
  const double murk = any() < 0.3 ? 10 : any() < 0.5 ? 1 : 0.001;
  fog.absorption = {murk * any(), murk * any(), murk * any()};
  fog.scattering = {0.2 * murk * any(), 0.2 * murk * any(), 0.2 * murk * any()};
  fog.anisotropy = 1.8 * any() - 0.9;
  fog.sunlight = static_cast<DepthFog::Sunlight>(one_of(3));
  fog.crossing = static_cast<DepthFog::Crossing>(one_of(2));
  look.of<WaterShadow>() = {static_cast<WaterShadow::Model>(one_of(2)), any()};
  FresnelReflection::Params& mirror = look.of<FresnelReflection>();
  mirror.reflectance = static_cast<FresnelReflection::Reflectance>(one_of(5));
  mirror.lookup = static_cast<FresnelReflection::Lookup>(one_of(2));
  if (any() < 0.2) mirror.source = FresnelReflection::Source::kConstant;
  mirror.color = {0.01 * any(), 0.01 * any(), 0.01 * any()};
  SunHighlight::Params& sun = look.of<SunHighlight>();
  sun.model = static_cast<SunHighlight::Model>(one_of(3));
  sun.strength = any() < 0.3 ? 0 : any() < 0.3 ? 1e-4 : 1;
  Penetration::Params& through = look.of<Penetration>();
  through.model = static_cast<Penetration::Model>(one_of(2));
  through.amount = any() < 0.5 ? 0.01 * any() : any();
  look.of<Caustics>() = {any() < 0.5 ? 0 : any(), any(),
                         static_cast<Caustics::Sunlight>(one_of(2))};
  look.of<WaterShadow>().shafts = any() < 0.5 ? 0 : any();
  return look;
}

}  // namespace limpid::test
