#include "limpid/run/fused.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "support.h"

namespace limpid {
namespace {

using test::Buffers;
using test::Picture;

Look busy_look() {
  Look look = test::article_look();
  look.of<PrismSplit>().strength = 0.01;
  look.of<SunHighlight>().power = 20;
  return look;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

constexpr Size kAwkwardSizes[] = {{1, 1},   {1, 9},   {9, 1},   {7, 5},
                                  {127, 3}, {128, 3}, {129, 3}, {131, 37}};

void expect_same_from_any_strides(const Look& look, Size size, const std::string& simd) {
  const Buffers planar = test::noisy_frame(rect_of(size));
  // The same color as interleaved RGBA, stored bottom row first, four pixels of slack a row;
  // normals likewise.
  const std::ptrdiff_t row = 4 * (size.width + 4);
  const std::vector<float> none(static_cast<std::size_t>(row) * size.height);
  std::vector<float> pixels = none, normals = none;
  Frame interleaved = planar.frame;
  const auto interleave = [&](PlaneId first, int count, std::vector<float>& to) {
    for (int c = 0; c < count; ++c) {
      const int plane = index_of(plane_after(first, c));
      const View<float> view{to.data() + row * (size.height - 1) + c, 4, -row, rect_of(size)};
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) view.at(x, y) = planar.frame.planes[plane].at(x, y);
      }
      interleaved.planes[plane] = view;
    }
  };
  interleave(PlaneId::kColorR, 4, pixels);
  interleave(PlaneId::kSurfaceNormalX, 3, normals);
  const Scene scene = test::simple_scene(size);
  const FusedOptions options{.simd = simd};
  EXPECT_TRUE(same_bits(test::fused(look, planar.frame, scene, options).values(),
                        test::fused(look, interleaved, scene, options).values()))
      << size.width << "x" << size.height;
  // Three channels that are looked up together unless a prism parts them; rows of the first channel
  // lie twice as far apart.
  Look whole = look;
  whole.of<PrismSplit>().strength = whole.of<PrismSplit>().gain = 0;
  Frame uneven = planar.frame;
  const int red = index_of(PlaneId::kBelowR);
  std::vector<float> rows(2 * static_cast<std::size_t>(size.width) * size.height);
  const View<float> apart{rows.data(), 1, 2 * size.width, rect_of(size)};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) apart.at(x, y) = planar.frame.planes[red].at(x, y);
  }
  uneven.planes[red] = apart;
  const auto shown = [&](const Frame& frame) {
    const Picture picture(frame.work());
    Target target = picture.target;
    target.aovs = {};
    run_fused(make_plan(whole, test::inputs_of(frame, scene)), frame, scene, target,
              *make_executor(1), options);
    return picture.values();
  };
  EXPECT_TRUE(same_bits(shown(planar.frame), shown(uneven))) << size.width << "x" << size.height;
}

class FusedOnTarget : public testing::TestWithParam<std::string> {};

TEST_P(FusedOnTarget, AgreesWithTheReferenceAtAwkwardSizes) {
  for (Size size : kAwkwardSizes) {
    const Buffers b = test::noisy_frame(rect_of(size));
    const Scene scene = test::simple_scene(size);
    const std::vector<float> judge = test::reference(busy_look(), b.frame, scene).values();
    const std::vector<float> got =
        test::fused(busy_look(), b.frame, scene, {.simd = GetParam()}).values();
    ASSERT_EQ(judge.size(), got.size());
    std::size_t far = 0;
    for (std::size_t i = 0; i < judge.size(); ++i) {
      const bool same = judge[i] == got[i] || std::abs(judge[i] - got[i]) < 2e-5;
      far += !same;
    }
    // A lookup that lands exactly between two texels of the depth may round either way: noise has
    // such pixels.
    EXPECT_LE(far, judge.size() / 5000) << size.width << "x" << size.height;
  }
}

