#include "complete/caustics_mirrored.h"

#include "complete/caustics_basin.h"

// The caustics on a bottom that is mirrored in the water's surface, seen from below.

namespace limpid::test {
namespace {

/// The camera looks straight up from 20 cm under the water, which mirrors a level bottom: x runs to
/// the right, y down in the picture.
Basin from_below(double deep) {
  Basin basin;
  basin.deep = [=](double, double) { return deep; };
  basin.make();
  basin.scene.camera->view =
      glm::lookAt(glm::dvec3(0, -0.2, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1));
  basin.buffers.fill(PlaneId::kDepth, kInf);
  basin.buffers.fill(PlaneId::kReflectionDepth, static_cast<float>(0.2 + deep));
  for (int c = 0; c < 3; ++c) basin.buffers.fill(plane_after(PlaneId::kReflectionR, c), 0.5f);
  return basin;
}

Pass pass_of(const Basin& basin) {
  return Pass(basin.scene, basin.buffers.frame, kIor, kWholeState, basin.swell());
}

TEST(MirroredCaustics, AreLightThatIsFollowedToABottomThatNothingElseShows) {
  for (const double deep : {0.5, 1.5}) {
    const Basin basin = from_below(deep);
    CausticsMaker maker;
    const WaveNormals::Params params = basin.params();
    const CausticsTable& table =
        *maker.make(&params, {0, 0, 0}, basin.buffers.frame, pass_of(basin), *make_executor(1));
    ASSERT_GT(table.count, 0);
    const Beside b =
        beside(followed(basin), of_table(basin, table), [](double, double) { return true; });
    EXPECT_LE(b.error, 0.08) << deep;
    EXPECT_LE(b.error, 0.2 * b.contrast) << deep;
    EXPECT_NEAR(b.table_energy / b.energy, 1, 0.005) << deep;
  }
}

/// The light of a table of 1.5 + x / 4 along map_x on a reflection of 0.5.
struct Lit {
  Basin basin = from_below(1.5);
  Caustics::Params params{.strength = 1, .sun_share = 1};
  CausticsTable table;
  Plane ramp{rect_of({64, 64})};
  MirroredCaustics mirrored;

  Lit() {
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) ramp.view().at(x, y) = static_cast<float>(1.5 + (x - 32) / 4.0);
    }
    table.count = 1;
    table.levels[0] = {ramp.view(), {-32, -32}, 1};
  }
  Frame frame() {
    Frame frame = basin.buffers.frame;
    mirrored.light(params, table, pass_of(basin), *make_executor(2), frame);
    return frame;
  }
  double green(int x, int y) { return frame().plane(PlaneId::kReflectionG).at(x, y); }
  /// The table's light at the point whose image this column shows.
  double focused(int x) const {
    const glm::dvec3& sun = basin.scene.sun->direction;
    const double aside = 1.5 * aside_of({sun.x, -sun.z, sun.y}).x;
    return 1.5 + (Basin::at(x) - aside) / 4;
  }
};

TEST(MirroredCaustics, AreLookedUpWhereLightEntersToThePointWhoseImageIsSeen) {
  Lit lit;
  for (const int x : {3, 96, 180}) {
    EXPECT_NEAR(lit.green(x, 40), 0.5 * lit.focused(x), 1e-6) << x;
    EXPECT_NEAR(lit.green(x, 120), 0.5 * lit.focused(x), 1e-6) << x;
  }
  lit.params.strength = 0.5, lit.params.sun_share = 0.4;
  EXPECT_NEAR(lit.green(96, 40), 0.5 * (1 + 0.2 * (lit.focused(96) - 1)), 1e-6);
  lit.table.scattered = {0, 0.7, 0};
  EXPECT_NEAR(lit.green(96, 40), 0.5 * (1 + 0.2 * std::exp(-0.7 * 1.5) * (lit.focused(96) - 1)),
              1e-6);
}

