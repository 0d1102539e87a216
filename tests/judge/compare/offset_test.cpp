#include "judge/compare/offset.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

const float kInf = std::numeric_limits<float>::infinity();
const float kNan = std::nanf("");

// A row of lookups on a display of 100x50.
struct Row {
  explicit Row(int width)
      : window{4, 9, 4 + width, 10},
        depth(window),
        confidence(window),
        u(window),
        v(window),
        true_u(window),
        true_v(window),
        visible(window) {
    for (int i = 0; i < width; ++i) set(i, {});
  }

  struct Lookup {
    float depth = 3, confidence = 1, u = 0.5f, v = 0.5f, true_u = 0.5f, true_v = 0.5f, visible = 1;
  };
  void set(int i, const Lookup& l) {
    const auto put = [&](Plane& plane, float value) { plane.view().at(4 + i, 9) = value; };
    put(depth, l.depth), put(confidence, l.confidence), put(visible, l.visible);
    put(u, l.u), put(v, l.v), put(true_u, l.true_u), put(true_v, l.true_v);
  }

  OffsetPictures pictures() const {
    const OffsetChannel one{u.view(), v.view(), true_u.view(), true_v.view(), visible.view()};
    return {{100, 50}, depth.view(), confidence.view(), {one, one, one}};
  }
  OffsetComparison errors() const { return offset_errors(pictures()); }

  Rect window;
  Plane depth, confidence, u, v, true_u, true_v, visible;
};

TEST(Offset, ByHand) {
  Row row(8);
  row.set(0, {.u = 0.53f, .v = 0.58f});                           // 3 across, 4 up
  row.set(1, {.true_u = 0.51f});                                  // 1
  row.set(2, {.confidence = 0, .u = 0.9f});                       // wrongly rejected
  row.set(3, {.u = 0.9f, .true_u = kNan, .visible = 0});          // wrongly accepted
  row.set(4, {.confidence = 0, .u = 0.9f, .visible = 0});         // rightly rejected
  row.set(5, {.depth = kInf, .confidence = 0, .u = 0.9f});        // dry
  row.set(6, {.confidence = 0.5f, .v = 0.54f, .visible = 0.5f});  // 2: half a confidence counts
  const OffsetComparison all = row.errors();
  const OffsetErrors& red = all.channels[0];
  EXPECT_EQ(red.wet, 7);
  EXPECT_EQ(red.measured, 4);
  EXPECT_NEAR(red.median, 1, 1e-5);  // of 0, 1, 2, 5
  EXPECT_NEAR(red.p95, 5, 1e-5);
  EXPECT_NEAR(red.max, 5, 1e-5);
  EXPECT_DOUBLE_EQ(red.wrongly_rejected, 1.0 / 7);
  EXPECT_DOUBLE_EQ(red.wrongly_accepted, 1.0 / 7);
  EXPECT_EQ(red.mismatches, 0);
  EXPECT_EQ(all.overall.wet, 21);
  EXPECT_EQ(all.overall.measured, 12);
  EXPECT_EQ(all.overall.median, red.median);
  EXPECT_DOUBLE_EQ(all.overall.wrongly_rejected, 1.0 / 7);
}

TEST(Offset, ChannelsAreApart) {
  Row row(2), blue(2);
  blue.set(0, {.true_u = 0.6f});
  blue.set(1, {.visible = 0});
  OffsetPictures pictures = row.pictures();
  pictures.channels[2] = blue.pictures().channels[2];
  const OffsetComparison all = offset_errors(pictures);
  EXPECT_EQ(all.channels[0].max, 0);
  EXPECT_EQ(all.channels[1].wrongly_accepted, 0);
  EXPECT_NEAR(all.channels[2].max, 10, 1e-5);
  EXPECT_EQ(all.channels[2].wrongly_accepted, 0.5);
  EXPECT_NEAR(all.overall.max, 10, 1e-5);
  EXPECT_DOUBLE_EQ(all.overall.wrongly_accepted, 1.0 / 6);
}

TEST(Offset, PercentilesAreExact) {
  Row row(100);
  for (int i = 0; i < 100; ++i) {
    row.set(i, {.u = 0, .true_u = static_cast<float>((i * 37) % 100 + 1)});
  }
  const OffsetErrors errors = row.errors().overall;
  EXPECT_EQ(errors.median, 5000);
  EXPECT_EQ(errors.p95, 9500);
  EXPECT_EQ(errors.max, 10000);
}

TEST(Offset, NumbersThatAreNoneAreTheWorstThereIs) {
  for (const Row::Lookup& bad : std::vector<Row::Lookup>{{.confidence = kNan},
                                                         {.depth = kNan},
                                                         {.depth = -kInf},
                                                         {.u = kNan},
                                                         {.v = kInf},
                                                         {.true_v = kNan},
                                                         {.u = kInf, .true_u = kInf},
                                                         {.visible = kNan},
                                                         {.confidence = 0, .visible = kInf}}) {
    Row row(5);
    row.set(2, bad);
    const OffsetErrors errors = row.errors().channels[1];
    EXPECT_EQ(errors.mismatches, 1);
    EXPECT_EQ(errors.max, kInf);
    EXPECT_EQ(errors.p95, kInf);
    EXPECT_EQ(errors.median, 0);
    EXPECT_EQ(errors.measured, 5);
  }
  // Pixels without a measurement do not count.
  Row row(3);
  row.set(0, {.confidence = 0, .u = kNan});
  row.set(1, {.true_u = kNan, .visible = 0});
  row.set(2, {.depth = kInf, .confidence = kNan, .visible = kNan});
  EXPECT_EQ(row.errors().overall.mismatches, 0);
}

TEST(Offset, OfADryPictureThereIsNone) {
  Row row(2);
  row.set(0, {.depth = kInf});
  row.set(1, {.depth = kInf});
  const OffsetComparison all = row.errors();
  EXPECT_EQ(all.overall.wet, 0);
  EXPECT_EQ(all.overall.max, 0);
  EXPECT_EQ(to_text(all), "  Offset = nothing is wet\n");
}

TEST(Offset, Text) {
  Row row(4);
  row.set(0, {.true_u = 0.25f});
  row.set(1, {.confidence = 0});
  EXPECT_EQ(
      to_text(row.errors()),
      "  Offset = median 0, 95% 25, max 25 pixels, of 9 lookups; wrongly rejected 25%, wrongly "
      "accepted 0% of 12\n"
      "    R  median 0, 95% 25, max 25 pixels, of 3 lookups; wrongly rejected 25%, wrongly "
      "accepted "
      "0% of 4\n"
      "    G  median 0, 95% 25, max 25 pixels, of 3 lookups; wrongly rejected 25%, wrongly "
      "accepted "
      "0% of 4\n"
      "    B  median 0, 95% 25, max 25 pixels, of 3 lookups; wrongly rejected 25%, wrongly "
      "accepted "
      "0% of 4\n");
}

TEST(Offset, RefusesWindowsThatDiffer) {
  const Row row(4), other(5);
  OffsetPictures pictures = row.pictures();
  pictures.channels[1].true_v = other.true_v.view();
  EXPECT_THROW(offset_errors(pictures), Error);
  pictures = row.pictures();
  pictures.confidence = other.confidence.view();
  EXPECT_THROW(offset_errors(pictures), Error);
  pictures = row.pictures();
  pictures.display = {};
  EXPECT_THROW(offset_errors(pictures), Error);
}

}  // namespace
}  // namespace limpid