TEST_P(FusedOnTarget, NormalMapAgreesWithTheReference) {
  const Size size{67, 41};
  Buffers b = test::noisy_frame(rect_of(size));
  for (int c = 0; c < 3; ++c) b.frame.planes[index_of(PlaneId::kSurfaceNormalX) + c] = {};
  b.frame.planes[index_of(PlaneId::kSurfaceDepth)] = {};
  b.set(PlaneId::kDepth, [](int x, int y) { return 2 + 8 * test::noise(x / 9, y / 9, 3); });
  const test::NoiseMap map(16, 8);
  b.frame.wave_map = map.texture;  // a map may lie anywhere
  for (View<const float>& channel : b.frame.wave_map.channels) channel.window = {5, -3, 21, 5};
  Scene scene = test::simple_scene(size);
  scene.time = 12.3;
  const Picture judge = test::reference(busy_look(), b.frame, scene);
  const Picture got = test::fused(busy_look(), b.frame, scene, {.simd = GetParam()});
  int wet = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double depth = judge.aov(Aov::kSurfaceDepth, x, y);
      EXPECT_EQ(std::isinf(depth), std::isinf(got.aov(Aov::kSurfaceDepth, x, y)));
      if (std::isinf(depth)) continue;
      ++wet;
      EXPECT_NEAR(depth, got.aov(Aov::kSurfaceDepth, x, y), 2e-6 * depth);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(judge.aov(Aov::kNormal, x, y, c), got.aov(Aov::kNormal, x, y, c), 2e-5);
      }
    }
  }
  EXPECT_GT(wet, 500);
}

/// Water at the eye itself, and next to the eye: a ray that starts there may come from behind.
TEST_P(FusedOnTarget, WaterAtTheEyeMakesNoNan) {
  const Size size{33, 9};
  Buffers b = test::noisy_frame(rect_of(size));
  const Scene scene = test::simple_scene(size);
  for (const float depth : {0.0f, 1e-45f, 1e-40f, 1e-30f, 1e-20f, 1e-3f}) {
    b.fill(PlaneId::kSurfaceDepth, depth);
    const Picture got = test::fused({}, b.frame, scene, {.simd = GetParam()});
    for (const float value : got.values()) ASSERT_FALSE(std::isnan(value)) << depth;
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(got.target.color[c].at(9, 5))) << depth;
  }
}

/// 0.6^200 is 4e-45: high powers of numbers that are not small would make many denormals.
TEST_P(FusedOnTarget, MakesNoDenormals) {
  const Size size{67, 41};
  Buffers b = test::noisy_frame(rect_of(size));
  b.fill(PlaneId::kSurfaceShadow, 1);
  Look look = busy_look();
  look.of<SunHighlight>().model = SunHighlight::Model::kPhong;
  int flushed = 0;
  for (const double power : {150.0, 200.0, 200.5}) {
    look.of<SunHighlight>().power = power;
    const Picture judge = test::reference(look, b.frame, test::simple_scene(size));
    const Picture got = test::fused(look, b.frame, test::simple_scene(size), {.simd = GetParam()});
    for (const float value : got.values()) EXPECT_NE(std::fpclassify(value), FP_SUBNORMAL);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const double expected = judge.aov(Aov::kHighlight, x, y);
        flushed += expected > 0 && expected < 1e-38;
        // The lobe is 0 below 1.2e-38, and the sun three times as bright.
        EXPECT_NEAR(got.aov(Aov::kHighlight, x, y), expected, 1e-3 * expected + 4e-38);
      }
    }
  }
  EXPECT_GT(flushed, 0);
}

