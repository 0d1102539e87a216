#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "op/footprint.h"
#include "ops/fresnel_reflection_kernel.h"
#include "ops/probe_strip.h"
#include "ops/wave_normals_kernel.h"

// The effect of waves smaller than a pixel on the pixel's reflection, and what a plate's normals
// tell of these waves.

namespace limpid {
namespace {

constexpr Size kSize{32, 24};

Pass context_of() {
  static const test::Buffers buffers = test::noisy_frame(rect_of(kSize));
  return Pass(test::simple_scene(kSize), buffers.frame, 1.333, kWholeState);
}

/// A pixel seen at this angle in degrees over the water, along Pass::map_y; its slopes have this
/// deviation along the view, and none across the view.
Pixel<double> pixel_at(const Pass& c, double degrees, double deviation) {
  const double rise = degrees * std::numbers::pi / 180;
  const Vec3<double> up = vec3_of<double>(c.up), away = vec3_of<double>(c.map_y);
  Pixel<double> p{};
  p.to_viewer = std::sin(rise) * up + -std::cos(rise) * away;
  p.normal = up;
  p.side = 1;
  p.slope_variance = {0, 0, deviation * deviation};
  p.transmitted = {1, 1, 1};
  p.in_scatter = {0.5, 0.5, 0.5};
  return p;
}

Pixel<double> mirrored(Pixel<double> p, const Pass& c,
                       FresnelReflection::Facets facets = FresnelReflection::Facets::kSpread) {
  FresnelReflection::Params params;
  params.source = FresnelReflection::Source::kConstant;
  params.color = {2, 3, 4};
  params.facets = facets;
  test::ProbeStrip strip;
  strip.pixels.push_back(p);
  Kernel<FresnelReflection>::apply(params, c, strip);
  return strip.pixels[0];
}
Pixel<double> mirrored(Pixel<double> p, FresnelReflection::Facets facets) {
  return mirrored(p, context_of(), facets);
}

/// Reflectance of a facet that leans by a slope towards the viewer.
double reflectance(double degrees, double slope) {
  return fresnel_exact(std::sin(degrees * std::numbers::pi / 180 + std::atan(slope)), 1.333);
}

TEST(Facets, AreAveragedAtTheNodesOfGaussAndHermite) {
  const Pass c = context_of();
  const double lean = std::sqrt(3.0) * 0.05;
  const Pixel<double> p = mirrored(pixel_at(c, 20, 0.05), FresnelReflection::Facets::kSpread);
  const double mean =
      2.0 / 3 * reflectance(20, 0) + (reflectance(20, lean) + reflectance(20, -lean)) / 6;
  EXPECT_NEAR(p.fresnel, mean, 1e-12);
  EXPECT_NEAR(p.reflected.g, 3 * mean, 1e-12);
  EXPECT_NEAR(p.transmitted.r, 1 - mean, 1e-12);
  EXPECT_NEAR(p.in_scatter.b, 0.5 * (1 - mean), 1e-12);
  EXPECT_GT(std::abs(mean - reflectance(20, 0)), 1e-3);
}

TEST(Facets, OfResolvedWavesAreOne) {
  const Pass c = context_of();
  for (const double deviation : {0.0, 0.009}) {
    const Pixel<double> p = pixel_at(c, 20, deviation);
    const Pixel<double> spread = mirrored(p, FresnelReflection::Facets::kSpread);
    EXPECT_EQ(spread.fresnel, mirrored(p, FresnelReflection::Facets::kMean).fresnel);
    EXPECT_EQ(spread.fresnel, reflectance(20, 0));
  }
  const Pixel<double> rough = pixel_at(c, 20, 0.011);
  EXPECT_NE(mirrored(rough, FresnelReflection::Facets::kSpread).fresnel, reflectance(20, 0));
  const Pixel<double> across = [&] {
    Pixel<double> p = pixel_at(c, 20, 0);
    p.slope_variance.xx = 1;
    return p;
  }();
  EXPECT_EQ(mirrored(across, FresnelReflection::Facets::kSpread).fresnel, reflectance(20, 0));
}

// At 2 degrees a facet that leans away by 5 shows its back: the ray is laid flat, half way.
TEST(Facets, ThatWouldMirrorTheWaterAreLeaned) {
  const Pass c = context_of();
  Pixel<double> p = pixel_at(c, 2, 0);
  const double lean = -5 * std::numbers::pi / 180;
  p.normal = std::cos(lean) * vec3_of<double>(c.up) + -std::sin(lean) * vec3_of<double>(c.map_y);
  const double spread = mirrored(p, FresnelReflection::Facets::kSpread).fresnel;
  EXPECT_NEAR(spread, fresnel_exact(std::sin(1 * std::numbers::pi / 180), 1.333), 1e-9);
  EXPECT_EQ(mirrored(p, FresnelReflection::Facets::kMean).fresnel, 1);
}

TEST(Facets, NothingBreaksAtTheEdges) {
  const Pass c = context_of();
  for (const double degrees : {-30.0, 0.0, 1e-6, 0.01, 89.99, 90.0}) {
    for (const double deviation : {0.0, 1e-8, 0.3, 1e3}) {
      const Pixel<double> p =
          mirrored(pixel_at(c, degrees, deviation), FresnelReflection::Facets::kSpread);
      EXPECT_TRUE(p.fresnel >= 0 && p.fresnel <= 1) << degrees << " " << deviation;
      EXPECT_TRUE(p.reflected.r >= 0 && p.reflected.r <= 2) << degrees << " " << deviation;
    }
  }
}

// The visible part of moving water at a flat angle leans towards the view: the mean over many
// facets, each weighted by its visible area.
TEST(Facets, OfMovedWaterCountByTheirAreaThatIsSeen) {
  for (const double degrees : {0.5, 2.0, 5.0, 20.0, 80.0}) {
    const double deviation = 0.05, rise = std::tan(degrees * std::numbers::pi / 180);
    double area = 0, light = 0;
    for (double slope = -0.4; slope < 0.4; slope += 1e-4) {
      const double seen =
          std::max(rise + slope, 0.0) * std::exp(-0.5 * slope * slope / (deviation * deviation));
      // Rays that would go into the water go along it.
      const double lean = std::max(slope, std::tan(-0.5 * degrees * std::numbers::pi / 180));
      area += seen, light += seen * reflectance(degrees, lean);
    }
    Pass c = context_of();
    c.plate_waves.raised = 1;
    const Pixel<double> p = mirrored(pixel_at(c, degrees, deviation), c);
    EXPECT_NEAR(p.fresnel, light / area, 0.003) << degrees;
    EXPECT_NEAR(p.reflected.r, 2 * p.fresnel, 1e-12) << degrees;
    if (degrees > 10) continue;
    const Pixel<double> flat = mirrored(pixel_at(c, degrees, deviation), context_of());
    EXPECT_GT(flat.fresnel, p.fresnel + 0.04) << degrees;
  }
}

/// Nine normals around a pixel.
struct Nine {
  using Number = double;
  Pixel<double> pixel;
  Around<double> normals;

