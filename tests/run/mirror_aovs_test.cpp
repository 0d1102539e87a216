#include <gtest/gtest.h>

#include "complete/shore.h"

// What of a mirror was made, and where its light was taken from.

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

/// Without a reflection the shore's own picture is mirrored.
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