/// Eight bits of a value are one fetch for three channels, by a code path of their own.
TEST_P(FusedOnTarget, PackedNormalMapAgreesWithTheReference) {
  const Size size{133, 21};
  Buffers b = test::noisy_frame(rect_of(size));
  for (int c = 0; c < 3; ++c) b.frame.planes[index_of(PlaneId::kSurfaceNormalX) + c] = {};
  for (const Size map_size : {Size{1, 1}, Size{1, 5}, Size{7, 3}, Size{16, 8}}) {
    std::vector<Plane> planes;
    Texture map;
    for (std::size_t c = 0; c < 3; ++c) {
      planes.emplace_back(rect_of(map_size));
      for (int y = 0; y < map_size.height; ++y) {
        for (int x = 0; x < map_size.width; ++x) {
          const double value = test::noise(x, y, static_cast<int>(c));
          planes[c].view().at(x, y) = static_cast<float>(std::round(255 * value) / 255);
        }
      }
      map.channels[c] = planes[c].view();
    }
    const std::vector<std::uint32_t> bytes = pack_bytes(map);
    map.bytes = bytes.data();
    ASSERT_FALSE(bytes.empty());
    b.frame.wave_map = map;
    Scene scene = test::simple_scene(size);
    scene.time = 7.7;
    const Picture judge = test::reference(busy_look(), b.frame, scene);
    const Picture got = test::fused(busy_look(), b.frame, scene, {.simd = GetParam()});
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(judge.aov(Aov::kNormal, x, y, c), got.aov(Aov::kNormal, x, y, c), 3e-5)
              << map_size.width << "x" << map_size.height << " at " << x << ", " << y;
        }
      }
    }
  }
}

TEST_P(FusedOnTarget, SameBitsForAnyTileSizeAndThreadCount) {
  const Size size{261, 75};
  const Buffers b = test::noisy_frame(rect_of(size));
  const Scene scene = test::simple_scene(size);
  const std::string simd = GetParam();
  const std::vector<float> whole =
      test::fused(busy_look(), b.frame, scene, {.simd = simd, .tile = {4096, 4096}}).values();
  for (Size tile : {Size{1, 1}, Size{13, 7}, Size{64, 32}, Size{129, 1}, Size{261, 2}}) {
    for (int threads : {1, 2, 3}) {
      const std::vector<float> tiled =
          test::fused(busy_look(), b.frame, scene, {.simd = simd, .tile = tile}, threads).values();
      EXPECT_TRUE(same_bits(whole, tiled)) << tile.width << "x" << tile.height << ", " << threads;
    }
  }
}

TEST_P(FusedOnTarget, DryPixelsPassThroughBitForBit) {
  const Size size{33, 17};
  const Buffers b = test::noisy_frame(rect_of(size));
  const Picture got =
      test::fused(busy_look(), b.frame, test::simple_scene(size), {.simd = GetParam()});
  int dry = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const bool wet =
          b.frame.plane(PlaneId::kSurfaceDepth).at(x, y) < b.frame.plane(PlaneId::kDepth).at(x, y);
      if (wet) continue;
      ++dry;
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(got.target.color[c].at(x, y),
                  b.frame.plane(plane_after(PlaneId::kColorR, c)).at(x, y));
      }
      EXPECT_EQ(got.target.alpha.at(x, y), b.frame.plane(PlaneId::kColorA).at(x, y));
    }
  }
  EXPECT_GT(dry, 50);
}

