#include "limpid/enter/sanitise.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
const float kNan = std::nanf("");

/// Sanitises a row of values by fn; returns the count of fn.
template <class Fn>
Replaced on_row(std::vector<float>& values, Fn&& fn) {
  const int n = static_cast<int>(values.size());
  return fn(View<float>{values.data(), 1, n, Rect{0, 0, n, 1}});
}

Camera reversed_camera() {
  Camera camera;
  camera.projection = perspective(0.8, 4, 0.5, HUGE_VAL, ClipSpace::kReversed);
  camera.clip = ClipSpace::kReversed;
  return camera;
}

TEST(Sanitise, ColorAndShadow) {
  std::vector<float> color{1, kNan, -kInf, kInf, -0.5f, 70000, kInf};
  EXPECT_EQ(on_row(color, [](auto v) { return sanitise_color(v); }), (Replaced{1, 3}));
  EXPECT_EQ(color, (std::vector<float>{1, 0, 0, 65504, -0.5f, 70000, 65504}));
  std::vector<float> shadow{0.25f, kNan, kInf, -1, 3};
  EXPECT_EQ(on_row(shadow, sanitise_shadow), (Replaced{1, 1}));
  EXPECT_EQ(shadow, (std::vector<float>{0.25f, 1, 1, 0, 1}));
}

TEST(Sanitise, AnAlphaOfInfinityIsOne) {
  std::vector<Plane> planes(kPlaneCount);
  for (const PlaneId id : {PlaneId::kColorR, PlaneId::kColorA, PlaneId::kBelowR}) {
    planes[static_cast<std::size_t>(index_of(id))] = Plane(Rect{0, 0, 2, 1});
    const View<float> view = planes[static_cast<std::size_t>(index_of(id))].view();
    view.at(0, 0) = kInf;
    view.at(1, 0) = kNan;
  }
  const SanitiseCounts counts = sanitise_planes(planes, {0, 1, 0});
  const auto at = [&](PlaneId id, int x) {
    return planes[static_cast<std::size_t>(index_of(id))].view().at(x, 0);
  };
  EXPECT_EQ(at(PlaneId::kColorR, 0), kLargestColor);
  EXPECT_EQ(at(PlaneId::kColorA, 0), 1);
  EXPECT_EQ(at(PlaneId::kBelowR, 0), kLargestColor);
  EXPECT_EQ(at(PlaneId::kColorA, 1), 0);
  EXPECT_EQ(counts.of(PlaneId::kColorR), (Replaced{2, 2}));
  EXPECT_EQ(counts.total(), 6);
}

TEST(Sanitise, NanAndInfAreToldApart) {
  SanitiseCounts counts;
  EXPECT_EQ(counts.to_text(), "");
  counts.of(PlaneId::kColorR) = {3, 1};
  counts.of(PlaneId::kDepth) = {2, 0};
  counts.of(PlaneId::kShadow) = {0, 4};
  EXPECT_EQ(counts.to_text(), "color 3 NaN 1 inf, depth 2 NaN, shadow 4 inf");
  SanitiseCounts twice = counts;
  twice += counts;
  EXPECT_EQ(twice.of(PlaneId::kColorR), (Replaced{6, 2}));
}

/// Wrong values are found wherever they lie: rows are searched before any value changes.
TEST(Sanitise, OneValueAmongManyIsFound) {
  struct Kind {
    Replaced (*sanitise)(const View<float>&);
    float wrong, right;
    int counted;
  };
  const auto depth = [](const View<float>& v) { return make_eye_depth(v, {}); };
  const auto color = [](const View<float>& v) { return sanitise_color(v); };
  const Kind kinds[] = {
      {color, kNan, 0, 1},           {color, -kInf, 0, 1},          {color, kInf, 65504, 1},
      {sanitise_shadow, kNan, 1, 1}, {sanitise_shadow, 1.5f, 1, 0}, {sanitise_mask, -0.25f, 0, 0},
      {depth, kNan, kInf, 1},        {depth, -kInf, kInf, 1},       {depth, 1e9f, kInf, 0}};
  for (const Kind& kind : kinds) {
    for (const int stride : {1, 3}) {
      for (int wrong_at = 0; wrong_at < 37; ++wrong_at) {
        constexpr Rect kWindow{0, 0, 37, 3};
        std::vector<float> values(37 * 3 * 3, 0.5f), expected = values;
        const auto at = static_cast<std::size_t>((37 + wrong_at) * stride);
        values[at] = kind.wrong;
        expected[at] = kind.right;
        EXPECT_EQ(kind.sanitise({values.data(), stride, 37 * stride, kWindow}).total(),
                  kind.counted);
        ASSERT_EQ(values, expected) << kind.wrong << " at " << wrong_at << ", stride " << stride;
      }
    }
  }
}