  /// The middle normal, and eight others that lean as far to other sides, or to the same side.
  Nine(Pixel<double> p, bool alike) : pixel(p) {
    constexpr double kTo[9] = {0, 1, 2, 3, 4.5, 5, 6, 0.5, 1.5};
    for (int k = 0; k < 9; ++k) {
      const double to = kTo[alike ? 4 : k];
      normals.at[k] = {0.6 * std::cos(to), 0.8, 0.6 * std::sin(to)};
    }
  }
  Vec3<double> own() const { return normals[4]; }

  template <class Fn>
  void each(Fn&& fn) {
    fn(pixel);
  }
  template <class Into>
  void own3(PlaneId, Into&& into) {
    into(pixel, own());
  }
  template <class Into>
  void around3(PlaneId, Into&& into) {
    into(pixel, normals);
  }
  template <class... Any>
  void tiled_rgb(Any&&...) {}
  template <class... Any>
  void tiled_rgb_if(Any&&...) {}
  template <class... Any>
  void tiled_slopes_if(Any&&...) {}
};

Pass wavy_plate() {
  Pass c = context_of();
  c.plate_waves.variance = {0.02, 0.004, 0.01};
  c.plate_waves.turn = {9, 2, 4};
  return c;
}

WaveNormals::Params filtered_plate() {
  WaveNormals::Params params;
  params.model = WaveNormals::Model::kPlate;
  params.filter = WaveNormals::Filter::kVariance;
  return params;
}

// A normal of a plate is a sample of the waves in the pixel. For sines with random wave vectors of
// covariance `turn`, the mean over a footprint S is exp(-k' S k / 2) times the value at the middle,
// averaged over the vectors k.
TEST(PlateNormals, TellOfAPixelWhatItsWavesKeepOfThem) {
  const Pass c = wavy_plate();
  const WaveNormals::Params params = filtered_plate();
  for (const double depth : {0.5, 5.0, 50.0}) {
    Pixel<double> p = pixel_at(c, 30, 0);
    p.surface_depth = depth;
    Nine strip(p, false);
    Kernel<WaveNormals>::apply(params, c, strip);
    const Pixel<double>& filtered = strip.pixel;
    const Sym2<double> s = footprint(c, p);
    const Sym2<double>& turn = c.plate_waves.turn;
    const double first = std::sqrt(turn.xx), mixed = turn.xy / first;
    const double second = std::sqrt(turn.yy - mixed * mixed);
    double kept = 0, all = 0;
    for (double u = -6; u <= 6; u += 0.02) {
      for (double v = -6; v <= 6; v += 0.02) {
        const double weight = std::exp(-0.5 * (u * u + v * v));
        kept += weight * std::exp(-0.5 * along(s, {first * u, mixed * u + second * v}));
        all += weight;
      }
    }
    kept /= all;
    const Vec3<double> own = strip.own();
    const auto slope = [&](Vec3<double> n) {
      return dot(n, vec3_of<double>(c.map_x)) / dot(n, vec3_of<double>(c.up));
    };
    EXPECT_NEAR(slope(filtered.normal), kept * slope(own), 1e-3 * std::abs(slope(own))) << depth;
    EXPECT_NEAR(filtered.slope_variance.xx, (1 - kept * kept) * 0.02, 4e-5) << depth;
    EXPECT_NEAR(filtered.slope_variance.xy, (1 - kept * kept) * 0.004, 1e-5) << depth;
    EXPECT_NEAR(filtered.slope_variance.yy, (1 - kept * kept) * 0.01, 2e-5) << depth;
  }
}

// The footprint reaches over less of their turn: over turn / (1 + smooth turn).
TEST(PlateNormals, OfFarWavesThatAreSmoothStay) {
  Pass c = wavy_plate();
  c.plate_waves.turn = {9, 0, 0};
  const WaveNormals::Params params = filtered_plate();
  for (const double smooth : {0.0, 0.25, 1.0}) {
    c.plate_waves.smooth = smooth;
    Nine strip(pixel_at(c, 30, 0), false);
    strip.pixel.surface_depth = 50;
    Kernel<WaveNormals>::apply(params, c, strip);
    const double turn = 12 * 9 * footprint(c, strip.pixel).xx;
    const double lost = 1 - 1 / (1 + turn / (1 + smooth * turn) / 12);
    EXPECT_NEAR(strip.pixel.slope_variance.xx, lost * 0.02, 1e-9) << smooth;
  }
}

// Waves that end, or a plate of which a part is calm.
TEST(PlateNormals, ThatLeanAsTheirNeighboursDoHaveNoWavesToLose) {
  const Pass c = wavy_plate();
  const WaveNormals::Params params = filtered_plate();
  Nine strip(pixel_at(c, 30, 0.1), true);
  strip.pixel.surface_depth = 50;
  Kernel<WaveNormals>::apply(params, c, strip);
  EXPECT_NEAR(dot(strip.pixel.normal, strip.own()), 1, 1e-12);
  EXPECT_NEAR(strip.pixel.slope_variance.xx, 0, 1e-12);
  EXPECT_NEAR(strip.pixel.slope_variance.yy, 0, 1e-12);
}

TEST(PlateNormals, OfWhichNothingIsKnownStayAsTheyAre) {
  const Pass c = context_of();
  WaveNormals::Params params;
  params.model = WaveNormals::Model::kPlate;
  for (const auto filter :
       {WaveNormals::Filter::kNone, WaveNormals::Filter::kMip, WaveNormals::Filter::kVariance}) {
    params.filter = filter;
    Nine strip(pixel_at(c, 30, 0.1), false);
    strip.pixel.surface_depth = 5;
    Kernel<WaveNormals>::apply(params, c, strip);
    EXPECT_EQ(strip.pixel.slope_variance.yy, 0);
    EXPECT_EQ(strip.pixel.normal.x, strip.own().x);
    EXPECT_EQ(strip.pixel.normal.z, strip.own().z);
  }
}

}  // namespace
}  // namespace limpid