/// Planes side by side are read in pairs, others texel by texel, with the same bits: by samplers
/// (the article's look), by probes, and with neighbouring planes, also at windows of one column or
/// one row.
TEST_P(FusedOnTarget, ReadsAndWritesAnyStrides) {
  Look plate = busy_look();
  plate.of<WaveNormals>().model = WaveNormals::Model::kPlate;
  plate.of<WaveNormals>().filter = WaveNormals::Filter::kVariance;
  for (const Size size : {Size{37, 11}, Size{1, 9}, Size{9, 1}, Size{2, 2}}) {
    expect_same_from_any_strides(busy_look(), size, GetParam());
    expect_same_from_any_strides(Look{}, size, GetParam());
    expect_same_from_any_strides(plate, size, GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(Simd, FusedOnTarget, testing::ValuesIn(simd_targets()),
                         [](const auto& p) { return p.param; });

TEST(Fused, TimesAreOfTheOperatorsThatRun) {
  const Size size{300, 40};
  const Buffers b = test::noisy_frame(rect_of(size));
  const Picture picture(b.frame.work());
  Look look = busy_look();
  look.of<SunHighlight>().strength = 0;
  const Plan plan = make_plan(look, test::inputs_of(b.frame, test::simple_scene(size)), StateSet{});
  RunTimes times;
  run_fused(plan, b.frame, test::simple_scene(size), picture.target, *make_executor(2),
            {.times = &times});
  int kept = 0;
  for (int i = 0; i < Chain::kCount; ++i) {
    EXPECT_EQ(times.operators[static_cast<std::size_t>(i)] > 0, plan.keeps(i)) << i;
    kept += plan.keeps(i);
  }
  EXPECT_GT(kept, 3);
  EXPECT_LT(kept, Chain::kCount);
  EXPECT_GT(times.rest, 0);
}

/// Where the survey finds no foreground the foreground test is left out. One dry pixel makes its
/// cells run the test; pixels far from the dry pixel do not change by a bit.
TEST(Fused, CellsWithoutForegroundHaveTheBitsOfThoseWithout) {
  const Size size{512, 64};
  Buffers b = test::noisy_frame(rect_of(size));
  for (int i = 0; i < kPlaneCount; ++i) {  // no foreground is in a layer below
    if (kBelowPlanes.has(static_cast<PlaneId>(i))) b.frame.planes[i] = {};
  }
  b.fill(PlaneId::kSurfaceDepth, 4);
  b.set(PlaneId::kDepth, [](int x, int y) { return 5 + test::noise(x, y, 7); });
  const Scene scene = test::simple_scene(size);
  for (const auto rejection : {Refraction::Rejection::kSnap, Refraction::Rejection::kShorten}) {
    Look look = busy_look();
    look.of<Refraction>().strength = 0.01;
    look.of<Refraction>().rejection = rejection;
    const Plan plan = make_plan(look, test::inputs_of(b.frame, scene));
    FusedRunner runner;
    const auto run = [&](const Picture& picture) {
      runner.run(plan, b.frame, scene, picture.target, *make_executor(1));
    };
    const Picture open(b.frame.work()), closed(b.frame.work());
    b.set(PlaneId::kDepth, [](int x, int y) { return 5 + test::noise(x, y, 7); });
    run(open);
    const auto all = runner.survey().count();
    EXPECT_EQ(runner.survey().summary().open.cells, all);
    b.set(PlaneId::kDepth,
          [](int x, int y) { return x == 250 && y == 30 ? 1 : 5 + test::noise(x, y, 7); });
    run(closed);
    EXPECT_LT(runner.survey().summary().open.cells, all);
    int same = 0, other = 0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        bool alike = true;
        for (int c = 0; c < 3; ++c) {
          const float p = open.target.color[c].at(x, y), q = closed.target.color[c].at(x, y);
          alike = alike && std::memcmp(&p, &q, sizeof p) == 0;
        }
        (alike ? same : other) += 1;
        if (std::abs(x - 250) > 20) {
          EXPECT_TRUE(alike) << x << ", " << y;
        }
      }
    }
    EXPECT_GT(same, 20000);
    EXPECT_GT(other, 0);
  }
}

TEST(Fused, OverscanIsReadAndNotWritten) {
  const Rect display{0, 0, 40, 20}, data{-8, -4, 48, 24};
  Buffers wide = test::noisy_frame(data);
  wide.frame.display = display;
  const Scene scene = test::simple_scene(display.size());
  EXPECT_EQ(wide.frame.work(), display);
  const Picture judge = test::reference(busy_look(), wide.frame, scene);
  const Picture got = test::fused(busy_look(), wide.frame, scene);
  std::size_t far = 0;
  const std::vector<float> a = judge.values(), c = got.values();
  for (std::size_t i = 0; i < a.size(); ++i) far += !(a[i] == c[i] || std::abs(a[i] - c[i]) < 2e-5);
  EXPECT_LE(far, a.size() / 5000);
}

TEST(Fused, OverscanIsKeptAsFarAsAllPlanesHaveIt) {
  const Rect display{0, 0, 40, 20}, data{-8, -4, 48, 24};
  Buffers wide = test::noisy_frame(data);
  wide.frame.display = display;
  const Scene scene = test::simple_scene(display.size());
  const Picture alone = test::fused(busy_look(), wide.frame, scene);
  wide.frame.overscan = 6;
  const Rect work{-6, -4, 46, 24};
  ASSERT_EQ(wide.frame.work(), work);
  const Picture got = test::fused(busy_look(), wide.frame, scene);
  const Picture judge = test::reference(busy_look(), wide.frame, scene);
  std::size_t far = 0;
  for (int y = work.y0; y < work.y1; ++y) {
    for (int x = work.x0; x < work.x1; ++x) {
      far += std::abs(got.color(x, y).g - judge.color(x, y).g) > 2e-5;
      const bool shown = x >= 0 && x < 40 && y >= 0 && y < 20;
      if (!shown) continue;
      EXPECT_EQ(got.color(x, y).g, alone.color(x, y).g) << x << ", " << y;
    }
  }
  EXPECT_LE(far, 4u);
  wide.fill(PlaneId::kShadow, 1);  // of the display window
  EXPECT_EQ(wide.frame.work(), display);
}

TEST(Fused, RefusesWhatItCannotDo) {
  const Size size{4, 4};
  const Buffers b = test::noisy_frame(rect_of(size));
  const Scene scene = test::simple_scene(size);
  EXPECT_THROW(test::fused({}, b.frame, scene, {.simd = "mmx"}), Error);
  EXPECT_THROW(test::fused({}, b.frame, scene, {.tile = {0, 8}}), Error);
  Scene blind = scene;
  blind.camera.reset();
  EXPECT_THROW(test::fused({}, b.frame, blind), Error);
  const Picture apart(b.frame.work());
  Target over = apart.target;
  const View<const float> color = b.frame.plane(PlaneId::kColorR);
  over.color[0] = {const_cast<float*>(color.data), 1, color.y_stride, color.window};
  EXPECT_THROW(run_fused(make_plan({}, test::inputs_of(b.frame, scene)), b.frame, scene, over,
                         *make_executor(1)),
               Error);
  // Offsets of texels are 32 bits wide. An address that far beyond the stack is no target's.
  const std::array<float, 4> row{5, 5, 5, 5};
  Frame huge = b.frame;
  huge.planes[index_of(PlaneId::kDepth)] = {row.data(), 1, std::ptrdiff_t{1} << 29, rect_of(size)};
  try {
    test::fused({}, huge, scene);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "frame: a plane spans 2147483652 floats, expected at most 2^31");
  }
  Picture small(Rect{0, 0, 2, 2});
  EXPECT_THROW(run_fused(make_plan({}, test::inputs_of(b.frame, scene)), b.frame, scene,
                         small.target, *make_executor(1)),
               Error);
  EXPECT_THROW(Plane(Rect{0, 0, 0, 0}), Error);
}

