#include <gtest/gtest.h>

#include "op/pass.h"
#include "support.h"

// The mean of the parts of a pixel resolves waves that one sample does not.

namespace limpid {
namespace {

using test::Buffers;
using test::Picture;

constexpr Size kSize{64, 32};

Scene sea() {
  Scene scene = test::simple_scene(kSize);
  scene.camera->view =
      glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0.1, 1.7, -1), glm::dvec3(0, 1, 0));
  scene.water->waves = {{0.02, 0.3, 2.1, 0.3, 0}, {0.012, -1.1, 3.7, 1.7, 0}};
  return scene;
}

/// A reflection that brightens towards the horizon, and black below the water.
Buffers frame_of(const Scene& scene, bool with_surface) {
  Buffers b(rect_of(kSize));
  b.fill(PlaneId::kDepth, test::kInf);
  for (int c = 0; c < 3; ++c) {
    b.fill(plane_after(PlaneId::kColorR, c), 0.2f);
    b.set(plane_after(PlaneId::kReflectionR, c),
          [](int, int y) { return 2 * std::exp(-0.2f * static_cast<float>(y)); });
  }
  if (!with_surface) return b;
  const Pass pass(scene, b.frame, 1.333, {});
  b.set(PlaneId::kSurfaceDepth, [&](int x, int y) {
    return static_cast<float>(RowRays<double>(pass, y + 0.5).calm_depth(x + 0.5));
  });
  return b;
}

Look waves() {
  Look look = test::still_look();
  look.of<WaveNormals>().model = WaveNormals::Model::kSines;
  look.of<WaveNormals>().filter = WaveNormals::Filter::kVariance;
  look.of<WaveNormals>().strength = 1;
  look.of<FresnelReflection>().source = FresnelReflection::Source::kPlanar;
  look.of<FresnelReflection>().facets = FresnelReflection::Facets::kSpread;
  return look;
}

std::vector<double> mean_of_parts(const Frame& frame, Scene scene, int count, bool reference) {
  std::vector<double> mean(static_cast<std::size_t>(kSize.width * kSize.height));
  for (int i = 0; i < count; ++i) {
    scene.part = {i, count};
    const Picture part =
        reference ? test::reference(waves(), frame, scene) : test::fused(waves(), frame, scene);
    for (std::size_t k = 0; k < mean.size(); ++k) {
      const int x = static_cast<int>(k) % kSize.width, y = static_cast<int>(k) / kSize.width;
      mean[k] += part.color(x, y).g / count;
    }
  }
  return mean;
}

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += std::abs(a[k] - b[k]);
  return sum / static_cast<double>(a.size());
}

// On calm water and with the surface of a plate.
TEST(PixelPart, MorePartsComeNearerToTheMeanOfMany) {
  const Scene scene = sea();
  for (const bool with_surface : {false, true}) {
    const Buffers b = frame_of(scene, with_surface);
    const auto truth = mean_of_parts(b.frame, scene, 32, false);
    const double one = apart(mean_of_parts(b.frame, scene, 1, false), truth);
    const double two = apart(mean_of_parts(b.frame, scene, 2, false), truth);
    const double eight = apart(mean_of_parts(b.frame, scene, 8, false), truth);
    EXPECT_GT(one, 0.0005);
    EXPECT_LT(two, one);
    EXPECT_LT(eight, 0.4 * one);
  }
}

TEST(PixelPart, RunnersAgree) {
  const Scene scene = sea();
  for (const bool with_surface : {false, true}) {
    const Buffers b = frame_of(scene, with_surface);
    EXPECT_LT(
        apart(mean_of_parts(b.frame, scene, 3, false), mean_of_parts(b.frame, scene, 3, true)),
        1e-4);
  }
}

}  // namespace
}  // namespace limpid
