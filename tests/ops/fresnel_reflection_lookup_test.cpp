#include "limpid/ops/fresnel_reflection.h"

#include "ops/tray.h"
#include "optics/refract.h"

// Where the operator looks the mirror up, and which values must not show.

namespace limpid {
namespace {

using test::kInf;
using test::Tray;
using Lookup = FresnelReflection::Lookup;
using Source = FresnelReflection::Source;

/// A surface that only mirrors, looked up along the ray.
FresnelReflection::Params& all_mirror(Look& look) {
  FresnelReflection::Params& params = look.of<FresnelReflection>();
  params.reflectance = FresnelReflection::Reflectance::kRim;
  params.power = 0;
  params.lookup = Lookup::kRay;
  return params;
}

/// Red tells the column, green the row (before filtering), blue is 1.
void mirror_tells_its_place(test::Buffers& buffers, Rect window) {
  buffers.set(
      PlaneId::kReflectionR, [](int x, int) { return float(x); }, window);
  buffers.set(
      PlaneId::kReflectionG, [](int, int y) { return float(y); }, window);
  buffers.set(
      PlaneId::kReflectionB, [](int, int) { return 1.0f; }, window);
}

/// The normal that reflects one of two directions into the other.
Vec3<double> halfway(Vec3<double> a, Vec3<double> b) { return normalize_or<double>(a + b, a); }

// --- the environment ----------------------------------------------------------------------------

constexpr Size kSky{8, 4};

/// Every texel of the sky has its own value: 10 row + column.
struct SkyTray : Tray {
  SkyTray() : Tray({1, 1}) {
    sky = Plane(rect_of(kSky));
    for (int y = 0; y < kSky.height; ++y) {
      for (int x = 0; x < kSky.width; ++x) sky.view().at(x, y) = float(10 * y + x);
    }
    for (View<const float>& view : buffers.frame.environment.channels) view = sky.view();
    all_mirror(look).source = Source::kEnvironment;
  }
  /// The mirrored value if the reflected ray has this direction.
  double towards(Vec3<double> direction) {
    buffers.normal(halfway({0, 1, 0}, direction));
    const test::Picture exact = wet(), fast = test::fused(look, buffers.frame, scene);
    EXPECT_NEAR(exact.color(0, 0).r, fast.color(0, 0).r, 2e-5);
    return exact.color(0, 0).r;
  }
  /// The direction of texel coordinates, centres at +0.5: the second axis is world -z.
  static Vec3<double> direction(double x, double y) {
    const double polar = y / kSky.height * std::numbers::pi;
    const double turn = (x / kSky.width - 0.5) * 2 * std::numbers::pi;
    return {std::sin(polar) * std::cos(turn), std::cos(polar), -std::sin(polar) * std::sin(turn)};
  }
  Plane sky;
};

TEST(ReflectedEnvironment, EveryDirectionHitsItsTexel) {
  SkyTray tray;
  for (int y = 0; y < kSky.height / 2; ++y) {
    for (int x = 0; x < kSky.width; ++x) {
      EXPECT_NEAR(tray.towards(SkyTray::direction(x + 0.5, y + 0.5)), 10 * y + x, 1e-5);
    }
  }
  EXPECT_NEAR(tray.towards(SkyTray::direction(3.25, 0.75)), 2.75 + 10 * 0.25, 1e-5);
}

TEST(ReflectedEnvironment, GoesRoundAtTheSeamAndEndsAtThePole) {
  SkyTray tray;
  EXPECT_NEAR(tray.towards(SkyTray::direction(0, 1.5)), 10 + 3.5, 1e-4);
  EXPECT_NEAR(tray.towards(SkyTray::direction(0.25, 1.5)), 10 + 0.25 * 7, 1e-4);
  EXPECT_NEAR(tray.towards(SkyTray::direction(7.75, 1.5)), 10 + 0.75 * 7, 1e-4);
  EXPECT_NEAR(tray.towards({0, 1, 0}), 3.5, 1e-4);  // the middle of the uppermost row
  EXPECT_NEAR(tray.towards(SkyTray::direction(2.5, 0.2)), 2, 1e-4);
}

// Straight down from above: a normal at more than 45 degrees mirrors the viewer below the horizon.
TEST(ReflectedEnvironment, NothingBelowTheHorizon) {
  SkyTray tray;
  for (int x = 0; x < kSky.width; ++x) {
    const double horizon = 15.0 + x;
    EXPECT_NEAR(tray.towards(SkyTray::direction(x + 0.5, 2)), horizon, 1e-4);
    EXPECT_NEAR(tray.towards(SkyTray::direction(x + 0.5, 3.1)), horizon, 1e-4);
  }
}

// Seen from below, the surface mirrors the lower half: along the axis of a picture of one pixel.
TEST(ReflectedEnvironment, TheUndersideMirrorsTheLowerHalf) {
  SkyTray tray;
  for (double y : {2.5, 3.0, 3.5, 3.9}) {
    const Vec3<double> down = SkyTray::direction(5.5, y);
    Camera& camera = *tray.scene.camera;
    const glm::dvec3 eye(0, -2, 0);
    camera.view = glm::lookAt(eye, eye + glm::dvec3(down.x, -down.y, down.z), glm::dvec3(1, 0, 0));
    camera.projection = perspective(0.01, 1, 0.1, 1e3, ClipSpace::kGl);
    tray.buffers.normal({0, 1, 0}).fill(PlaneId::kDepth, 1e3f);
    tray.buffers.frame.planes[index_of(PlaneId::kSurfaceDepth)] = {};
    const test::Picture got = tray.wet();
    const double row = std::min(y - 0.5, 3.0);
    EXPECT_NEAR(
        got.color(0, 0).r / 1,
        got.aov(Aov::kFresnel, 0, 0) * (10 * row + 5) + (1 - got.aov(Aov::kFresnel, 0, 0)) * 0.5,
        1e-3);
  }
}

// --- along the ray ------------------------------------------------------------------------------

// Calm water shows the mirror unchanged, whatever the mirror's depth.
TEST(ReflectedRay, CalmWaterLooksAtItsOwnPlace) {
  const Size size{40, 30};
  for (bool depths : {false, true}) {
    for (bool fast : {false, true}) {
      test::Noise noise(size);
      noise.buffers.normal({0, 1, 0});
      noise.buffers.frame.planes[index_of(PlaneId::kSurfaceDepth)] = {};
      noise.buffers.fill(PlaneId::kReflectionValid, 1);
      mirror_tells_its_place(noise.buffers, rect_of(size));
      noise.buffers.set(PlaneId::kReflectionDepth, [](int x, int y) {
        return test::noise(x, y, 7) < 0.2f ? kInf : 20 * test::noise(x, y, 8);
      });
      if (!depths) noise.buffers.frame.planes[index_of(PlaneId::kReflectionDepth)] = {};
      all_mirror(noise.look);
      const test::Picture got =
          fast ? test::fused(noise.look, noise.buffers.frame, noise.scene) : noise.wet();
      each_wet(got, size, [&](int x, int y) {
        EXPECT_NEAR(got.color(x, y).r, x, fast ? 2e-5 * size.width : 1e-6 * size.width);
        EXPECT_NEAR(got.color(x, y).g, y, fast ? 2e-5 * size.height : 1e-6 * size.height);
      });
    }
  }
}

// A ceiling 6 over the tray: a ray that leaves the tray by one to the right for two up meets the
// ceiling 3 to the right. The ceiling's picture in the mirror is 6 below the water, at depth 16.
TEST(ReflectedRay, EndsAtTheMirroredPoint) {
  Tray tray({20, 20});
  mirror_tells_its_place(tray.buffers, rect_of({20, 20}));
  tray.buffers.fill(PlaneId::kReflectionDepth, 16);
  tray.buffers.normal(halfway({0, 1, 0}, {std::sqrt(0.2), std::sqrt(0.8), 0}));
  all_mirror(tray.look);
  test::expect_rgb(tray.wet().color(8, 5), {11, 5, 1}, 0.01);
  // At twice the distance the lookup would leave the picture: the lookup stays at the edge.
  tray.buffers.fill(PlaneId::kReflectionDepth, 22);
  test::expect_rgb(tray.wet().color(8, 5), {14, 5, 1}, 0.02);
  test::expect_rgb(tray.wet().color(16, 5), {19, 5, 1}, 1e-6);
}

// A wall 10 away stands in the water; its picture in the mirror is the wall itself, going on
// below the water.
TEST(ReflectedRay, FindsTheWallThatTheWaveMirrors) {
  const Size size{80, 60};
  Scene scene = test::simple_scene(size);
  const Rays rays = rays_of(*scene.camera, {size.width, size.height});
  const glm::dvec3 eye = scene.camera->eye();
  const auto depth_at = [&](int x, int y) {  // of the plane z = -10; the rays advance 1 in depth
    return (-10 - eye.z) / rays.ray_at(x + 0.5, y + 0.5).z;
  };
  const auto point_at = [&](int x, int y) {
    return eye + depth_at(x, y) * rays.ray_at(x + 0.5, y + 0.5);
  };
  test::Buffers buffers(rect_of(size));
  const Vec3<double> normal = normalize_or<double>({0.03, 1, 0.04}, {0, 1, 0});
  buffers.normal(normal).fill(PlaneId::kDepth, 1e3f);
  for (int c = 0; c < 3; ++c) {
    buffers.fill(plane_after(PlaneId::kColorR, c), 0);
    buffers.set(plane_after(PlaneId::kReflectionR, c),
                [&](int x, int y) { return float(point_at(x, y)[c]); });
  }
  buffers.set(PlaneId::kReflectionDepth, [&](int x, int y) { return float(depth_at(x, y)); });
  Look look = test::still_look();
  all_mirror(look);
  for (bool fast : {false, true}) {
    const test::Picture got = fast ? test::fused(look, buffers.frame, scene)
                                   : test::reference(look, buffers.frame, scene);
    int seen = 0;
    for (int y = 25; y < 50; ++y) {
      for (int x = 25; x < 55; ++x) {
        const glm::dvec3 ray = rays.ray_at(x + 0.5, y + 0.5);
        const glm::dvec3 start = eye - eye.y / ray.y * ray;
        const Vec3<double> to_viewer = normalize_or<double>({-ray.x, -ray.y, -ray.z}, {0, 1, 0});
        const Vec3<double> away = mirror(to_viewer, normal);
        const double distance = (-10 - start.z) / away.z;
        if (start.z < -9) continue;
        ++seen;
        EXPECT_NEAR(got.color(x, y).r, start.x + distance * away.x, 0.02);
        EXPECT_NEAR(got.color(x, y).g, -distance * away.y, 0.02);
      }
    }
    EXPECT_GT(seen, 200);
  }
}

// Without depths the lookup is the ray's vanishing point, however far away; outside the planes, the
// last texel on the straight line to the vanishing point. Planes may be larger than the picture.
TEST(ReflectedRay, WithoutDepthsTheSceneIsFarAway) {
  Tray tray({10, 10});
  mirror_tells_its_place(tray.buffers, {-5, 0, 15, 10});
  tray.buffers.normal(halfway({0, 1, 0}, {0.6, 0.8, 0}));
  all_mirror(tray.look);
  test::expect_rgb(tray.wet().color(4, 5), {14, 5, 1}, 1e-5);
  tray.buffers.normal(halfway({0, 1, 0}, {0.48, 0.8, -0.36}));  // 3 up for 4 to the right
  test::expect_rgb(tray.wet().color(4, 6), {12, 0, 1}, 1e-3);

  const Size size{1, 41};
  Scene scene = test::simple_scene(size);
  test::Buffers buffers(rect_of(size));
  const double degree = std::numbers::pi / 180, a = 2 * degree;
  buffers.normal({0, std::cos(a), std::sin(a)}).fill(PlaneId::kDepth, 1e3f);
  for (int c = 0; c < 3; ++c) buffers.fill(plane_after(PlaneId::kColorR, c), 0);
  mirror_tells_its_place(buffers, rect_of(size));
  Look look = test::still_look();
  all_mirror(look);
  // The middle pixel looks 30 degrees down; waves that lean 2 degrees to the viewer mirror it 34
  // up, as if it went 34 down in the mirrored scene. The picture is 2 tan(0.45) high.
  const double row = 20 + std::tan(2 * a) * 41 / (2 * std::tan(0.45));
  EXPECT_NEAR(test::reference(look, buffers.frame, scene).color(0, 20).g, row, 1e-4);
}

// At 45 degrees the lookup lies as far aside as the mirrored point lies under the mirror: 4.
TEST(ReflectedRay, MarchesToWhatIsAsDeep) {
  const Size size{24, 4};
  Tray tray(size);
  mirror_tells_its_place(tray.buffers, rect_of(size));
  tray.buffers.fill(PlaneId::kReflectionDepth, 14);
  tray.buffers.normal(halfway({0, 1, 0}, {std::sqrt(0.5), std::sqrt(0.5), 0}));
  all_mirror(tray.look).source = Source::kAuto;
  EXPECT_NEAR(tray.wet().color(6, 2).r, 6 + 4, 0.1);
}

// As WithoutDepthsTheSceneIsFarAway, with an object 25 away that the planes show at the end of the
// endless ray, 30 rows below the pixel, though at that depth the ray is still 5 rows away: the
// object hides the end of the ray, and is not mirrored.
TEST(ReflectedRay, WhatHidesItsFarEndIsNotMirrored) {
  const Size size{1, 411};
  const Scene scene = test::simple_scene(size);
  test::Buffers buffers(rect_of(size));
  const double a = 2 * std::numbers::pi / 180;
  const double far = 205 + std::tan(2 * a) * 411 / (2 * std::tan(0.45));
  buffers.normal({0, std::cos(a), std::sin(a)}).fill(PlaneId::kDepth, 1e3f);
  for (int c = 0; c < 3; ++c) buffers.fill(plane_after(PlaneId::kColorR, c), 0);
  mirror_tells_its_place(buffers, rect_of(size));
  buffers.set(PlaneId::kReflectionDepth,
              [&](int, int y) { return std::abs(y - far) < 2.5 ? 25.0f : kInf; });
  Look look = test::still_look();
  all_mirror(look).source = Source::kAuto;
  const double row = test::reference(look, buffers.frame, scene).color(0, 205).g;
  EXPECT_GT(row, 205 + 20);
  EXPECT_LT(row, far - 3);
  // An object so far away that the ray ends within a pixel of the object is mirrored.
  buffers.set(PlaneId::kReflectionDepth,
              [&](int, int y) { return std::abs(y - far) < 2.5 ? 2500.0f : kInf; });
  EXPECT_NEAR(test::reference(look, buffers.frame, scene).color(0, 205).g, far, 0.1);
}

// A wave mirrors the ray into the water: the ray is laid flat, and the picture of the flat ray is
// the ray itself.
TEST(ReflectedRay, LiesFlatWhereTheWaveSendsItDown) {
  Tray tray({20, 20});
  mirror_tells_its_place(tray.buffers, rect_of({20, 20}));
  tray.buffers.fill(PlaneId::kReflectionDepth, 10);
  all_mirror(tray.look);
  for (double down : {0.1, 0.5, 0.9}) {
    tray.buffers.normal(halfway({0, 1, 0}, {-std::sqrt(1 - down * down), -down, 0}));
    const Rgb<double> got = tray.wet().color(8, 5);
    EXPECT_LE(got.r, 8);
    EXPECT_NEAR(got.g, 5, 1e-5);
  }
}

// --- behind the cut -----------------------------------------------------------------------------

/// Patches of a mirror with valid texels, and a red sky in the rest.
test::Noise cut_mirror(Size size) {
  test::Noise noise(size);
  const auto valid = [](int x, int y) { return test::noise(x / 5, y / 3, 3) > 0.5f; };
  noise.buffers.set(PlaneId::kReflectionValid, [=](int x, int y) {
    return valid(x, y) ? 0.5f + 0.5f * test::noise(x, y, 4) : 0.49f * test::noise(x, y, 4);
  });
  noise.buffers.set(PlaneId::kReflectionR, [=](int x, int y) { return valid(x, y) ? 0 : 1e6f; });
  noise.buffers.set(PlaneId::kReflectionG, [=](int x, int y) { return valid(x, y) ? 1 : 0.0f; });
  noise.buffers.fill(PlaneId::kReflectionB, 0);
  noise.buffers.set(PlaneId::kReflectionDepth, [=](int x, int y) {
    return valid(x, y) ? 4 + 6 * test::noise(x / 4, y / 4, 5) : kInf;
  });
  all_mirror(noise.look);
  return noise;
}

TEST(ReflectionBehindTheCut, NeverShows) {
  const Size size{60, 40};
  test::Noise noise = cut_mirror(size);
  for (double steepness : {0.05, 0.5, 3.0}) {
    const auto slope = [=](int x, int y, int c) {
      return steepness * (test::noise(x, y, c) - 0.5);
    };
    for (int c = 0; c < 3; ++c) {
      noise.buffers.set(plane_after(PlaneId::kSurfaceNormalX, c), [&](int x, int y) {
        const double sx = slope(x, y, 11), sz = slope(x, y, 12);
        return float((c == 0 ? sx : c == 1 ? 1 : sz) / std::sqrt(1 + sx * sx + sz * sz));
      });
    }
    for (double strength : {-10.0, 0.0, 0.02, 0.3, 10.0, 11.0}) {
      FresnelReflection::Params& params = all_mirror(noise.look);
      params.lookup = strength > 10 ? Lookup::kRay : Lookup::kOffset;
      params.strength = min(strength, 10.0);
      for (bool fast : {false, true}) {
        const test::Picture got =
            fast ? test::fused(noise.look, noise.buffers.frame, noise.scene) : noise.wet();
        int bright = 0, wet = 0;
        each_wet(got, size, [&](int x, int y) {
          ++wet;
          bright += got.color(x, y).g > 0.99;
          EXPECT_EQ(got.color(x, y).r, 0);
          EXPECT_LE(got.color(x, y).g, 1 + 1e-5);
        });
        EXPECT_GT(bright, wet / 3) << steepness << " " << strength;
      }
    }
  }
}

TEST(ReflectionBehindTheCut, IsFilledFromTheEnvironmentOrBlack) {
  Tray tray({4, 4});
  mirror_tells_its_place(tray.buffers, rect_of({4, 4}));
  tray.buffers.normal({0, 1, 0}).fill(PlaneId::kReflectionValid, 0);
  for (Lookup lookup : {Lookup::kOffset, Lookup::kRay}) {
    all_mirror(tray.look).lookup = lookup;
    tray.buffers.frame.environment = {};
    test::expect_rgb(tray.wet().color(2, 2), {0, 0, 0}, 0);
    const float sky = 7;
    for (View<const float>& view : tray.buffers.frame.environment.channels) {
      view = {&sky, 0, 0, {0, 0, 8, 4}};
    }
    test::expect_rgb(tray.wet().color(2, 2), {7, 7, 7}, 1e-5);
  }
}

// Halfway between a valid and an invalid texel, all light comes from the valid texel.
TEST(ReflectionBehindTheCut, TheValidTexelsFillUp) {
  Tray tray = Tray({10, 10});
  mirror_tells_its_place(tray.buffers, rect_of({10, 10}));
  tray.buffers.normal({0.6, 0.8, 0});
  tray.buffers.set(PlaneId::kReflectionValid, [](int x, int) { return x < 6 ? 1.0f : 0.0f; });
  FresnelReflection::Params& params = all_mirror(tray.look);
  params.lookup = Lookup::kOffset;
  const auto red = [&](double texels) {
    params.strength = texels / 6;
    return tray.wet().color(3, 5).r;
  };
  EXPECT_NEAR(red(1.5), 4.5, 1e-5);
  EXPECT_NEAR(red(2), 5, 1e-5);
  EXPECT_NEAR(red(2.5), 5, 1e-5);
  EXPECT_NEAR(red(4), 5, 1e-5);
}

}  // namespace
}  // namespace limpid
