#include "limpid/enter/sanitise.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
const float kNan = std::nanf("");

/// One row of values, sanitised by fn; returns what fn counted.
template <class Fn>
std::int64_t on_row(std::vector<float>& values, Fn&& fn) {
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
  std::vector<float> color{1, kNan, -kInf, kInf, -0.5f, 70000};
  EXPECT_EQ(on_row(color, sanitise_color), 3);
  EXPECT_EQ(color, (std::vector<float>{1, 0, 0, 0, -0.5f, 70000}));
  std::vector<float> shadow{0.25f, kNan, kInf, -1, 3};
  EXPECT_EQ(on_row(shadow, sanitise_shadow), 2);
  EXPECT_EQ(shadow, (std::vector<float>{0.25f, 1, 1, 0, 1}));
}

/// Rows are looked through before one of their values is touched: wherever the wrong one lies.
TEST(Sanitise, OneValueAmongManyIsFound) {
  struct Kind {
    std::int64_t (*sanitise)(const View<float>&);
    float wrong, right;
    int counted;
  };
  const auto depth = [](const View<float>& v) { return make_eye_depth(v, {}); };
  const Kind kinds[] = {{sanitise_color, kNan, 0, 1},  {sanitise_color, -kInf, 0, 1},
                        {sanitise_shadow, kNan, 1, 1}, {sanitise_shadow, 1.5f, 1, 0},
                        {sanitise_mask, -0.25f, 0, 0}, {depth, kNan, kInf, 1},
                        {depth, -kInf, kInf, 1},       {depth, 1e9f, kInf, 0}};
  for (const Kind& kind : kinds) {
    for (const int stride : {1, 3}) {
      for (int wrong_at = 0; wrong_at < 37; ++wrong_at) {
        constexpr Rect kWindow{0, 0, 37, 3};
        std::vector<float> values(37 * 3 * 3, 0.5f), expected = values;
        const auto at = static_cast<std::size_t>((37 + wrong_at) * stride);
        values[at] = kind.wrong;
        expected[at] = kind.right;
        EXPECT_EQ(kind.sanitise({values.data(), stride, 37 * stride, kWindow}), kind.counted);
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
  EXPECT_EQ(sanitise_normal(view(x), view(y), view(z), {0, 0, 1}), 1);
  EXPECT_EQ(x, (std::vector<float>{0.6f, 0, 0}));
  EXPECT_EQ(y, (std::vector<float>{0, 0, 0}));
  EXPECT_EQ(z, (std::vector<float>{0.8f, 1, 1}));
}

TEST(Sanitise, NothingHitByItsNumbers) {
  for (bool half : {false, true}) {
    std::vector<float> depth{5, 59999, 60000, 65504, 9e8f, 1e9f, 1e10f, kInf, -2};
    EXPECT_EQ(on_row(depth, [&](auto v) { return make_eye_depth(v, {.half = half}); }), 0);
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
    const std::int64_t replaced = on_row(depth, [&](auto v) { return make_eye_depth(v, source); });
    EXPECT_GE(replaced, 1);
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
