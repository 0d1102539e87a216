#include "job/picture_warnings.h"

#include <gmock/gmock.h>

#include "support.h"

// Warnings of mistakes that need other frames than the plate of the tool's tests.

namespace limpid {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Size kSize{64, 48};

/// A level view over a bottom, towards a sun 10 degrees high, with a reflection.
struct Evening {
  test::Buffers buffers{rect_of(kSize)};
  Scene scene;
  Look look;

  Evening() {
    Camera camera;
    camera.view = glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 2, -1), glm::dvec3(0, 1, 0));
    camera.projection = perspective(1, 4.0 / 3, 0.1, 1e3, ClipSpace::kGl);
    scene.camera = camera;
    scene.water = WaterPlane{};
    const double high = 10 * std::numbers::pi / 180;
    scene.sun = Sun{{0, std::sin(high), -std::cos(high)}, {3, 3, 3}};
    for (int i = 0; i < 3; ++i) {
      buffers.fill(plane_after(PlaneId::kColorR, i), 0.5f);
      buffers.fill(plane_after(PlaneId::kReflectionR, i), 2);
    }
    buffers.set(PlaneId::kDepth, [&](int x, int y) {
      const glm::dvec3 ray = rays_of(camera, {kSize.width, kSize.height}).ray_at(x + 0.5, y + 0.5);
      return ray.y < 0 ? static_cast<float>(-3 / ray.y) : test::kInf;
    });
    look.of<WaveNormals>().model = WaveNormals::Model::kSines;
    look.of<FresnelReflection>().source = FresnelReflection::Source::kAuto;
  }
  std::vector<std::string> warnings() const {
    std::vector<std::string> sentences;
    const Plan plan =
        make_plan(look, {.planes = buffers.frame.present(), .wave_map = true, .sun = true});
    warn_of_picture(plan, buffers.frame, scene, sentences);
    return sentences;
  }
};

TEST(PictureWarnings, TheSunsDiscIsSeenTwice) {
  Evening evening;
  EXPECT_THAT(evening.warnings(), IsEmpty());
  // As far below the horizon as the sun is above it.
  const int row = static_cast<int>(24 + 24 * std::tan(10 * std::numbers::pi / 180) / std::tan(0.5));
  const auto disc_at = [&](int y0) {
    evening.buffers.set(PlaneId::kReflectionR,
                        [=](int x, int y) { return x == 32 && y == y0 ? 4e4f : 2.0f; });
  };
  disc_at(row);
  EXPECT_THAT(evening.warnings(), ElementsAre(HasSubstr("the reflection shows the sun's disc")));
  disc_at(row + 12);
  EXPECT_THAT(evening.warnings(), IsEmpty());
}

TEST(PictureWarnings, WhatHidesALowSunIsOutOfThePicture) {
  const auto unseen = testing::Contains(HasSubstr("the sun is 10 degrees high and outside of"));
  Evening evening;
  evening.look.of<SunHighlight>().model = SunHighlight::Model::kSlopes;
  EXPECT_THAT(evening.warnings(), testing::Not(unseen));  // the sun is in the picture
  evening.scene.camera->view =
      glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 1, -1), glm::dvec3(0, 1, 0));
  const Rays rays = rays_of(*evening.scene.camera, {kSize.width, kSize.height});
  evening.buffers.set(PlaneId::kDepth, [&](int x, int y) {
    return y < 4 ? 1 : static_cast<float>(-3 / rays.ray_at(x + 0.5, y + 0.5).y);
  });
  EXPECT_THAT(evening.warnings(), unseen);
  const glm::dvec3 low = evening.scene.sun->direction;
  evening.scene.sun->direction = {low.z, low.y, 0};  // the glint lies far outside the picture
  EXPECT_THAT(evening.warnings(), testing::Not(unseen));
  evening.scene.sun->direction = {0, 0.6, -0.8};
  EXPECT_THAT(
      evening.warnings(),
      testing::Not(testing::Contains(HasSubstr("degrees high and outside of the picture"))));
  evening.scene.sun->direction = low;
  evening.buffers.fill(PlaneId::kSurfaceShadow, 1);
  EXPECT_THAT(evening.warnings(), testing::Not(unseen));
}

// The warning gives the share of a pane of ten columns; a blurred edge of two causes no warning.
TEST(PictureWarnings, GlassIsTakenForOpaque) {
  Evening evening;
  const auto pane = [&](int columns, float alpha) {
    evening.buffers.set(PlaneId::kColorA, [=](int x, int y) {
      return x >= 20 && x < 20 + columns && y > 26 ? alpha : 1.0f;
    });
  };
  pane(10, 0.5f);
  // 8 x 19 inner pixels of 62 x 46.
  EXPECT_THAT(evening.warnings(), ElementsAre(HasSubstr("5.3 % of the pixels are transparent")));
  pane(2, 0.5f);
  EXPECT_THAT(evening.warnings(), IsEmpty());
  pane(10, 1);
  EXPECT_THAT(evening.warnings(), IsEmpty());
  pane(10, 0);
  EXPECT_THAT(evening.warnings(), IsEmpty());
  std::vector<std::string> of_deep;
  warn_of_deep_glass(0.0005, of_deep);
  EXPECT_THAT(of_deep, IsEmpty());
  warn_of_deep_glass(0.25, of_deep);
  EXPECT_THAT(of_deep, ElementsAre(HasSubstr("25.0 % of the wet pixels show objects under")));
}

