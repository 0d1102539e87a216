#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "limpid/files/text/look_file.h"
#include "limpid/plate/texture.h"

#include "op/pass.h"
#include "paths.h"
#include "support.h"

namespace limpid {
namespace {

using Filter = WaveNormals::Filter;
using Model = WaveNormals::Model;
using test::Buffers;
using test::Picture;

/// A camera 2 above open water that looks to the horizon.
Scene sea(Size size) {
  Scene scene = test::simple_scene(size);
  scene.camera->view =
      glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0.3, 1.8, -1), glm::dvec3(0, 1, 0));
  scene.time = 4.1;
  return scene;
}

/// A sky that brightens towards the horizon, above and in the mirror, and a bottom 40 % farther
/// than the water.
Buffers sea_frame(Size size, const Scene& scene) {
  Buffers b(rect_of(size));
  b.fill(PlaneId::kColorR, 0).fill(PlaneId::kDepth, test::kInf);
  const Pass pass(scene, b.frame, 1.33, {});
  const auto water = [&](int x, int y) {
    return RowRays<double>(pass, y + 0.5).calm_depth(x + 0.5);
  };
  b.set(PlaneId::kDepth, [&](int x, int y) { return static_cast<float>(1.4 * water(x, y)); });
  for (int c = 0; c < 3; ++c) {
    b.set(plane_after(PlaneId::kColorR, c), [&](int x, int y) {
      const double down = (y + 0.5) / size.height;
      return static_cast<float>(std::isinf(water(x, y)) ? 0.4 + 0.8 * down : 0.1 + 0.1 * c);
    });
    b.set(plane_after(PlaneId::kReflectionR, c), [&](int x, int y) {
      const double down = (y + 0.5) / size.height;
      return static_cast<float>(std::isinf(water(x, y)) ? 0.1 : 1.2 - 0.8 * down);
    });
  }
  return b;
}

class FusedWaves : public testing::TestWithParam<std::string> {};

TEST_P(FusedWaves, AgreeWithTheReferenceFarOff) {
  const Size size{133, 61};
  const Scene scene = sea(size);
  Buffers b = sea_frame(size, scene);
  for (const Size map_size : {Size{1, 1}, Size{5, 3}, Size{64, 32}, Size{700, 8}}) {
    test::NoiseMap map(map_size.width, map_size.height);
    b.frame.wave_map = map.texture;
    for (const Model model : {Model::kFourMaps, Model::kTwoFlows, Model::kDudv, Model::kSlopes}) {
      for (const Filter filter : {Filter::kMip, Filter::kVariance}) {
        Look look = test::still_look();
        look.of<WaveNormals>().wind = map_size.width == 64 ? 7 : 0;
        look.of<WaveNormals>().model = model;
        look.of<WaveNormals>().filter = filter;
        const Picture judge = test::reference(look, b.frame, scene);
        const Picture got = test::fused(look, b.frame, scene, {.simd = GetParam()});
        int far = 0, wet = 0;
        for (int y = 0; y < size.height; ++y) {
          for (int x = 0; x < size.width; ++x) {
            if (std::isinf(judge.aov(Aov::kSurfaceDepth, x, y))) continue;
            ++wet;
            for (int c = 0; c < 3; ++c) {
              far += !(std::abs(judge.aov(Aov::kNormal, x, y, c) - got.aov(Aov::kNormal, x, y, c)) <
                       2e-4);
            }
          }
        }
        EXPECT_GT(wet, 3000);
        // A position in the map is known to within some 1e-7 of the distance to the position.
        EXPECT_LE(far, wet / 200) << map_size.width << "x" << map_size.height << " " << int(model)
                                  << " " << int(filter);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Simd, FusedWaves, testing::ValuesIn(simd_targets()),
                         [](const auto& p) { return p.param; });

/// One sample of far water compared with the mean of 64: the mean |difference| of pixels, and the
/// largest difference of means of 8 x 8 pixels.
struct Difference {
  double pixels = 0, blocks = 0;
};

Difference beside_many_samples(Look look, Filter filter) {
  constexpr int kSamples = 8, kBlock = 8;
  const Size size{160, 64}, fine{size.width * kSamples, size.height * kSamples};
  const Scene scene = sea(size);
  Buffers one = sea_frame(size, scene), many = sea_frame(fine, scene);
  const LoadedTexture map = load_texture(look.of<WaveNormals>().map);
  one.frame.wave_map = many.frame.wave_map = map.texture;
  look.of<WaveNormals>().filter = Filter::kNone;
  const Picture truth = test::fused(look, many.frame, scene);
  look.of<WaveNormals>().filter = filter;
  const Picture got = test::fused(look, one.frame, scene);
  const auto mean_of = [&](int x, int y) {
    double sum = 0;
    for (int i = 0; i < kSamples * kSamples; ++i) {
      const int fine_x = x * kSamples + i % kSamples, fine_y = y * kSamples + i / kSamples;
      sum += std::min(truth.color(fine_x, fine_y).g, 4.0);
    }
    return sum / (kSamples * kSamples);
  };
  // The far half of the water, without the line of the horizon.
  int first = 0;
  while (std::isinf(got.aov(Aov::kSurfaceDepth, 0, first))) ++first;
  first += 2;
  Difference difference;
  int pixels = 0;
  for (int top = first; top + kBlock <= first + 16; top += kBlock) {
    for (int left = 0; left < size.width; left += kBlock) {
      double block = 0;
      for (int i = 0; i < kBlock * kBlock; ++i) {
        const int x = left + i % kBlock, y = top + i / kBlock;
        const double d = std::min(got.color(x, y).g, 4.0) - mean_of(x, y);
        block += d / (kBlock * kBlock);
        difference.pixels += std::abs(d);
        ++pixels;
      }
      difference.blocks = std::max(difference.blocks, std::abs(block));
    }
  }
  difference.pixels /= pixels;
  return difference;
}

TEST(WaveFilter, OneSampleIsNearTheMeanOfMany) {
  for (const char* name : {"realistic", "fast"}) {
    Look look = load_look(std::string(LIMPID_DATA "/looks/") + name + ".toml");
    look.of<SunHighlight>().strength = 0;
    const Filter filter = look.of<WaveNormals>().filter;
    EXPECT_NE(filter, Filter::kNone);
    const Difference plain = beside_many_samples(look, Filter::kNone);
    const Difference got = beside_many_samples(look, filter);
    EXPECT_LE(got.pixels, 2. / 3 * plain.pixels) << name;
    EXPECT_LE(got.blocks, 0.02) << name;
    RecordProperty(std::string(name) + "_pixels", std::to_string(got.pixels));
    RecordProperty(std::string(name) + "_blocks", std::to_string(got.blocks));
  }
}

}  // namespace
}  // namespace limpid