TEST(Fused, APlanThatReadsTexturesNeedsThemWhole) {
  const Size size{4, 4};
  Buffers b = test::noisy_frame(rect_of(size));
  const Scene scene = test::simple_scene(size);
  const Picture picture(b.frame.work());
  Plan plan = make_plan({}, test::inputs_of(b.frame, scene));
  plan.reads_environment = true;
  const auto refusal = [&]() -> std::string {
    try {
      run_reference(plan, b.frame, scene, picture.target);
      run_fused(plan, b.frame, scene, picture.target, *make_executor(1));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(), "frame: the plan looks up an environment, and the frame has none");
  const test::NoiseMap sky(8, 4), other(8, 5);
  b.frame.environment = sky.texture;
  EXPECT_EQ(refusal(), "");
  b.frame.environment.channels[2] = other.texture.channels[2];
  EXPECT_EQ(refusal(), "frame: an environment has channels that are not three of one size");
  plan.reads_environment = false;
  EXPECT_EQ(refusal(), "");
  plan.reads_wave_map = true;
  EXPECT_EQ(refusal(), "frame: the plan looks up a normal map, and the frame has none");
}

TEST(Fused, APlanWithAGlintNeedsASun) {
  const Size size{4, 4};
  const Buffers b = test::noisy_frame(rect_of(size));
  Scene scene = test::simple_scene(size);
  const Picture picture(b.frame.work());
  const Plan plan = make_plan({}, test::inputs_of(b.frame, scene));
  scene.sun.reset();
  EXPECT_THROW(run_reference(plan, b.frame, scene, picture.target), Error);
  Look look;
  look.of<Penetration>().model = Penetration::Model::kViewAngle;  // makes highlights, needs no sun
  const Plan sunless = make_plan(look, test::inputs_of(b.frame, scene));
  EXPECT_NO_THROW(run_reference(sunless, b.frame, scene, picture.target));
}

TEST(Fused, APlanIsForTheScenesPrimariesAlone) {
  const Size size{4, 4};
  const Buffers b = test::noisy_frame(rect_of(size));
  Scene scene = test::simple_scene(size);
  const Plan plan = make_plan({}, test::inputs_of(b.frame, scene));
  scene.primaries = *find_color_space("ACEScg");
  const Picture picture(b.frame.work());
  for (const bool reference : {true, false}) {
    try {
      if (reference) run_reference(plan, b.frame, scene, picture.target);
      if (!reference) run_fused(plan, b.frame, scene, picture.target, *make_executor(1));
      FAIL();
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(),
                   "scene: its primaries are ACEScg, and the plan was made for Rec.709: expected a "
                   "plan for the primaries of the scene");
    }
  }
  const Plan other = make_plan({}, test::inputs_of(b.frame, scene));
  EXPECT_NO_THROW(run_reference(other, b.frame, scene, picture.target));
}