TEST(PictureWarnings, WavesOverTheCamera) {
  Evening evening;
  evening.look.of<WaveNormals>().strength = 1;
  evening.look.of<WaveNormals>().waves = {{1.5, 0.1, 0, 0, 0}};
  EXPECT_THAT(evening.warnings(), IsEmpty());
  evening.look.of<WaveNormals>().waves.push_back({1.5, 0, 0.1, 0, 0});
  EXPECT_THAT(evening.warnings(), testing::Contains(HasSubstr("the waves reach 3")));
}

TEST(PictureWarnings, WavesOverALevelSurface) {
  Evening evening;
  evening.look.of<WaveNormals>().strength = 1;
  evening.look.of<WaveNormals>().waves = {{0.1, 1, 0.5, 0, 0}};
  const auto surface = [&](double raised) {
    evening.buffers.set(PlaneId::kSurfaceDepth, [&](int x, int y) {
      const Rays rays = rays_of(*evening.scene.camera, {kSize.width, kSize.height});
      const double down = -rays.ray_at(x + 0.5, y + 0.5).y;
      const double height = raised * std::sin(0.7 * x + 1.3 * y);
      return down > 0 ? static_cast<float>((2 - height) / down) : test::kInf;
    });
  };
  EXPECT_THAT(evening.warnings(), IsEmpty());
  surface(0);
  EXPECT_THAT(evening.warnings(), ElementsAre(HasSubstr("the surface_depth is level")));
  surface(0.1);
  EXPECT_THAT(evening.warnings(), IsEmpty());
  surface(0);
  evening.look.of<WaveNormals>().model = WaveNormals::Model::kFourMaps;
  EXPECT_THAT(evening.warnings(), testing::Not(testing::Contains(HasSubstr("level"))));
}

TEST(PictureWarnings, WavesOfTheSceneBesideAMap) {
  Evening evening;
  const auto unread = testing::Contains(HasSubstr("the waves of the scene change nothing"));
  WaveNormals::Params& waves = evening.look.of<WaveNormals>();
  evening.scene.water->waves = {{0.01, 3, 0, 0, 0}};
  EXPECT_THAT(evening.warnings(), testing::Not(unread));
  waves.model = WaveNormals::Model::kSlopes;
  EXPECT_THAT(evening.warnings(), unread);
  waves.strength = 0;  // calm water was asked for
  EXPECT_THAT(evening.warnings(), testing::Not(unread));
  waves.strength = 1;
  evening.scene.water->waves.clear();
  EXPECT_THAT(evening.warnings(), testing::Not(unread));
}

/// An orthographic camera that looks straight down on 64 x 48 of calm water, with normals in the
/// frame, 4 above a bottom; the cosine of the sun's angle from the vertical is 0.6: on its path
/// down the light moves 3 sideways.
struct Noon : Evening {
  Noon() {
    Camera camera;
    camera.view = glm::lookAt(glm::dvec3(0, 10, 0), glm::dvec3(0, 0, 0), glm::dvec3(0, 0, -1));
    camera.projection = orthographic(64, 48, 0.1, 50, ClipSpace::kGl);
    scene.camera = camera;
    scene.sun = Sun{.direction = {0.8, 0.6, 0}};
    look.of<WaveNormals>() = {};
    look.of<WaveNormals>().model = WaveNormals::Model::kPlate;
    look.of<Caustics>().strength = 1;
    for (int i = 0; i < 3; ++i) {
      buffers.fill(plane_after(PlaneId::kSurfaceNormalX, i), i == 1 ? 1.0f : 0.0f);
    }
    lie(4);
  }
  /// The bottom, with a stone that rises above the water.
  void lie(float deep) {
    buffers.set(PlaneId::kDepth, [=](int x, int y) { return x < 2 && y < 2 ? 9 : 10 + deep; });
  }
};

TEST(PictureWarnings, LightEntersBeyondTheFramesNormals) {
  const auto beyond = testing::Contains(HasSubstr("enters beyond the normals of the picture"));
  Noon noon;
  EXPECT_THAT(noon.warnings(), testing::Not(beyond));  // 3 of 64 columns
  noon.lie(16);                                        // 12 of 64
  EXPECT_THAT(noon.warnings(),
              testing::Contains(HasSubstr("the sunlight of 19 % of the bottom enters beyond")));
  noon.scene.water->waves = {{0.01, 1, 0, 0, 1}};
  EXPECT_THAT(noon.warnings(), testing::Not(beyond));
  noon.scene.water->waves.clear();
  noon.look.of<Caustics>() = {.strength = 0, .sunlight = Caustics::Sunlight::kStraight};
  EXPECT_THAT(noon.warnings(), testing::Not(beyond));
}

TEST(PictureWarnings, DepthsOfHalfPrecisionTellNoSlopes) {
  const auto coarse = testing::Contains(HasSubstr("too coarse to tell slopes"));
  Noon noon;
  EXPECT_THAT(noon.warnings(), testing::Not(coarse));  // nothing shows the sun's light
  for (int i = 0; i < 3; ++i) noon.buffers.fill(plane_after(PlaneId::kSunColorR, i), 0.3f);
  EXPECT_THAT(noon.warnings(), coarse);
  noon.lie(4.01f);
  EXPECT_THAT(noon.warnings(), testing::Not(coarse));
  noon.lie(4);
  noon.look.of<Caustics>().sunlight = Caustics::Sunlight::kStraight;
  EXPECT_THAT(noon.warnings(), testing::Not(coarse));
}

}  // namespace
}  // namespace limpid
