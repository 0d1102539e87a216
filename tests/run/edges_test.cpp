#include <gtest/gtest.h>

#include "complete/post.h"

// Blurred edges in the finished picture: neither salt nor halo.

namespace limpid {
namespace {

using test::Post;

/// Water that reddens and mirrors a color; nothing bends the view.
Look plain_look() {
  Look look;
  look.of<WaveNormals>().model = WaveNormals::Model::kSines;
  look.of<PrismSplit>().gain = 0;
  look.of<Refraction>().model = Refraction::Model::kNormalOffset;
  look.of<DepthFog>() = test::plain_fog(DepthFog::Model::kBeerLambert);
  look.of<DepthFog>().absorption = {0.1, 0.4, 0.8};
  look.of<DepthFog>().scattering = {0.05, 0.05, 0.05};
  look.of<DepthFog>().ambient = {0.3, 0.3, 0.3};
  look.of<FresnelReflection>().source = FresnelReflection::Source::kConstant;
  look.of<FresnelReflection>().color = {2, 2, 2};
  return look;
}

double distance(const Rgb<double>& a, const Rgb<double>& b) {
  return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
}

struct Errors {
  double mean = 0, most = 0;
};

/// The difference from the post's own color over the water without the post, in the columns around
/// the post's sides, without the rows whose lookups land where the post hides the bottom.
Errors errors_of(const Post& post, const test::Picture& got, const test::Picture& without) {
  Errors errors;
  int count = 0;
  for (int y = 20; y < 90; ++y) {
    for (int x = 24; x < 104; ++x) {
      const double cover = post.cover(x);
      if (cover >= 1) continue;
      const Rgb<float> dark = post.front(x, y);
      const Rgb<double> before{dark.r, dark.g, dark.b};
      const Rgb<double> expected = cover * before + (1 - cover) * without.color(x, y);
      const double error = distance(got.color(x, y), expected);
      errors.mean += error;
      errors.most = std::max(errors.most, error);
      ++count;
    }
  }
  errors.mean /= count;
  return errors;
}

struct Pictures {
  Post post, clean;
  test::Picture without{rect_of(Post::kSize)}, mixed{rect_of(Post::kSize)},
      hard{rect_of(Post::kSize)};

  Pictures(double blur, Post::Depth kind) {
    Look look = plain_look();
    post.blur = blur;
    post.kind = kind;
    post.make();
    clean.width = -1000;
    clean.make();
    without = test::reference(look, clean.buffers.frame, clean.scene);
    mixed = test::reference(look, post.buffers.frame, post.scene);
    look.water.edges = Water::Edges::kHard;
    hard = test::reference(look, post.buffers.frame, post.scene);
  }
};

TEST(EdgesInThePicture, AreMixedOfBoth) {
  for (const Post::Depth kind : {Post::Depth::kMiddle, Post::Depth::kOneSample}) {
    for (const double blur : {1.0, 8.0}) {
      SCOPED_TRACE(blur);
      const Pictures p(blur, kind);
      const Errors mixed = errors_of(p.post, p.mixed, p.without);
      const Errors hard = errors_of(p.post, p.hard, p.without);
      EXPECT_LT(mixed.mean, 0.3 * hard.mean);
      EXPECT_LT(mixed.most, 0.4 * hard.most);
    }
  }
}

TEST(EdgesInThePicture, TheFusedRunnerAgrees) {
  const Pictures p(6, Post::Depth::kMiddle);
  const test::Picture fused = test::fused(plain_look(), p.post.buffers.frame, p.post.scene, {}, 2);
  for (int y = 0; y < Post::kSize.height; ++y) {
    for (int x = 0; x < Post::kSize.width; ++x) {
      EXPECT_LT(distance(fused.color(x, y), p.mixed.color(x, y)), 1e-3) << x << " " << y;
    }
  }
}

TEST(EdgesInThePicture, FourTermsSumToIt) {
  const Pictures p(6, Post::Depth::kMiddle);
  for (int y = 0; y < Post::kSize.height; ++y) {
    for (int x = 0; x < Post::kSize.width; ++x) {
      double sum = 0;
      for (const Aov aov : {Aov::kTransmitted, Aov::kInScatter, Aov::kReflected, Aov::kHighlight}) {
        sum += p.mixed.aov(aov, x, y);
      }
      EXPECT_NEAR(p.mixed.color(x, y).r, sum, 1e-6);
      EXPECT_EQ(p.mixed.target.alpha.at(x, y), 1);
    }
  }
}

// Measures are those of the water: transmittance and Fresnel are not averaged with the post's.
TEST(EdgesInThePicture, MeasuresAreOfTheWater) {
  const Pictures p(6, Post::Depth::kMiddle);
  int parts = 0;
  for (int x = 24; x < 104; ++x) {
    if (p.post.cover(x) < 0.03 || p.post.cover(x) > 0.97) continue;
    ++parts;
    for (const Aov aov : {Aov::kFresnel, Aov::kSurfaceDepth}) {
      EXPECT_NEAR(p.mixed.aov(aov, x, 60), p.without.aov(aov, x, 60), 1e-4);
    }
    EXPECT_NEAR(p.mixed.aov(Aov::kPath, x, 60), p.without.aov(Aov::kPath, x, 60), 0.1);
  }
  EXPECT_GE(parts, 8);
}

TEST(EdgesInThePicture, WithoutEdgesAllIsUncovered) {
  Post post;
  post.blur = 6;
  post.make();
  Look look = plain_look();
  look.water.edges = Water::Edges::kHard;
  test::Picture picture(rect_of(Post::kSize));
  Plane uncovered(rect_of(Post::kSize));
  picture.target.uncovered = uncovered.view();
  const Plan plan = make_plan(look, test::inputs_of(post.buffers.frame, post.scene));
  run_reference(plan, post.buffers.frame, post.scene, picture.target);
  for (int y = 0; y < Post::kSize.height; ++y) {
    for (int x = 0; x < Post::kSize.width; ++x) ASSERT_EQ(uncovered.view().at(x, y), 1);
  }
}

TEST(EdgesInThePicture, TheUncoveredShareIsTold) {
  Post post;
  post.blur = 6;
  post.make();
  test::Picture picture(rect_of(Post::kSize));
  Plane uncovered(rect_of(Post::kSize));
  picture.target.uncovered = uncovered.view();
  const Plan plan = make_plan(plain_look(), test::inputs_of(post.buffers.frame, post.scene));
  run_reference(plan, post.buffers.frame, post.scene, picture.target);
  int parts = 0;
  for (int x = 0; x < Post::kSize.width; ++x) {
    const double share = uncovered.view().at(x, 60), cover = post.cover(x);
    const bool parted = cover > 0.1 && cover < 0.9;
    parts += parted;
    if (parted || share < 1) {
      EXPECT_NEAR(share, 1 - cover, 0.06) << x;
    }
  }
  EXPECT_GE(parts, 8);
}

}  // namespace
}  // namespace limpid
