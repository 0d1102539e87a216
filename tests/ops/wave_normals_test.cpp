#include "limpid/ops/wave_normals.h"

#include <glm/geometric.hpp>

#include "ops/tray.h"
#include "optics/waves.h"

namespace limpid {
namespace {

using test::NoiseMap;
using test::Tray;

constexpr Size kEight{8, 8};
using Model = WaveNormals::Model;
constexpr Model kMapModels[] = {Model::kFourMaps, Model::kTwoFlows, Model::kDudv, Model::kSlopes};

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

/// The map's vector at the pixel (x, y) of mapped_tray(). World x = x - 3.5, map v runs along
/// cross(up, x) = -z, z = y - 3.5; so u = x - 4 and v = 3 - y in texels, modulo 8.
Vec3<double> decoded(const NoiseMap& map, int x, int y) {
  const auto texel = [&](int c) {
    return 2.0 * map.texture.channels[c].at(((x - 4) % 8 + 8) % 8, ((3 - y) % 8 + 8) % 8) - 1;
  };
  return {texel(0), texel(2), -texel(1)};
}

/// The map's color at u, v in texels (centres at .5): the four around, mixed by hand.
Rgb<double> mixed(const NoiseMap& map, double u, double v) {
  const int x = int(std::floor(u - 0.5)), y = int(std::floor(v - 0.5));
  const double s = u - 0.5 - x, t = v - 0.5 - y;
  double rgb[3];
  for (int c = 0; c < 3; ++c) {
    const auto at = [&](int i, int j) -> double {
      return map.texture.channels[c].at((i % 8 + 8) % 8, (j % 8 + 8) % 8);
    };
    rgb[c] = (1 - s) * (1 - t) * at(x, y) + s * (1 - t) * at(x + 1, y) +
             (1 - s) * t * at(x, y + 1) + s * t * at(x + 1, y + 1);
  }
  return {rgb[0], rgb[1], rgb[2]};
}

/// The place in the map, in texels, of the pixel (x, y) of mapped_tray().
Vec2<double> place_of(int x, int y) { return {x - 3.5, 3.5 - y}; }

/// Map axes to world axes.
Vec3<double> in_world(double x, double y, double up) { return {x, up, -y}; }

Vec3<double> decoded(Rgb<double> c) { return in_world(2 * c.r - 1, 2 * c.g - 1, 2 * c.b - 1); }

/// A map of one color.
struct FlatMap {
  explicit FlatMap(Rgb<double> color) {
    const double values[] = {color.r, color.g, color.b};
    for (int c = 0; c < 3; ++c) {
      planes[c] = Plane(Rect{0, 0, 2, 2});
      for (int i = 0; i < 4; ++i) planes[c].view().at(i % 2, i / 2) = float(values[c]);
      texture.channels[c] = planes[c].view();
    }
  }
  std::array<Plane, 3> planes;
  Texture texture;
};

/// The normal that a model makes of a map of one color.
Vec3<double> normal_from(Model model, Rgb<double> color, double strength) {
  const FlatMap map(color);
  Tray tray(kEight);
  tray.buffers.frame.wave_map = map.texture;
  tray.look.of<WaveNormals>().model = model;
  tray.look.of<WaveNormals>().strength = strength;
  tray.scene.time = 1.7;
  return normal_at(tray.wet(), 3, 5);
}

Tray waving_tray(std::vector<SineWave> waves) {
  Tray tray(kEight);
  tray.look.of<WaveNormals>().model = Model::kSines;
  tray.look.of<WaveNormals>().strength = 1;
  tray.look.of<WaveNormals>().waves = std::move(waves);
  return tray;
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
  // Turned by a quarter: a texel above the centre now lies to the centre's right, with the same
  // world normal.
  Tray turned = mapped_tray(map, 0.7);
  turned.scene.camera->view =
      glm::lookAt(glm::dvec3(0, 10, 0), glm::dvec3(0, 0, 0), glm::dvec3(-1, 0, 0));
  expect_vector(normal_at(turned.wet(), 6, 4), normal_at(first, 4, 1));
}

TEST(WaveNormals, AFlatMapIsCalm) {
  for (Model model : kMapModels) {
    expect_vector(normal_from(model, {0.5, 0.5, 1}, 1), {0, 1, 0}, 1e-7);
    expect_vector(normal_from(model, {0.5, 0.5, 1}, 3), {0, 1, 0}, 1e-7);
  }
}

// The map says (0.36, 0.48, 0.8) everywhere.
TEST(WaveNormals, OneColorByHand) {
  const Rgb<double> color{0.68, 0.74, 0.9};
  expect_vector(normal_from(Model::kFourMaps, color, 1), in_world(0.36, 0.48, 0.8));
  expect_vector(normal_from(Model::kTwoFlows, color, 1), in_world(0.36, 0.48, 0.8));
  expect_vector(normal_from(Model::kSlopes, color, 1), in_world(0.36, 0.48, 0.8));
  expect_vector(normal_from(Model::kDudv, color, 1), unit(in_world(0.36, 0.48, 0.9)));
  // Half way from calm: of three quarters of the vector, of slopes.
  expect_vector(normal_from(Model::kTwoFlows, color, 0.5), unit(in_world(0.135, 0.18, 0.8)));
  expect_vector(normal_from(Model::kSlopes, color, 0.5), unit(in_world(0.225, 0.3, 1)));
  expect_vector(normal_from(Model::kSlopes, color, 2), unit(in_world(0.9, 1.2, 1)));
}

// Straight sideways or from below: the slope is that of n_z = 0.05, 20 at most.
TEST(WaveNormals, SlopesOfOverhangsAreBounded) {
  for (double blue : {0.5, 0.0, 0.525}) {
    expect_vector(normal_from(Model::kSlopes, {1, 0.5, blue}, 1), unit(in_world(20, 0, 1)), 1e-5);
  }
}

// Four lookups lean by slopes, and slopes add up: twice the slope gives twice the mean slope; the
// mean of vectors does not double.
TEST(WaveNormals, SlopesAreTheMeanOfTheSlopes) {
  const NoiseMap map(8, 8);
  Tray tray = mapped_tray(map, 1);
  tray.look.of<WaveNormals>().model = Model::kSlopes;
  tray.scene.time = 2;
  Vec3<double> mean{0, 1, 0};
  for (const auto& n :
       {decoded(map, 1, 3), decoded(map, 5, 3), decoded(map, 3, 1), decoded(map, 3, 5)}) {
    mean.x += n.x / n.y / 4;
    mean.z += n.z / n.y / 4;
  }
  expect_vector(normal_at(tray.wet(), 3, 3), unit(mean));
}

// At a third of a period's eighth: the first lookup moves by direction, the second, twice as wide,
// moves back by 0.3 of direction.
TEST(WaveNormals, TwoFlowsDriftAgainstEachOther) {
  const NoiseMap map(8, 8);
  for (double degrees : {0.0, 90.0, 135.0}) {
    for (double time : {0.0, 1.25}) {
      Tray tray = mapped_tray(map, 1);
      tray.look.of<WaveNormals>().model = Model::kTwoFlows;
      tray.look.of<WaveNormals>().direction = degrees;
      tray.scene.time = time;
      const double angle = degrees * std::numbers::pi / 180;
      const double du = time * std::cos(angle), dv = time * std::sin(angle);
      const test::Picture got = tray.wet();
      for (const auto& [x, y] : {std::pair(1, 2), std::pair(6, 5), std::pair(3, 0)}) {
        const Vec2<double> at = place_of(x, y);
        const Vec3<double> first = decoded(mixed(map, at.x + du, at.y + dv));
        const Vec3<double> second =
            decoded(mixed(map, 0.5 * at.x - 0.3 * du, 0.5 * at.y - 0.3 * dv));
        expect_vector(normal_at(got, x, y), unit(first + 0.5 * second));
      }
    }
  }
  EXPECT_EQ(WaveNormals::Params{}.direction, 135) << "the article's (-1, 1)";
}

TEST(WaveNormals, DudvLooksUpTwice) {
  const NoiseMap map(8, 8);
  for (double time : {0.0, 1.25}) {
    Tray tray = mapped_tray(map, 1);
    tray.look.of<WaveNormals>().model = Model::kDudv;
    tray.scene.time = time;
    const test::Picture got = tray.wet();
    for (const auto& [x, y] : {std::pair(1, 2), std::pair(6, 5)}) {
      const Vec2<double> at = place_of(x, y);
      const Rgb<double> moved = mixed(map, at.x + time, at.y);  // 0.01 periods are 0.08 texels
      const Rgb<double> c = mixed(map, at.x + 0.08 * moved.r, at.y + 0.08 * moved.g + time);
      expect_vector(normal_at(got, x, y), unit(in_world(2 * c.r - 1, 2 * c.g - 1, c.b)));
    }
  }
}

// Red moves lookups right, green down, wherever the camera looks: on ten pixels, by strength 1/2 of
// 0.6 and 0.2 times a refraction strength of 1/3, one pixel and a third.
TEST(WaveNormals, DudvIsTiedToTheScreen) {
  const FlatMap map({0.8, 0.6, 0.9});
  for (const glm::dvec3& top : {glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)}) {
    Tray tray({10, 10});
    tray.buffers.frame.wave_map = map.texture;
    tray.scene.camera->view = glm::lookAt(glm::dvec3(0, 10, 0), glm::dvec3(0, 0, 0), top);
    tray.buffers.set(PlaneId::kColorR, [](int x, int) { return float(x); });
    tray.buffers.set(PlaneId::kColorG, [](int, int y) { return float(y); });
    tray.look.of<WaveNormals>().model = Model::kDudv;
    tray.look.of<WaveNormals>().strength = 0.5;
    tray.look.of<Refraction>().strength = 1.0 / 3;
    test::expect_rgb(tray.wet().color(5, 5), {6, 5 + 1.0 / 3, 0.5}, 1e-5);
    // A map beyond red and green still shifts by one tilt at most.
    tray.look.of<WaveNormals>().strength = 4;
    tray.look.of<Refraction>().strength = 0.2;
    test::expect_rgb(tray.wet().color(5, 5), {7, 5 + 1.6, 0.5}, 1e-5);
  }
}

// Height 0.1 sin(2 x): at the pixel's world x its slope is 0.2 cos(2 x).
TEST(WaveNormals, OneSineByHand) {
  const test::Picture got = waving_tray({{0.1, 2, 0, 0, 0}}).wet();
  for (int x = 0; x < 8; ++x) {
    const double slope = 0.2 * std::cos(2 * (x - 3.5));
    expect_vector(normal_at(got, x, 4), unit({-slope, 1, 0}));
  }
  // Along map y, which is world -z; row y lies at z = y - 3.5. Half the strength is half the slope.
  Tray tray = waving_tray({{0.1, 0, 2, 0.5, 0}});
  tray.look.of<WaveNormals>().strength = 0.5;
  const test::Picture half = tray.wet();
  for (int y = 0; y < 8; ++y) {
    const double slope = 0.1 * std::cos(2 * (3.5 - y) + 0.5);
    expect_vector(normal_at(half, 2, y), unit({0, 1, slope}));
  }
}

// The normal is that of the height, by differences, for any waves at any time, where the camera is
// far from the world's origin.
TEST(WaveNormals, SinesAreTheSlopesOfTheirHeight) {
  const std::vector<SineWave> waves = {
      {0.1, 1.3, -0.4, 0.3, 2.1}, {0.04, -2.2, 3.1, 1.9, -5}, {0.3, 0.2, 0.25, 0, 1}};
  for (double far : {0.0, 12345.0}) {
    for (double time : {0.0, 7.3, 86400.5}) {
      Tray tray = waving_tray(waves);
      tray.scene.time = time;
      tray.scene.camera->view =
          glm::lookAt(glm::dvec3(far, 10, -far), glm::dvec3(far, 0, -far), glm::dvec3(0, 0, -1));
      const test::Picture got = tray.wet();
      for (int x = 0; x < 8; ++x) {
        const double map_x = far + x - 3.5, map_y = far - (x - 3.5), step = 1e-5;
        const auto height = [&](double u, double v) {
          return wave_height(waves, map_x + u, map_y + v, time).height;
        };
        const double rise_x = (height(step, 0) - height(-step, 0)) / (2 * step);
        const double rise_y = (height(0, step) - height(0, -step)) / (2 * step);
        expect_vector(normal_at(got, x, x), unit(in_world(-rise_x, -rise_y, 1)), 1e-5);
      }
    }
  }
}

// Waves of a crest a second that are two units long: half a second moves them by one pixel.
TEST(WaveNormals, SinesTravelAlongTheirDirection) {
  const double k = std::numbers::pi;
  Tray tray = waving_tray({{0.1, k, 0, 0.4, 2 * k}});
  const test::Picture first = tray.wet();
  tray.scene.time = 1000.5;
  const test::Picture later = tray.wet();
  for (int x = 1; x < 8; ++x) {
    expect_vector(normal_at(later, x, 3), normal_at(first, x - 1, 3));
  }
}

TEST(WaveNormals, SinesAreTheScenesUnlessTheLookHasSome) {
  const std::vector<SineWave> of_scene = {{0.1, 1, 0.5, 0, 0}}, of_look = {{0.1, 0, 2, 0, 0}};
  Tray tray = waving_tray({});
  expect_vector(normal_at(tray.wet(), 1, 2), {0, 1, 0}, 0);  // no waves
  tray.scene.water->waves = of_scene;
  expect_vector(normal_at(tray.wet(), 1, 2), normal_at(waving_tray(of_scene).wet(), 1, 2), 0);
  tray.look.of<WaveNormals>().waves = of_look;
  expect_vector(normal_at(tray.wet(), 1, 2), normal_at(waving_tray(of_look).wet(), 1, 2), 0);
}

TEST(WaveNormals, SinesWithoutHeightAreCalm) {
  expect_vector(normal_at(waving_tray({{0, 5, 6, 1, 1}}).wet(), 3, 3), {0, 1, 0}, 0);
  expect_vector(normal_at(waving_tray({{3, 0, 0, 1, 1}}).wet(), 3, 3), {0, 1, 0}, 0);
}

// Where neighbouring floats are turns apart the waves average out.
TEST(WaveNormals, SinesTooFarForANumberAreCalm) {
  Tray tray = waving_tray({{0.1, 1e4, 0, 0, 0}});
  tray.scene.camera->projection = perspective(1, 1, 0.1, 100, ClipSpace::kGl);
  tray.buffers.fill(PlaneId::kSurfaceDepth, 1e38f).fill(PlaneId::kDepth, test::kInf);
  for (const test::Picture& got :
       {tray.wet(), test::fused(tray.look, tray.buffers.frame, tray.scene)}) {
    each_wet(got, kEight, [&](int x, int y) { expect_vector(normal_at(got, x, y), {0, 1, 0}, 0); });
  }
}

TEST(WaveNormals, AreUnit) {
  const Size size{23, 17};
  test::Noise noise(size);
  const NoiseMap map(16, 8);
  for (int c = 0; c < 3; ++c) {
    noise.buffers.frame.planes[index_of(PlaneId::kSurfaceNormalX) + c] = {};
  }
  noise.buffers.frame.wave_map = map.texture;
  noise.scene.water->waves = {{0.3, 4, 5, 6, 7}};
  for (Model model :
       {Model::kFourMaps, Model::kTwoFlows, Model::kDudv, Model::kSlopes, Model::kSines}) {
    for (double strength : {0.1, 1.0, 4.0}) {
      noise.look.of<WaveNormals>().model = model;
      noise.look.of<WaveNormals>().strength = strength;
      const test::Picture got = noise.wet();
      each_wet(got, size,
               [&](int x, int y) { EXPECT_NEAR(length(normal_at(got, x, y)), 1, 1e-6); });
    }
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
  Tray blown = mapped_tray(map, 1);
  blown.look.of<WaveNormals>().tile_size = 1e-6;
  blown.look.of<WaveNormals>().wind = 30;
  blown.scene.time = 1e300;
  for (const auto& [tray, model] :
       {std::pair(&far_off, Model::kFourMaps), std::pair(&late, Model::kFourMaps),
        std::pair(&far_off, Model::kTwoFlows), std::pair(&late, Model::kTwoFlows),
        std::pair(&far_off, Model::kDudv), std::pair(&late, Model::kDudv),
        std::pair(&far_off, Model::kSlopes), std::pair(&late, Model::kSlopes),
        std::pair(&blown, Model::kFourMaps), std::pair(&blown, Model::kTwoFlows),
        std::pair(&blown, Model::kDudv), std::pair(&blown, Model::kSlopes)}) {
    tray->look.of<WaveNormals>().model = model;
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

// In any direction of the camera, a wave that leans to the camera's right moves the lookup right,
// and a wave that leans away from the camera moves the lookup up the picture.
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

// The right of a camera on its side is the plane's normal, so the camera's up stands in.
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
