#include <gtest/gtest.h>

#include "complete/shore.h"

// The AOVs of a reflection: its planes, and the sources of its light.

namespace limpid {
namespace {

using test::Picture;
using test::Shore;
using Source = FresnelReflection::Source;

constexpr Size kSize = Shore::kSize;

Look look_of(Source source) {
  Look look = test::still_look();
  look.of<FresnelReflection>().source = source;
  look.of<FresnelReflection>().lookup = FresnelReflection::Lookup::kRay;
  return look;
}

/// A shore without a reflection, whose own picture is mirrored.
test::Buffers without_reflection(const Shore& shore) {
  test::Buffers buffers(rect_of(kSize));
  for (int c = 0; c < 3; ++c) buffers.fill(plane_after(PlaneId::kColorR, c), 0.5f);
  buffers.set(PlaneId::kDepth, [&](int x, int y) { return shore.dry_depth(x, y); });
  return buffers;
}

template <class Check>
void each_wet(const Picture& picture, Check&& check) {
  int wet = 0;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      if (std::isinf(picture.aov(Aov::kSurfaceDepth, x, y))) continue;
      check(x, y);
      ++wet;
    }
  }
  EXPECT_GT(wet, 500);
}

TEST(MirrorAovs, SourcesSumToOne) {
  Shore shore;
  const test::Buffers bare = without_reflection(shore);
  const Frame* const frames[] = {&shore.buffers.frame, &bare.frame};
  for (const Frame* frame : frames) {
    for (const Source source : {Source::kConstant, Source::kAuto}) {
      const Picture judge = test::reference(look_of(source), *frame, shore.scene);
      const Picture got = test::fused(look_of(source), *frame, shore.scene);
      std::array<double, 3> shares{};
      each_wet(judge, [&](int x, int y) {
        double sum = 0;
        for (int c = 0; c < 3; ++c) {
          const double share = judge.aov(Aov::kMirrorSources, x, y, c);
          EXPECT_GE(share, 0);
          sum += share;
          shares[static_cast<std::size_t>(c)] += share;
        }
        EXPECT_NEAR(sum, 1, 1e-6);
      });
      const bool reflects = source == Source::kAuto && frame == &shore.buffers.frame;
      const bool marches = source == Source::kAuto && !reflects;
      EXPECT_EQ(shares[0] > 0, reflects);
      EXPECT_EQ(shares[1] > 100, marches) << "the wall is mirrored";
      EXPECT_EQ(shares[2] > 0, !reflects);
      int apart = 0;
      each_wet(got, [&](int x, int y) {
        const double off =
            got.aov(Aov::kMirrorSources, x, y, 1) - judge.aov(Aov::kMirrorSources, x, y, 1);
        apart += std::abs(off) > 1e-3 ? 1 : 0;
      });
      EXPECT_LT(apart, 10);
    }
  }
}

/// The share of the visible facets that mirrors objects up to the angle `top` over the water, from
/// the angle `eye`, for waves with Gaussian slopes that raise the water. A ray that would go into
/// the water goes along the water.
double share_under(double top, double eye, double deviation) {
  double under = 0, all = 0;
  for (double slope = -6; slope < 6; slope += 1e-3) {
    const double seen = std::max(std::tan(eye) + slope * deviation, 0.0);
    const double weight = seen * std::exp(-0.5 * slope * slope);
    all += weight;
    if (eye + 2 * std::atan(slope * deviation) < top) under += weight;
  }
  return under / all;
}

