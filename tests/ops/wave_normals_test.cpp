#include "limpid/ops/wave_normals.h"

#include <glm/geometric.hpp>

#include "ops/tray.h"

namespace limpid {
namespace {

using test::NoiseMap;
using test::Tray;

constexpr Size kEight{8, 8};

Vec3<double> normal_at(const test::Picture& picture, int x, int y) {
  return {picture.aov(Aov::kNormal, x, y, 0), picture.aov(Aov::kNormal, x, y, 1),
          picture.aov(Aov::kNormal, x, y, 2)};
}

void expect_vector(Vec3<double> got, Vec3<double> expected, double tolerance = 2e-6) {
  EXPECT_NEAR(got.x, expected.x, tolerance);
  EXPECT_NEAR(got.y, expected.y, tolerance);
  EXPECT_NEAR(got.z, expected.z, tolerance);
}

/// One texel of the map a pixel: 8 x 8 pixels of one unit, the map 8 x 8 over 8 units.
Tray mapped_tray(const NoiseMap& map, double strength) {
  Tray tray(kEight);
  tray.buffers.frame.wave_map = map.texture;
  tray.look.of<WaveNormals>().tile_size = 8;
  tray.look.of<WaveNormals>().speed = 1;
  tray.look.of<WaveNormals>().strength = strength;
  return tray;
}

/// The map's vector that the pixel (x, y) of mapped_tray() meets. World x = x - 3.5, map v runs
/// along cross(up, x) = -z, z = y - 3.5; so u = x - 4 and v = 3 - y in texels, modulo 8.
Vec3<double> decoded(const NoiseMap& map, int x, int y) {
  const auto texel = [&](int c) {
    return 2.0 * map.texture.channels[c].at(((x - 4) % 8 + 8) % 8, ((3 - y) % 8 + 8) % 8) - 1;
  };
  return {texel(0), texel(2), -texel(1)};
}

Vec3<double> unit(Vec3<double> v) { return normalize_or(v, Vec3<double>{0, 1, 0}); }

TEST(WaveNormals, PlateNormalsAreTakenAsTheyAre) {
  Tray tray(kEight);
  tray.buffers.normal({0.48, 0.8, -0.36});
  expect_vector(normal_at(tray.wet(), 5, 5), {0.48, 0.8, -0.36}, 1e-7);
}

TEST(WaveNormals, FourMapsAtTimeZeroAreTheMap) {
  const NoiseMap map(8, 8);
  const test::Picture got = mapped_tray(map, 1).wet();
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) expect_vector(normal_at(got, x, y), unit(decoded(map, x, y)));
  }
}

TEST(WaveNormals, StrengthBlendsFromCalm) {
  const NoiseMap map(8, 8);
  const Vec3<double> up{0, 1, 0}, n = decoded(map, 2, 6);
  for (double strength : {0.25, 0.5, 2.0}) {
    expect_vector(normal_at(mapped_tray(map, strength).wet(), 2, 6),
                  unit(up + strength * (n - up)));
  }
  expect_vector(normal_at(mapped_tray(map, 0).wet(), 2, 6), up, 0);
}

// After 2 s at one unit a second: the mean of the texels two to each side.
TEST(WaveNormals, TheFourMapsDriftApartAlongTheAxes) {
  const NoiseMap map(8, 8);
  Tray tray = mapped_tray(map, 1);
  tray.scene.time = 2;
  const Vec3<double> sum =
      decoded(map, 1, 3) + decoded(map, 5, 3) + decoded(map, 3, 1) + decoded(map, 3, 5);
  expect_vector(normal_at(tray.wet(), 3, 3), unit(0.25 * sum));
  tray.look.of<WaveNormals>().speed = -1;
  expect_vector(normal_at(tray.wet(), 3, 3), unit(0.25 * sum));
}

TEST(WaveNormals, RepeatInTimeAndSpace) {
  const NoiseMap map(8, 8);
  Tray tray = mapped_tray(map, 0.7);
  tray.scene.time = 1.3;
  const test::Picture first = tray.wet();
  Tray later = mapped_tray(map, 0.7);
  later.scene.time = 1.3 + 8 * 1000;
  Tray elsewhere = mapped_tray(map, 0.7);
  elsewhere.scene.time = 1.3;
  elsewhere.scene.camera->view =
      glm::lookAt(glm::dvec3(8000, 10, -1600), glm::dvec3(8000, 0, -1600), glm::dvec3(0, 0, -1));
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      expect_vector(normal_at(later.wet(), x, y), normal_at(first, x, y));
      expect_vector(normal_at(elsewhere.wet(), x, y), normal_at(first, x, y));
    }
  }
}

TEST(WaveNormals, TheMapStaysWithTheWorldWhenTheCameraMoves) {
  const NoiseMap map(8, 8);
  const test::Picture first = mapped_tray(map, 0.7).wet();
  Tray moved = mapped_tray(map, 0.7);
  moved.scene.camera->view =
      glm::lookAt(glm::dvec3(3, 10, 0), glm::dvec3(3, 0, 0), glm::dvec3(0, 0, -1));
  expect_vector(normal_at(moved.wet(), 1, 5), normal_at(first, 4, 5));
  // Turned by a quarter: what lay above the centre now lies to its right, same world normal.
  Tray turned = mapped_tray(map, 0.7);
  turned.scene.camera->view =
      glm::lookAt(glm::dvec3(0, 10, 0), glm::dvec3(0, 0, 0), glm::dvec3(-1, 0, 0));
  expect_vector(normal_at(turned.wet(), 6, 4), normal_at(first, 4, 1));
}

