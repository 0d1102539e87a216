#include <gtest/gtest.h>

#include "judge/trace/trace_scenes.h"
#include "support.h"

// depth_fog.model = radiative_transfer in views that begin in the water, beside random walks of
// light through a pool of the same water.

namespace limpid::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A view from within water over a level floor; `down` is the angle below the horizon in degrees.
struct Inside {
  double eye = 1, floor = 30;  ///< below the surface
  double down = 30, azimuth = 0;
  double anisotropy = 0;
  Rgb<double> absorption{.22, .3, .7}, scattering{1.5, 1.3, .8};
  Rgb<double> albedo{0, 0, 0}, sun{1, 0.9, 0.8}, sky{0, 0, 0};

  Scene scene(Size size) const {
    const double a = down * kDegree;
    Scene scene;
    const glm::dvec3 at(0, -eye, 0), to(0, -std::sin(a), -std::cos(a));
    const double across = azimuth * kDegree;
    scene.camera =
        Camera{glm::lookAt(at, at + to, glm::dvec3(0, std::cos(a), -std::sin(a))),
               perspective(1e-4, double(size.width) / size.height, 0.01, 1e3, ClipSpace::kGl),
               ClipSpace::kGl};
    scene.water = WaterPlane{};
    scene.sun = Sun{glm::normalize(glm::dvec3(std::sin(across), 1, -std::cos(across))), sun};
    scene.sky = SkyLight{sky};
    return scene;
  }
  Look look() const {
    Look look = calm_look();
    DepthFog::Params& fog = look.of<DepthFog>();
    fog.model = DepthFog::Model::kRadiativeTransfer;
    fog.distance = DepthFog::Distance::kRefracted;
    fog.water_type = WaterType::kCustom;
    fog.absorption = absorption;
    fog.scattering = scattering;
    fog.anisotropy = anisotropy;
    fog.sunlight = DepthFog::Sunlight::kRefracted;
    fog.crossing = DepthFog::Crossing::kRadiance;
    return look;
  }
  Rgb<double> chain() const {
    Buffers buffers(rect_of(Size{1, 1}));
    const Scene one = scene({1, 1});
    const Rgb<double> light = one.sun->direction.y * sun + sky;
    for (int c = 0; c < 3; ++c) {
      buffers.fill(plane_after(PlaneId::kColorR, c),
                   static_cast<float>(channel(albedo, c) * channel(light, c)));
    }
    buffers.fill(PlaneId::kDepth, static_cast<float>((floor - eye) / std::sin(down * kDegree)));
    return reference(look(), buffers.frame, one).color(0, 0);
  }
};

/// Each channel is within a share of the truth plus its noise.
void expect_near(const Inside& view, double share) {
  constexpr Size kSize{12, 10};
  TruthOptions options;
  options.size = kSize;
  options.paths = 300;
  const Model model = model_of({level(-view.floor)}, lambert(view.albedo, view.sky));
  const TruthPicture truth = traced(model, view.scene(kSize), view.look(), options);
  const Rgb<double> got = view.chain();
  for (int c = 0; c < 3; ++c) {
    double sum = 0, squares = 0;
    const double n = kSize.width * kSize.height;
    for_each_pixel(kSize, [&](int x, int y) {
      const double color = truth.target.color[static_cast<std::size_t>(c)].at(x, y);
      sum += color, squares += color * color;
    });
    const double mean = sum / n;
    const double error = std::sqrt(std::max(squares / n - mean * mean, 0.0) / (n - 1));
    EXPECT_NEAR(channel(got, c), mean, share * mean + 3 * error)
        << channel(got, c) / mean << " of channel " << c << ", eye " << view.eye << ", down "
        << view.down << ", azimuth " << view.azimuth << ", g " << view.anisotropy;
  }
}

TEST(InsideWater, IsAsBrightAsPathTraced) {
  for (const double eye : {0.2, 1.0, 3.0}) {
    for (const double down : {10.0, 30.0, 80.0}) {
      expect_near({.eye = eye, .down = down}, 0.06);
    }
  }
}

TEST(InsideWater, ThatScattersForwards) {
  for (const double azimuth : {0.0, 90.0, 180.0}) {
    for (const double down : {10.0, 60.0}) {
      Inside view{.eye = 1, .down = down, .azimuth = azimuth, .anisotropy = 0.8};
      view.scattering = {7.5, 6.5, 4};
      expect_near(view, 0.12);
    }
  }
}

TEST(InsideWater, UnderASkyAlone) {
  for (const double eye : {0.2, 2.0}) {
    expect_near({.eye = eye, .sun = {0, 0, 0}, .sky = {0.4, 0.6, 1}}, 0.06);
  }
}

// The floor receives the light that the water scatters down and the surface reflects back.
TEST(InsideWater, ABottomIsLitAsPathTraced) {
  Inside clear{.eye = 1, .floor = 2, .down = 45, .albedo = {.6, .6, .6}, .sky = {.2, .3, .5}};
  clear.absorption = {.05, .1, .2};
  clear.scattering = {0, 0, 0};
  expect_near(clear, 0.02);
  clear.scattering = {.2, .1, .05};
  expect_near(clear, 0.15);
}

// The floor's own light is scattered into the view; a dark floor takes light away.
TEST(InsideWater, BetweenSurfaceAndBottomIsAsBrightAsPathTraced) {
  for (const double albedo : {0.0, 0.3, 0.8}) {
    for (const double scatters : {0.3, 2.0}) {
      for (const double down : {10.0, 50.0}) {
        Inside view{.eye = 0.8, .floor = 2, .down = down, .sky = {.1, .2, .3}};
        view.albedo = {albedo, albedo, albedo};
        view.absorption = {.05, .2, .6};
        view.scattering = {scatters, scatters, scatters};
        expect_near(view, 0.06);
        view.anisotropy = 0.85;
        expect_near(view, 0.1);
      }
    }
  }
}

}  // namespace
}  // namespace limpid::test