// A wall behind water whose waves no pixel resolves: each pixel mirrors the wall with all facets
// that see the wall, not with all or none of each third of the facets.
TEST(MirrorAovs, UnresolvedWavesMirrorAWallByTheFacetsThatSeeIt) {
  constexpr double kDeviation = 0.1, kK = 200;
  Look look = test::still_look();
  look.of<FresnelReflection>().source = Source::kAuto;
  look.of<FresnelReflection>().lookup = FresnelReflection::Lookup::kRay;
  look.of<FresnelReflection>().facets = FresnelReflection::Facets::kSpread;
  look.of<FresnelReflection>().reflectance = FresnelReflection::Reflectance::kSchlick;
  look.of<FresnelReflection>().f0 = 1;
  WaveNormals::Params& waves = look.of<WaveNormals>();
  waves.model = WaveNormals::Model::kSines;
  waves.filter = WaveNormals::Filter::kVariance;
  waves.strength = 1;
  const double amplitude = kDeviation * std::sqrt(2.0) / kK;
  waves.waves = {{amplitude, kK, 0, 0}, {amplitude, 0, kK, 0}};
  for (const bool reflection : {false, true}) {
    double worst = 0, sum = 0;
    int count = 0;
    std::array<int, 4> quarters{};
    for (const int rows : {2, 4, 6, 8}) {
      const double top = 2 - 8 * rows * std::tan(0.5) / (kSize.height / 2);  // a row begins there
      Shore shore;
      shore.far = 8, shore.top = top;
      shore.buffers.set(PlaneId::kDepth, [&](int x, int y) { return shore.dry_depth(x, y); });
      // The wall's mirrored light is 1, and the sky's 0.
      const auto shown = [&](test::Buffers& buffers, PlaneId first, auto&& depth) {
        for (int c = 0; c < 3; ++c) {
          buffers.set(plane_after(first, c),
                      [&](int x, int y) { return depth(x, y) < 1e9 ? 1.0f : 0.0f; });
        }
      };
      const auto dry = [&](int x, int y) { return shore.dry_depth(x, y); };
      const auto mirrored = [&](int x, int y) { return shore.mirrored_depth(x, y); };
      test::Buffers bare = without_reflection(shore);
      shown(bare, PlaneId::kColorR, dry);
      shown(shore.buffers, PlaneId::kColorR, dry);
      shown(shore.buffers, PlaneId::kReflectionR, mirrored);
      const Frame& frame = reflection ? shore.buffers.frame : bare.frame;
      const Picture judge = test::reference(look, frame, shore.scene);
      const Picture got = test::fused(look, frame, shore.scene);
      for (int y = kSize.height - 9; y < kSize.height; ++y) {
        const int x = kSize.width / 2;
        const glm::dvec3 ray = shore.ray(x, y);
        const double distance = -2 / ray.y, eye = std::atan(-ray.y / -ray.z);
        const double right = share_under(std::atan(top / (8 + distance * ray.z)), eye, kDeviation);
        const double is = judge.aov(Aov::kReflected, x, y, 0);
        worst = std::max(worst, std::abs(is - right));
        sum += is - right;
        ++count;
        ++quarters[static_cast<std::size_t>(std::min(4 * right, 3.0))];
        EXPECT_NEAR(got.aov(Aov::kReflected, x, y, 0), judge.aov(Aov::kReflected, x, y, 0), 2e-3);
      }
    }
    for (const int of : quarters) EXPECT_GT(of, 0);
    // Facets that pass the skyline are followed over the reflection, whose depth the completer made
    // and is two pixels wider than the wall.
    EXPECT_LT(worst, reflection ? 0.08 : 0.03);
    EXPECT_LT(std::abs(sum / count), 0.01) << reflection;
  }
}

TEST(MirrorAovs, PlanesThatWereMadeAreShown) {
  Shore shore;
  const auto executor = make_executor(1);
  const MirrorDepth& made = shore.made(*executor);
  for (const bool reference : {false, true}) {
    const Look look = look_of(Source::kAuto);
    const Picture picture = reference ? test::reference(look, shore.buffers.frame, shore.scene)
                                      : test::fused(look, shore.buffers.frame, shore.scene);
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        EXPECT_EQ(picture.aov(Aov::kReflectionDepth, x, y), made.depth().view().at(x, y));
        EXPECT_EQ(picture.aov(Aov::kReflectionValid, x, y), made.valid().view().at(x, y));
        EXPECT_EQ(picture.aov(Aov::kSky, x, y), 0);
      }
    }
  }
  const test::Buffers bare = without_reflection(shore);
  const Picture picture = test::fused(look_of(Source::kAuto), bare.frame, shore.scene);
  EXPECT_EQ(picture.aov(Aov::kReflectionDepth, 3, 40), test::kInf);
  EXPECT_EQ(picture.aov(Aov::kReflectionValid, 3, 40), 0);
  EXPECT_FLOAT_EQ(static_cast<float>(picture.aov(Aov::kSky, 3, 40)), 0.5f);
}

}  // namespace
}  // namespace limpid