TEST(WaveNormals, AreUnit) {
  const Size size{23, 17};
  test::Noise noise(size);
  const NoiseMap map(16, 8);
  for (int c = 0; c < 3; ++c) {
    noise.buffers.frame.planes[index_of(PlaneId::kSurfaceNormalX) + c] = {};
  }
  noise.buffers.frame.wave_map = map.texture;
  for (double strength : {0.1, 1.0, 4.0}) {
    noise.look.of<WaveNormals>().strength = strength;
    const test::Picture got = noise.wet();
    each_wet(got, size, [&](int x, int y) { EXPECT_NEAR(length(normal_at(got, x, y)), 1, 1e-6); });
  }
}

// Far water, a tiny tile, the end of time: the position in the map is infinite in float or in
// double, and every tap must lie in the map all the same.
TEST(WaveNormals, PositionsTooFarForANumberStayInTheMap) {
  const NoiseMap map(8, 8);
  Tray far_off = mapped_tray(map, 1);
  far_off.look.of<WaveNormals>().tile_size = 1e-6;
  far_off.scene.camera->projection = perspective(1, 1, 0.1, 100, ClipSpace::kGl);
  far_off.buffers.fill(PlaneId::kSurfaceDepth, 1e38f).fill(PlaneId::kDepth, test::kInf);
  Tray late = mapped_tray(map, 1);
  late.look.of<WaveNormals>().tile_size = 1e-6;
  late.look.of<WaveNormals>().speed = 1e6;
  late.scene.time = 1e300;
  for (Tray* tray : {&far_off, &late}) {
    std::vector<test::Picture> pictures;
    pictures.push_back(tray->wet());
    for (const std::string& simd : simd_targets()) {
      pictures.push_back(test::fused(tray->look, tray->buffers.frame, tray->scene, {.simd = simd}));
    }
    for (const test::Picture& picture : pictures) {
      each_wet(picture, kEight,
               [&](int x, int y) { EXPECT_NEAR(length(normal_at(picture, x, y)), 1, 1e-6); });
    }
  }
}

// Whatever way the camera looks: a wave that leans to the camera's right moves the lookup right,
// one that leans away from the camera moves it up the picture.
TEST(WaveNormals, TiltFollowsTheCameraInAnyWorld) {
  const Size size{10, 10};
  struct World {
    glm::dvec3 up, forward;
  };
  const World kWorlds[] = {{{0, 1, 0}, {0, -0.5, -1}},   {{0, 1, 0}, {1, -0.5, 0}},
                           {{0, 1, 0}, {-0.7, -1, 0.7}}, {{0, 0, 1}, {0, 1, -0.5}},
                           {{0, 0, 1}, {-1, 0.2, -0.5}}, {{1, 0, 0}, {-0.4, 1, 1}}};
  for (const World& world : kWorlds) {
    const glm::dvec3 right = glm::normalize(glm::cross(world.forward, world.up));
    const glm::dvec3 away = glm::cross(world.up, right);
    const auto moved = [&](const glm::dvec3& lean) {
      Tray tray(size);
      tray.scene.water->up = world.up;
      tray.scene.camera->view =
          glm::lookAt(3.0 * world.up, 3.0 * world.up + world.forward, world.up);
      tray.scene.camera->projection = perspective(0.6, 1, 0.1, 100, ClipSpace::kGl);
      tray.buffers.set(PlaneId::kColorR, [](int x, int) { return float(x); });
      tray.buffers.set(PlaneId::kColorG, [](int, int y) { return float(y); });
      const glm::dvec3 n = 0.8 * world.up + 0.6 * lean;
      tray.buffers.normal({n.x, n.y, n.z});
      tray.look.of<Refraction>().strength = 1.0 / 6;  // times 0.6 on ten pixels: one pixel
      return tray.wet().color(5, 5);
    };
    test::expect_rgb(moved(right), {6, 5, 0.5}, 1e-5);
    test::expect_rgb(moved(-right), {4, 5, 0.5}, 1e-5);
    test::expect_rgb(moved(away), {5, 4, 0.5}, 1e-5);
    test::expect_rgb(moved(-away), {5, 6, 0.5}, 1e-5);
  }
}

// A camera on its side: its right is the plane's normal, so its up stands in.
TEST(WaveNormals, TiltOfACameraOnItsSide) {
  Tray tray({10, 10});
  tray.scene.camera->view =
      glm::lookAt(glm::dvec3(0, 1, 0), glm::dvec3(0, 1, -1), glm::dvec3(1, 0, 0));
  tray.buffers.set(PlaneId::kColorR, [](int x, int) { return float(x); });
  tray.buffers.normal({0.6, 0.8, 0});
  tray.look.of<Refraction>().strength = 1.0 / 6;
  EXPECT_NEAR(tray.wet().color(5, 5).r, 6, 1e-5);
}

}  // namespace
}  // namespace limpid