TEST(Sanitise, NormalsAreMadeUnitOrUp) {
  std::vector<float> x{3, 0, kNan}, y{0, 0, 1}, z{4, 0, 0};
  const auto view = [](std::vector<float>& v) {
    return View<float>{v.data(), 1, 3, Rect{0, 0, 3, 1}};
  };
  EXPECT_EQ(sanitise_normal(view(x), view(y), view(z), {0, 0, 1}), (Replaced{1, 0}));
  EXPECT_EQ(x, (std::vector<float>{0.6f, 0, 0}));
  EXPECT_EQ(y, (std::vector<float>{0, 0, 0}));
  EXPECT_EQ(z, (std::vector<float>{0.8f, 1, 1}));
}

TEST(Sanitise, NothingHitByItsNumbers) {
  for (bool half : {false, true}) {
    std::vector<float> depth{5, 59999, 60000, 65504, 9e8f, 1e9f, 1e10f, kInf, -2};
    EXPECT_EQ(on_row(depth, [&](auto v) { return make_eye_depth(v, {.half = half}); }).total(), 0);
    const float far = half ? kInf : 60000;
    EXPECT_EQ(depth, (std::vector<float>{5, 59999, far, half ? kInf : 65504, half ? kInf : 9e8f,
                                         kInf, kInf, kInf, -2}));
  }
}

TEST(Sanitise, DepthOfEveryKindIsANumberAfterwards) {
  const Camera camera = reversed_camera();
  for (DepthKind kind : {DepthKind::kEye, DepthKind::kRay, DepthKind::kInverse,
                         DepthKind::kNormalised, DepthKind::kDevice}) {
    std::vector<float> depth{kNan, -kInf, kInf, 0.25f};
    const DepthSource source{kind, false, 1, 9, &camera, {0, 0, 4, 1}};
    const Replaced replaced = on_row(depth, [&](auto v) { return make_eye_depth(v, source); });
    EXPECT_EQ(replaced.nan, 1);
    EXPECT_LE(replaced.inf, 1);
    EXPECT_EQ(depth[0], kInf);
    for (float z : depth) EXPECT_FALSE(std::isnan(z) || z == -kInf) << static_cast<int>(kind);
    EXPECT_TRUE(std::isfinite(depth[3]));
  }
}

TEST(Sanitise, KindsByHand) {
  const Camera camera = reversed_camera();
  const auto one = [&](DepthKind kind, float value) {
    std::vector<float> depth{value};
    on_row(depth, [&](auto v) {
      return make_eye_depth(v, {kind, false, 2, 10, &camera, {0, 0, 1, 1}});
    });
    return depth[0];
  };
  EXPECT_FLOAT_EQ(one(DepthKind::kInverse, 0.25f), 4);
  EXPECT_EQ(one(DepthKind::kInverse, 0), kInf);
  EXPECT_FLOAT_EQ(one(DepthKind::kNormalised, 0.25f), 4);
  EXPECT_EQ(one(DepthKind::kNormalised, 1), kInf);
  EXPECT_FLOAT_EQ(one(DepthKind::kDevice, 0.125f), 4);  // near / z
  EXPECT_EQ(one(DepthKind::kDevice, 0), kInf);
  EXPECT_FLOAT_EQ(one(DepthKind::kRay, 4), 4);  // the middle of a one-pixel picture
}

TEST(Sanitise, RefusesKindsThatLackWhatTheyNeed) {
  std::vector<float> depth{1};
  const auto made = [&](DepthSource source) {
    return on_row(depth, [&](auto v) { return make_eye_depth(v, source); });
  };
  EXPECT_THROW(made({.kind = DepthKind::kRay}), Error);
  EXPECT_THROW(made({.kind = DepthKind::kDevice}), Error);
  EXPECT_THROW(made({.kind = DepthKind::kNormalised, .near = 1, .far = 1}), Error);
}

}  // namespace
}  // namespace limpid
