#include "complete/surroundings.h"

#include <gtest/gtest.h>

#include "complete/completer.h"
#include "complete/shore.h"

// The light of the sky and of the surfaces around that falls on the water.

namespace limpid {
namespace {

using test::kInf;
using test::Shore;

constexpr double kSky = 1;

/// The light on the water before a wall of a radiance.
double light(const Shore& shore, double closed = 0) {
  const Pass pass(shore.scene, shore.buffers.frame, 1.333, kWholeState);
  const Rgb<double> all =
      surroundings(shore.buffers.frame, pass, {kSky, kSky, kSky}, closed, *make_executor(2));
  EXPECT_EQ(all.r, all.g);
  return all.r;
}

Shore wall(double top, float radiance) {
  Shore shore;
  shore.top = top;
  shore.buffers.set(PlaneId::kDepth, [&](int x, int y) { return shore.dry_depth(x, y); });
  for (const PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB}) {
    shore.buffers.fill(id, radiance);
  }
  return shore;
}

TEST(Surroundings, OfTheOpenSeaAreTheSky) { EXPECT_EQ(light(wall(0, 0.25f)), kSky); }

TEST(Surroundings, AWallHidesSkyAsItIsHigh) {
  double before = kSky;
  for (const double top : {1.0, 3.0, 6.0, 10.0}) {
    const double now = light(wall(top, 0));
    EXPECT_LT(now, before) << top;
    before = now;
  }
  // A low wall across half of all directions hides about (h / d)^2 / 4 of the light. The picture
  // shows 67 of these 180 degrees, the rest counts half, and the water lies 3 to 20 before the
  // wall.
  const double low = kSky - light(wall(1, 0));
  EXPECT_GT(low, 0.25 / 400 / 2);
  EXPECT_LT(low, 0.25 / 9);
}

TEST(Surroundings, AWallSendsItsLight) {
  const double dark = light(wall(6, 0)), half = light(wall(6, 0.5f)), bright = light(wall(6, 3));
  EXPECT_LT(dark, half);
  EXPECT_LT(half, kSky);
  EXPECT_GT(bright, kSky);
  EXPECT_NEAR(half - dark, (bright - dark) / 6, 1e-6);
  EXPECT_NEAR(light(wall(6, 1)), kSky, 1e-6);
}

TEST(Surroundings, OfARoomAreItsWalls) {
  // The wall fills the picture above the water.
  const Shore room = wall(1e3, 0.25f);
  EXPECT_GT(light(room), 0.4);
  EXPECT_NEAR(light(room, 1), 0.25, 0.1);
  EXPECT_EQ(light(wall(0, 0), 1), kSky);  // no surface tells how bright a wall would be
}

/// Light is never less than none, whatever stands before a wall that the picture cuts.
TEST(Surroundings, PillarsBeforeAWallHideNoMoreThanAll) {
  Shore room = wall(1e3, 0);
  room.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    return x % 8 < 2 && y < 36 ? std::min(10.0f, room.dry_depth(x, y)) : room.dry_depth(x, y);
  });
  for (const double closed : {0.0, 0.5, 1.0}) EXPECT_GE(light(room, closed), 0) << closed;
}

TEST(Surroundings, APostHidesLittle) {
  Shore shore = wall(0, 0);
  shore.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    return x >= 30 && x < 32 && y < 34 ? 10.0f : shore.dry_depth(x, y);
  });
  EXPECT_LT(light(shore), kSky);
  EXPECT_GT(light(shore), 0.985 * kSky);
}

TEST(Surroundings, WhereNothingWasHitThereIsNoSurface) {
  for (const float nothing : {0.0f, -1.0f}) {
    Shore shore = wall(0, 0.25f);
    shore.buffers.set(PlaneId::kDepth, [&](int x, int y) {
      const float depth = shore.dry_depth(x, y);
      return depth < kInf ? depth : nothing;
    });
    EXPECT_EQ(light(shore), kSky);
  }
}

TEST(Surroundings, ACableHidesLittle) {
  Shore shore = wall(0, 0);
  const auto hidden_by = [&](int rows) {
    shore.buffers.set(PlaneId::kDepth, [&](int x, int y) {
      return y >= 10 && y < 10 + rows ? 8.0f : shore.dry_depth(x, y);
    });
    return kSky - light(shore);
  };
  const double cable = hidden_by(1), crown = hidden_by(10);
  EXPECT_GT(crown, 0.05);
  EXPECT_LT(cable, 0.3 * crown);
}

TEST(Surroundings, AreTheSkyFromBelowAndWithoutColors) {
  Shore shore = wall(6, 0);
  shore.scene.water->height = 10;
  EXPECT_EQ(light(shore), kSky);
  shore.scene.water->height = 0;
  EXPECT_LT(light(shore), kSky);
  shore.buffers.frame.planes[index_of(PlaneId::kColorG)] = {};
  EXPECT_EQ(light(shore), kSky);
}

TEST(Surroundings, ColorsThatAreNoneAreBlack) {
  const double dark = light(wall(6, 0));
  for (const float color : {-1.0f, kInf, std::nanf("")}) EXPECT_EQ(light(wall(6, color)), dark);
}

/// The albedo of a bottom before a black wall, in a picture without sky: what the surroundings
/// leave of a scene's sky lights it, and all of a look's ambient.
TEST(Surroundings, AnAmbientLightsTheBottomAsItIs) {
  const auto albedo = [](bool has_sky, double top) {
    Shore shore;
    shore.far = 5, shore.top = top, shore.deep = 1;
    shore.scene.camera->view = glm::lookAt(glm::dvec3(0, 2, 0), {0, 1.3, -1}, {0, 1, 0});
    shore.buffers.set(PlaneId::kDepth, [&](int x, int y) { return shore.dry_depth(x, y); });
    const Size size = Shore::kSize;
    for (int c = 0; c < 3; ++c) {
      shore.buffers.set(plane_after(PlaneId::kColorR, c),
                        [&](int x, int y) { return shore.dry_depth(x, y) < 5 ? 0.1f : 0; });
    }
    if (has_sky) shore.scene.sky = SkyLight{{kSky, kSky, kSky}};
    shore.buffers.fill(PlaneId::kShadow, 1);
    shore.scene.sun.emplace();
    shore.scene.sun->color = {0, 0, 0};
    Look look;
    DepthFog::Params& water = look.of<DepthFog>();
    water.model = DepthFog::Model::kRadiativeTransfer;
    water.scattering = {0.2, 0.2, 0.2};
    water.ambient = {kSky, kSky, kSky};
    const Frame& frame = shore.buffers.frame;
    const Plan plan = make_plan(look, test::inputs_of(frame, shore.scene));
    EXPECT_TRUE(plan.completed.covers(kAlbedoPlanes));
    Completer completer;
    const Pass pass(shore.scene, frame, look.water.ior, plan.made);
    return completer.complete(plan, frame, pass, *make_executor(1))
        .plane(PlaneId::kAlbedoG)
        .at(size.width / 2, size.height - 2);
  };
  EXPECT_GT(albedo(true, 12), 1.05f * albedo(true, 0));
  EXPECT_EQ(albedo(false, 12), albedo(false, 0));
}

}  // namespace
}  // namespace limpid