/// An executor of one thread, which a stop reaches after this many of the last tasks.
class StoppedExecutor : public Executor {
 public:
  void run(int count, Task task, void* context) override {
    for (int i = 0; i < count; ++i) {
      if (count == of && i == after) source.request_stop();
      task(context, i);
    }
  }
  int of = 0, after = 0;
  std::stop_source source;
};

/// Of 7 x 5 tiles, those from the third on are unchanged.
TEST(Fused, AStopIsToldAndBeginsNoMoreTiles) {
  const Size size{70, 50};
  const Buffers b = test::noisy_frame(rect_of(size));
  const Scene scene = test::simple_scene(size);
  const Plan plan = make_plan(busy_look(), test::inputs_of(b.frame, scene));
  FusedOptions options{.tile = {10, 10}};
  const Picture untouched(b.frame.work()), picture(b.frame.work()), whole(b.frame.work());
  FusedRunner runner;
  StoppedExecutor executor;
  runner.run(plan, b.frame, scene, whole.target, executor, options);

  executor.of = 35;
  executor.after = 2;
  options.stop = executor.source.get_token();
  EXPECT_THROW(runner.run(plan, b.frame, scene, picture.target, executor, options), Stopped);
  const auto is_as = [&](const Picture& other, int x, int y) {
    return picture.target.color[0].at(x, y) == other.target.color[0].at(x, y);
  };
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) EXPECT_TRUE(is_as(whole, x, y)) << x << " " << y;
  }
  EXPECT_FALSE(is_as(untouched, 5, 5));
  for (int y = 0; y < size.height; ++y) {
    for (int x = y < 10 ? 20 : 0; x < size.width; ++x) EXPECT_TRUE(is_as(untouched, x, y));
  }
  // The stop was requested before the run: no tile begins.
  const Picture second(b.frame.work());
  EXPECT_THROW(runner.run(plan, b.frame, scene, second.target, executor, options), Stopped);
  EXPECT_TRUE(same_bits(second.values(), untouched.values()));
  options.stop = {};
  runner.run(plan, b.frame, scene, picture.target, executor, options);
  EXPECT_TRUE(same_bits(picture.values(), whole.values()));
}

TEST(Fused, SumOfTheFirstFourAovsIsThePicture) {
  const Size size{50, 30};
  const Buffers b = test::noisy_frame(rect_of(size));
  const Scene scene = test::simple_scene(size);
  for (const Picture& p :
       {test::reference(busy_look(), b.frame, scene), test::fused(busy_look(), b.frame, scene)}) {
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        for (int c = 0; c < 3; ++c) {
          const double sum = p.aov(Aov::kTransmitted, x, y, c) + p.aov(Aov::kInScatter, x, y, c) +
                             p.aov(Aov::kReflected, x, y, c) + p.aov(Aov::kHighlight, x, y, c);
          EXPECT_NEAR(sum, p.target.color[c].at(x, y), 1e-6 * (1 + sum));
        }
      }
    }
  }
}

}  // namespace
}  // namespace limpid
