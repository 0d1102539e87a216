#include <gtest/gtest.h>

#include "complete/post.h"
#include "job/deep_output.h"

// The water of a deep file is computed for whole pixels, also where an object covers a part of a
// pixel.

namespace limpid {
namespace {

using test::Post;

WaterExtent extent_of(const Post& post) {
  Look look;
  look.of<WaveNormals>().model = WaveNormals::Model::kSines;
  look.of<Refraction>().model = Refraction::Model::kNormalOffset;
  look.of<DepthFog>() = test::plain_fog(DepthFog::Model::kBeerLambert);
  look.of<DepthFog>().scattering = look.of<DepthFog>().ambient = {0.3, 0.3, 0.3};
  const Plan plan =
      make_plan(look, test::inputs_of(post.buffers.frame, post.scene), state_shown_by(kDeepAovs));
  test::Picture picture(rect_of(Post::kSize));
  Plane uncovered(rect_of(Post::kSize));
  picture.target.uncovered = uncovered.view();
  run_reference(plan, post.buffers.frame, post.scene, picture.target);
  return water_extent(plan, post.buffers.frame, post.scene, picture.target);
}

TEST(DeepEdges, WaterBehindABlurIsThatOfTheWholePixel) {
  Post post, clean;
  post.blur = 8;
  clean.width = -1000;
  const WaterExtent got = extent_of(post.make()), whole = extent_of(clean.make());
  int parts = 0;
  for (int x = 30; x < 100; ++x) {
    if (post.cover(x) < 0.05 || post.cover(x) > 0.95) continue;
    ++parts;
    for (int y = 30; y < 80; y += 10) {
      EXPECT_GT(whole.in_scatter[0].view().at(x, y), 0.05f);
      EXPECT_NEAR(got.in_scatter[0].view().at(x, y), whole.in_scatter[0].view().at(x, y), 1e-3);
      EXPECT_FLOAT_EQ(got.front.view().at(x, y), whole.front.view().at(x, y));
      EXPECT_NEAR(got.back.view().at(x, y), whole.back.view().at(x, y), 0.02);
    }
  }
  EXPECT_GE(parts, 10);
  EXPECT_TRUE(std::isinf(got.front.view().at(64, 60)));  // the post itself
}

}  // namespace
}  // namespace limpid
