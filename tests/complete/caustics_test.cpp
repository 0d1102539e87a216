#include "complete/caustics_basin.h"
#include "sanitized.h"

namespace limpid::test {
namespace {

const auto kAll = [](double, double) { return true; };

// Errors are over the light of calm water, root mean square, after a blur of both by two pixels.

TEST(Caustics, OnAFlatBottomAreLightThatIsFollowed) {
  for (const double deep : {0.3, 1.0, 5.0}) {
    for (const double sun : {20.0, 40.0, 60.0}) {
      if (kSanitized && (deep != 1 || sun != 40)) continue;  // the other cases take minutes
      for (const double slope : {0.035, 0.12}) {
        Basin basin;
        basin.deep = [=](double, double) { return deep; };
        basin.sun_height = sun, basin.slope = slope;
        const Beside b = judge(basin, kAll);
        EXPECT_LE(b.error, 0.08) << deep << " " << sun << " " << slope;
        EXPECT_LE(b.error, 0.2 * b.contrast) << deep << " " << sun << " " << slope;
        EXPECT_NEAR(b.table_energy / b.energy, 1, 0.005) << deep << " " << sun << " " << slope;
      }
    }
  }
}

// Long waves hardly focus light: a ray for four texels has a smaller error than a ray for each.
TEST(Caustics, OfLongWavesAreLightThatIsFollowed) {
  for (const double deep : {0.3, 1.0}) {
    for (const double sun : {20.0, 40.0, 60.0}) {
      if (kSanitized && (deep != 1 || sun != 40)) continue;
      Basin basin;
      basin.deep = [=](double x, double y) { return deep + 0.1 * x - 0.05 * y; };
      basin.sun_height = sun, basin.slope = 0.035, basin.longer = 5;
      const Beside b = judge(basin, kAll);
      EXPECT_LE(b.error, 0.004) << deep << " " << sun;
      EXPECT_LE(b.error, 0.12 * b.contrast) << deep << " " << sun;
      EXPECT_NEAR(b.table_energy / b.energy, 1, 0.005) << deep << " " << sun;
    }
  }
}

// The sun is so low that waves let in more or less of its light, and that its rays graze their
// backs.
TEST(Caustics, OfALowSunAreLightThatIsFollowed) {
  for (const double deep : {0.5, 2.0}) {
    for (const double sun : {10.0, 15.0}) {
      if (kSanitized && (deep != 2 || sun != 10)) continue;
      for (const double slope : {0.035, 0.07}) {
        Basin basin;
        basin.deep = [=](double, double) { return deep; };
        basin.sun_height = sun, basin.slope = slope;
        const Beside b = judge(basin, kAll);
        EXPECT_LE(b.error, 0.08) << deep << " " << sun << " " << slope;
        EXPECT_LE(b.error, 0.2 * b.contrast) << deep << " " << sun << " " << slope;
        EXPECT_NEAR(b.table_energy / b.energy, 1, 0.005) << deep << " " << sun << " " << slope;
      }
    }
  }
}

// Maps have no height, and their slopes lie between texels; the frame's normals end with the
// picture.
TEST(Caustics, OfMapsAndNormalsAreLightThatIsFollowed) {
  for (const Told told : {Told::kByMap, Told::kBySlopesOfMap, Told::kByNormals}) {
    for (const double sun : {10.0, 40.0}) {
      if (kSanitized && sun != 40) continue;
      Basin basin;
      basin.deep = [](double, double) { return 1.0; };
      basin.sun_height = sun, basin.slope = 0.06, basin.told = told;
      const Beside b = judge(basin, kAll);
      EXPECT_LE(b.error, 0.08) << static_cast<int>(told) << " " << sun;
      EXPECT_LE(b.error, 0.2 * b.contrast) << static_cast<int>(told) << " " << sun;
      EXPECT_NEAR(b.table_energy / b.energy, 1, 0.005) << static_cast<int>(told) << " " << sun;
    }
  }
}

TEST(Caustics, OnASlopeAreLightThatIsFollowed) {
  for (const double sun : {20.0, 40.0, 60.0}) {
    if (kSanitized && sun != 40) continue;
    Basin basin;
    basin.deep = [](double x, double y) { return 1.2 + 0.4 * x - 0.2 * y; };
    basin.sun_height = sun;
    const Beside b = judge(basin, kAll);
    EXPECT_LE(b.error, 0.12) << sun;
    EXPECT_NEAR(b.table_energy / b.energy, 1, 0.005) << sun;
  }
}

// Cells within 15 cm of the cliff, and of its shadow's end, are judged.
TEST(Caustics, BesideACliffAreLightThatIsFollowed) {
  const double upper = 0.8, lower = 1.6;
  for (const double sun : {20.0, 40.0, 60.0}) {
    if (kSanitized && sun != 40) continue;
    for (const double turn : {60.0, 120.0}) {  // sun onto the cliff's wall, and from behind
      const double rise = std::sin(sun * std::numbers::pi / 180);
      const double level = std::sqrt(1 - rise * rise) * std::cos(turn * std::numbers::pi / 180);
      const double shadow = std::max((lower - upper) * aside_of({level, 0, rise}).x, 0.0);
      Basin basin;
      basin.deep = [=](double x, double) { return x < 0 ? upper : lower; };
      basin.sun_height = sun, basin.sun_turn = turn, basin.cliff = true;
      const Beside b = judge(
          basin, [=](double x, double) { return x > -0.15 && x < 0.15 && (x < 0 || x > shadow); });
      EXPECT_LE(b.error, 0.05) << sun << " " << turn;
      EXPECT_NEAR(b.table_energy / b.energy, 1, 0.006) << sun << " " << turn;
      if (shadow == 0) continue;
      const Beside end =
          judge(basin, [=](double x, double) { return x > shadow && x < shadow + 0.15; });
      EXPECT_LE(end.error, 0.2) << sun << " " << turn;
    }
  }
}

// A pattern that stands still in moving light would be seen, and so would a jump.
TEST(Caustics, MoveAsLightDoes) {
  LightMap last_truth, last_table;
  double moved = 0, table_moved = 0;
  for (int frame = 0; frame < (kSanitized ? 2 : 25); ++frame) {
    Basin basin;
    basin.slope = 0.06, basin.time = frame / 24.0;
    CausticsMaker maker;
    const CausticsTable table = table_of(basin, maker);
    const LightMap truth = blurred(followed(basin)), of_maker = blurred(of_table(basin, table));
    for (int y = kBorder; frame > 0 && y < kSide - kBorder; ++y) {
      for (int x = kBorder; x < kSide - kBorder; ++x) {
        const auto i = static_cast<std::size_t>(y * kSide + x);
        moved += std::pow(truth[i] - last_truth[i], 2);
        table_moved += std::pow(of_maker[i] - last_table[i], 2);
      }
    }
    last_truth = truth, last_table = of_maker;
  }
  EXPECT_NEAR(std::sqrt(table_moved / moved), 1, 0.05);
}

TEST(Caustics, AreTheSameForAnyNumberOfThreads) {
  Basin basin;
  CausticsMaker one, four;
  const CausticsTable a = table_of(basin, one), b = table_of(basin, four, 4);
  ASSERT_EQ(a.count, b.count);
  EXPECT_EQ(a.most, b.most);
  for (int i = 0; i < a.count; ++i) {
    const auto level = static_cast<std::size_t>(i);
    const View<const float>&x = a.levels[level].light, &y = b.levels[level].light;
    ASSERT_EQ(x.window, y.window);
    for (int row = 0; row < x.window.height(); ++row) {
      ASSERT_TRUE(std::equal(x.row(row), x.row(row) + x.window.width(), y.row(row)));
    }
  }
}

TEST(Caustics, AreNoneWithoutSunOrWaves) {
  const auto levels = [](const auto& change) {
    Basin basin;
    change(basin);
    CausticsMaker maker;
    return table_of(basin, maker).count;
  };
  EXPECT_GT(levels([](Basin&) {}), 0);
  EXPECT_EQ(levels([](Basin& b) { b.slope = 0; }), 0);
  EXPECT_EQ(levels([](Basin& b) { b.sun_height = -5; }), 0);
  EXPECT_EQ(levels([](Basin& b) { b.sun_height = 0; }), 0);
  EXPECT_EQ(levels([](Basin& b) { b.deep = [](double, double) { return 1e-6; }; }), 0);
  EXPECT_EQ(levels([](Basin& b) { b.deep = [](double, double) { return -1.0; }; }), 0);
  EXPECT_EQ(levels([](Basin& b) { b.deep = [](double, double) { return HUGE_VAL; }; }), 0);
}

// The steepest waves that parameters allow: the light is finite.
TEST(Caustics, OfWavesThatFoldLightManyTimesAreFinite) {
  for (const double slope : {1.0, 30.0}) {
    for (const double sun : {1.0, 45.0, 90.0}) {
      Basin basin;
      basin.slope = slope, basin.sun_height = sun;
      CausticsMaker maker;
      const CausticsTable table = table_of(basin, maker);
      EXPECT_TRUE(std::isfinite(table.most));
      for (const double value : of_table(basin, table)) {
        ASSERT_TRUE(std::isfinite(value) && value >= 0) << slope << " " << sun;
      }
    }
  }
}

}  // namespace
}  // namespace limpid::test
