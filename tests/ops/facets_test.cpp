#include <cmath>

#include <gtest/gtest.h>

#include "ops/fresnel_reflection_kernel.h"
#include "ops/probe_strip.h"
#include "ops/wave_normals_kernel.h"

// What waves too small for a pixel do to what it mirrors, and what a plate's normals tell of them.

namespace limpid {
namespace {

constexpr Size kSize{32, 24};

Pass context_of() {
  static const test::Buffers buffers = test::noisy_frame(rect_of(kSize));
  return Pass(test::simple_scene(kSize), buffers.frame, 1.333, kWholeState);
}

/// A pixel seen at so many degrees over the water, along Pass::map_y, with slopes that vary by
/// so much along the view and not across it.
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

Pixel<double> mirrored(Pixel<double> p, FresnelReflection::Facets facets) {
  FresnelReflection::Params params;
  params.source = FresnelReflection::Source::kConstant;
  params.color = {2, 3, 4};
  params.facets = facets;
  test::ProbeStrip strip;
  strip.pixels.push_back(p);
  Kernel<FresnelReflection>::apply(params, context_of(), strip);
  return strip.pixels[0];
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

/// Nine normals around a pixel, and what the model plate makes of them.
struct Neighbours {
  using Number = double;
  Around<double> normals;
  Pixel<double> pixel{};

  template <class Fn>
  void each(Fn&& fn) {
    fn(pixel);
  }
  template <class Into>
  void own3(PlaneId, Into&& into) {
    into(pixel, normals[4]);
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

TEST(PlateNormals, TellWhatAPixelCannotResolveByTheirNeighbours) {
  const Pass c = context_of();
  WaveNormals::Params params;
  params.model = WaveNormals::Model::kPlate;
  params.filter = WaveNormals::Filter::kVariance;
  // Rows that lean to and fro by a slope of 0.2 along map_y.
  Neighbours strip;
  for (int k = 0; k < 9; ++k) {
    const double slope = k / 3 == 1 ? 0.2 : -0.2;
    strip.normals.at[k] = normalize_or<double>(
        vec3_of<double>(c.up) + -slope * vec3_of<double>(c.map_y), vec3_of<double>(c.up));
  }
  Kernel<WaveNormals>::apply(params, c, strip);
  EXPECT_EQ(strip.pixel.normal.x, strip.normals[4].x);
  EXPECT_EQ(strip.pixel.normal.z, strip.normals[4].z);
  EXPECT_NEAR(strip.pixel.slope_variance.yy, 0.5 * 0.04, 1e-12);
  EXPECT_NEAR(strip.pixel.slope_variance.xx, 0, 1e-12);
  EXPECT_NEAR(strip.pixel.slope_variance.xy, 0, 1e-12);
  for (const auto filter : {WaveNormals::Filter::kNone, WaveNormals::Filter::kMip}) {
    params.filter = filter;
    Kernel<WaveNormals>::apply(params, c, strip);
    EXPECT_EQ(strip.pixel.slope_variance.yy, 0);
    EXPECT_EQ(strip.pixel.normal.z, strip.normals[4].z);
  }
}

// One of nine leans, so steeply that its slope counts as the bound of 20, along both axes: with the
// weight of 1/4 half the variance is (1/4 - 1/16) 20^2 / 2 of each.
TEST(PlateNormals, NoSlopePassesTwenty) {
  const Pass c = context_of();
  WaveNormals::Params params;
  params.model = WaveNormals::Model::kPlate;
  params.filter = WaveNormals::Filter::kVariance;
  const Vec3<double> up = vec3_of<double>(c.up);
  Neighbours strip;
  for (int k = 0; k < 9; ++k) strip.normals.at[k] = up;
  strip.normals.at[4] = 0.05 * up + -1.0 * vec3_of<double>(c.map_x) - vec3_of<double>(c.map_y);
  Kernel<WaveNormals>::apply(params, c, strip);
  EXPECT_NEAR(strip.pixel.slope_variance.xx, 37.5, 1e-9);
  EXPECT_NEAR(strip.pixel.slope_variance.xy, 37.5, 1e-9);
  EXPECT_NEAR(strip.pixel.slope_variance.yy, 37.5, 1e-9);
  strip.normals.at[4] = 0.01 * up - vec3_of<double>(c.map_x);
  Kernel<WaveNormals>::apply(params, c, strip);
  EXPECT_NEAR(strip.pixel.slope_variance.xx, 37.5, 1e-9);
  EXPECT_NEAR(strip.pixel.slope_variance.xy, 0, 1e-9);
}

}  // namespace
}  // namespace limpid