// The picture shows the point that a column mirrors, 1.5 m deep, and whether the point is in
// shadow.
TEST(MirroredCaustics, LeaveWhatThePictureShowsInShadow) {
  Lit lit;
  lit.basin.scene.camera->view =
      glm::lookAt(glm::dvec3(0, -0.2, 0), glm::dvec3(0, -0.2, -1), glm::dvec3(0, 1, 0));
  lit.basin.scene.camera->projection = orthographic(4, 4, 0.1, 50, ClipSpace::kGl);
  lit.basin.buffers.fill(PlaneId::kShadow, 0.25f);
  // A row with level rays, 1.3 above the eye, at an image 2 away: the point lies 1.3 - 0.2 deep,
  // right under its image.
  lit.basin.buffers.fill(PlaneId::kReflectionDepth, 2);
  lit.basin.buffers.fill(PlaneId::kDepth, 2);
  const int row = 33;
  const double high = 4 * (0.5 - (row + 0.5) / kSide) - 0.2;
  lit.basin.buffers.set(PlaneId::kReflectionDepth, [=](int, int y) { return y == row ? 2 : kInf; });
  const double aside =
      high * aside_of({lit.basin.scene.sun->direction.x, -lit.basin.scene.sun->direction.z,
                       lit.basin.scene.sun->direction.y})
                 .x;
  const double x = 4 * ((96 + 0.5) / kSide - 0.5), focused = 1.5 + (x - aside) / 4;
  lit.params.sun_share = 0.8;
  lit.params.sunlight = Caustics::Sunlight::kStraight;
  EXPECT_EQ(lit.green(96, row + 1), 0.5);
  EXPECT_NEAR(lit.green(96, row), 0.5 * (1 + 0.2 / 0.4 * (focused - 1)), 1e-6);
  lit.basin.buffers.fill(PlaneId::kDepth, 1.5f);  // an object before the point
  EXPECT_NEAR(lit.green(96, row), 0.5 * (1 + 0.8 * (focused - 1)), 1e-6);
  lit.basin.buffers.fill(PlaneId::kDepth, 2);
  for (int c = 0; c < 3; ++c) lit.basin.buffers.fill(plane_after(PlaneId::kSunColorR, c), 0.3f);
  EXPECT_NEAR(lit.green(96, row), 0.5 * (1 + 0.6 * (focused - 1)), 1e-6);
}

// The light of the point in the middle of the picture enters through the surface; a column of this
// surface towards the sun is in shadow.
TEST(MirroredCaustics, LeaveThatToWhichTheSurfaceLetsNoLightIn) {
  Lit lit;
  const glm::dvec3& sun = lit.basin.scene.sun->direction;
  const double aside = 1.5 * aside_of({sun.x, -sun.z, sun.y}).x;
  const int enters = 60 + static_cast<int>(std::floor(-aside / kCell + 0.5));
  lit.basin.buffers.set(PlaneId::kSurfaceShadow,
                        [=](int x, int) { return std::abs(x - enters) < 3 ? 0.0f : 1.0f; });
  EXPECT_EQ(lit.green(60, 96), 0.5);
  EXPECT_NEAR(lit.green(70, 96), 0.5 * lit.focused(70), 1e-6);
}

TEST(MirroredCaustics, AreNoneFromTheAirAndWithoutADepth) {
  const auto untouched = [](Lit& lit) {
    return lit.frame().plane(PlaneId::kReflectionG).data ==
           lit.basin.buffers.frame.plane(PlaneId::kReflectionG).data;
  };
  Lit lit;
  EXPECT_FALSE(untouched(lit));
  lit.params.strength = 0;
  EXPECT_TRUE(untouched(lit));
  Lit calm;
  calm.table.count = 0;
  EXPECT_TRUE(untouched(calm));
  Lit flat;
  flat.basin.buffers.frame.planes[index_of(PlaneId::kReflectionDepth)] = {};
  EXPECT_TRUE(untouched(flat));
  Lit above;
  above.basin.scene.water->height = -1;
  EXPECT_TRUE(untouched(above));
}

}  // namespace
}  // namespace limpid::test
