#include "complete/displaced_surface.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/simd.h"
#include "limpid/plan/plan.h"

#include "op/pass.h"
#include "optics/waves.h"
#include "plan/pass_of.h"
#include "support.h"

namespace limpid {
namespace {

using test::Buffers;
using test::kInf;

constexpr Size kSize{64, 48};
constexpr double kNear = 0.1;

/// The sum of the amplitudes is .063, the steepest slope .19.
const std::vector<SineWave> kWaves{
    {0.03, 2, 3, 0.6, 2}, {-0.02, 3, -1, 4, 3}, {0.013, 1, 0.3, 2, 1}};

/// A scene seen from `height` above the calm water along -z, down by `pitch` rad.
Scene scene_at(double height, double pitch, std::vector<SineWave> waves = kWaves) {
  Scene scene;
  const glm::dvec3 eye(30.3, 1 + height, 20.2);
  scene.camera =
      Camera{glm::lookAt(eye, eye + glm::dvec3(0.2, -std::sin(pitch), -std::cos(pitch)), {0, 1, 0}),
             perspective(0.7, double(kSize.width) / kSize.height, kNear, 1e3, ClipSpace::kGl),
             ClipSpace::kGl};
  scene.water = WaterPlane{{0, 1, 0}, 1, std::move(waves)};
  scene.time = 0.8;
  return scene;
}

/// A scene seen straight down, 8 units wide.
Scene seen_in_parallel(double height) {
  Scene scene = scene_at(height, 0);
  const glm::dvec3 eye(3, 1 + height, 2);
  scene.camera = Camera{glm::lookAt(eye, eye - glm::dvec3(0, 1, 0), {0, 0, -1}),
                        orthographic(8, 8.0 * kSize.height / kSize.width, 0.1, 100, ClipSpace::kGl),
                        ClipSpace::kGl};
  return scene;
}

Look sines(double strength = 1, std::vector<SineWave> waves = {}) {
  Look look = test::still_look();
  look.of<FresnelReflection>().source = FresnelReflection::Source::kConstant;
  WaveNormals::Params& params = look.of<WaveNormals>();
  params.model = WaveNormals::Model::kSines;
  params.strength = strength;
  params.waves = std::move(waves);
  return look;
}

/// Planes of color and depth without objects before the water.
Buffers bare(float depth = kInf) {
  Buffers b(rect_of(kSize));
  for (int c = 0; c < 3; ++c) b.fill(plane_after(PlaneId::kColorR, c), 0.5f);
  b.fill(PlaneId::kDepth, depth);
  return b;
}

/// A surface and the rays that meet it.
struct Made {
  Made(const Scene& s, const std::string* simd, const Look& look = sines(), int threads = 1)
      : scene(s),
        plan(make_plan(look, test::inputs_of(frame, s))),
        pass(scene, frame, look.water.ior, plan.made, swell_of(plan)),
        strength(look.of<WaveNormals>().strength) {
    surface.make(frame, pass, *make_executor(threads), simd);
  }
  float at(int x, int y) const { return surface.depth().view().at(x, y); }

  glm::dvec3 point(int x, int y, double depth) const {
    const Rays& r = pass.rays;
    return pass.eye + r.origin_at(x + 0.5, y + 0.5) + depth * r.ray_at(x + 0.5, y + 0.5);
  }
  double under(int x, int y) const {
    return glm::dot(scene.water->up, pass.rays.ray_at(x + 0.5, y + 0.5));
  }
  /// Height of a point of the ray above the water of optics/waves.h.
  double over(int x, int y, double depth) const {
    const glm::dvec3 p = point(x, y, depth);
    const PlaneAxes axes = plane_axes(scene.water->up);
    const double wave =
        wave_height(pass.waves, glm::dot(p, axes.x), glm::dot(p, axes.y), scene.time).height;
    return glm::dot(scene.water->up, p) - scene.water->height - strength * wave;
  }
  /// The first crossing of the water beyond a depth, by many small steps.
  double searched(int x, int y, double from, double to) const {
    constexpr int kSteps = 2000;
    const bool above = over(x, y, from) >= 0;
    double low = from;
    for (int i = 1; i <= kSteps; ++i) {
      double high = from + (to - from) * i / kSteps;
      if ((over(x, y, high) >= 0) == above) {
        low = high;
        continue;
      }
      for (int k = 0; k < 50; ++k) {
        const double mid = (low + high) / 2;
        ((over(x, y, mid) >= 0) == above ? low : high) = mid;
      }
      return high;
    }
    return kInf;
  }

  Buffers buffers = bare();
  Frame frame = buffers.frame;
  Scene scene;
  Plan plan;
  Pass pass;
  double strength;
  DisplacedSurface surface;
};

/// In double, and on each instruction set.
template <class Fn>
void on_all(Fn&& fn) {
  fn(nullptr);
  for (const std::string& simd : simd_targets()) {
    SCOPED_TRACE(simd);
    fn(&simd);
  }
}

template <class Fn>
void for_each_pixel(Fn&& fn) {
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) fn(x, y);
  }
}

TEST(DisplacedSurface, IsWhereASearchBySmallStepsFindsIt) {
  on_all([](const std::string* simd) {
    const Made made(scene_at(1.2, 0.7), simd);
    double differs = 0;
    for_each_pixel([&](int x, int y) {
      const double calm = 1.2 / -made.under(x, y);
      const double searched = made.searched(x, y, 0.9 * calm, 1.1 * calm);
      EXPECT_NEAR(made.at(x, y), searched, 3e-6 * searched) << x << ", " << y;
      differs = std::max(differs, std::abs(searched - calm) / calm);
    });
    EXPECT_GT(differs, 0.03);  // from the calm plane
  });
}

/// At angles at which crests hide the water behind them a crest may be missed, but each depth found
/// lies on the water, and before this depth there is at most a crest between two steps.
TEST(DisplacedSurface, LiesOnTheWaterAtGrazingAngles) {
  on_all([](const std::string* simd) {
    const Made made(scene_at(0.4, 0.2), simd);
    int first = 0, all = 0;
    for_each_pixel([&](int x, int y) {
      if (made.under(x, y) > -0.02) return;
      const double depth = made.at(x, y), calm = 0.4 / -made.under(x, y);
      ASSERT_TRUE(std::isfinite(depth)) << x << ", " << y;
      EXPECT_NEAR(made.over(x, y, depth), 0, 2e-6 + 2e-6 * depth) << x << ", " << y;
      ++all;
      first += std::abs(made.searched(x, y, 0.8 * calm, 1.2 * calm) - depth) < 1e-4 * depth;
    });
    EXPECT_GT(all, 500);
    EXPECT_GT(first, 0.97 * all);
  });
}

TEST(DisplacedSurface, OfAParallelViewFromAboveIsTheHeightItself) {
  on_all([](const std::string* simd) {
    for (const double height : {2.0, 0.5}) {  // nearer than a unit of the scene, too
      const Made made(seen_in_parallel(height), simd);
      for_each_pixel([&](int x, int y) {
        EXPECT_NEAR(made.at(x, y), height + made.over(x, y, height), 1e-6) << x << ", " << y;
      });
    }
  });
}

TEST(DisplacedSurface, IsTheSameInAnyUnitOfLength) {
  on_all([](const std::string* simd) {
    const Scene metres = scene_at(1.2, 0.7);
    const Made judge(metres, simd);
    for (const double unit : {1e-3, 1e3}) {
      Scene scene = metres;
      scene.camera->view[3] *= glm::dvec4(unit, unit, unit, 1);
      scene.camera->projection = perspective(0.7, double(kSize.width) / kSize.height, kNear * unit,
                                             1e3 * unit, ClipSpace::kGl);
      scene.water->height *= unit;
      for (SineWave& wave : scene.water->waves) {
        wave.amplitude *= unit, wave.k_x /= unit, wave.k_y /= unit;
      }
      const Made made(scene, simd);
      for_each_pixel([&](int x, int y) {
        EXPECT_NEAR(made.at(x, y) / unit, judge.at(x, y), 1e-5) << x << ", " << y;
      });
    }
  });
}

TEST(DisplacedSurface, HasNoNanAtTheHorizonAndNoWaterOverIt) {
  on_all([](const std::string* simd) {
    const Made made(scene_at(0.5, 0), simd);  // whose horizon lies between two rows
    for_each_pixel([&](int x, int y) {
      EXPECT_EQ(std::isfinite(made.at(x, y)), made.under(x, y) < 0) << x << ", " << y;
      EXPECT_GT(made.at(x, y), 0) << x << ", " << y;
    });
  });
}

/// Eyes just above the highest crest, between the waves, and in the water.
TEST(DisplacedSurface, IsMetFromEverywhereWithoutNan) {
  on_all([](const std::string* simd) {
    for (const double height : {0.0631, 0.05, 0.0, -0.05, -0.2}) {
      for (const double pitch : {0.0, 0.3, -0.3}) {
        SCOPED_TRACE(testing::Message() << "eye at " << height << ", down by " << pitch);
        const Made made(scene_at(height, pitch), simd);
        for_each_pixel([&](int x, int y) {
          const double depth = made.at(x, y), begin = made.over(x, y, kNear);
          ASSERT_GE(depth, kNear * (1 - 1e-6)) << x << ", " << y;
          // A ray through the whole range of the waves' heights meets the water.
          if (begin > 1e-5 && made.under(x, y) < -1e-9) {
            EXPECT_TRUE(std::isfinite(depth));
          }
          if (begin < -1e-5 && made.under(x, y) > 1e-9) {
            EXPECT_TRUE(std::isfinite(depth));
          }
          if (depth < 1e3) {
            EXPECT_NEAR(made.over(x, y, depth), 0, 1e-5 * (1 + depth));
          }
        });
      }
    }
  });
}

TEST(DisplacedSurface, IsHugeWavesOrNoneWithoutNan) {
  on_all([](const std::string* simd) {
    for (const SineWave& wave : {SineWave{1e6, 1e6, 0, 0, 1}, SineWave{1e300, 1, 0, 0, 1},
                                 SineWave{0, 1, 1, 0, 1}, SineWave{1e-30, 1e300, 0, 0, 1}}) {
      const Made made(scene_at(1, 0.3, {wave}), simd);
      for_each_pixel([&](int x, int y) { ASSERT_FALSE(std::isnan(made.at(x, y))); });
    }
  });
}

TEST(DisplacedSurface, DoesNotDependOnTheThreads) {
  on_all([](const std::string* simd) {
    const Made one(scene_at(0.5, 0.2), simd, sines(), 1),
        five(scene_at(0.5, 0.2), simd, sines(), 5);
    for_each_pixel([&](int x, int y) { ASSERT_EQ(one.at(x, y), five.at(x, y)); });
  });
}

TEST(DisplacedSurface, IsOfTheLooksWavesTimesItsStrength) {
  on_all([](const std::string* simd) {
    const std::vector<SineWave> own{{0.05, 1, 2, 0.3, 1}};
    const Made made(scene_at(1.2, 0.7), simd, sines(0.5, own));
    ASSERT_EQ(made.pass.waves.size(), 1u);
    for_each_pixel([&](int x, int y) {
      EXPECT_NEAR(made.over(x, y, made.at(x, y)), 0, 1e-5) << x << ", " << y;
    });
  });
}

// --- decides whether the surface is made ---------------------------------------------------------

bool is_made(const Look& look, const Frame& frame, const Scene& scene) {
  return make_plan(look, test::inputs_of(frame, scene)).completed.has(PlaneId::kSurfaceDepth);
}

TEST(DisplacedSurface, IsMadeForKnownWavesAlone) {
  const Buffers b = bare();
  const Scene wavy = scene_at(1, 0.3), calm = scene_at(1, 0.3, {});
  EXPECT_TRUE(is_made(sines(), b.frame, wavy));
  EXPECT_TRUE(is_made(sines(1, kWaves), b.frame, calm));
  EXPECT_FALSE(is_made(sines(), b.frame, calm)) << "no waves";
  EXPECT_FALSE(is_made(sines(0), b.frame, wavy)) << "strength 0";
  Look mapped = sines();
  mapped.of<WaveNormals>().model = WaveNormals::Model::kSlopes;
  EXPECT_FALSE(is_made(mapped, b.frame, wavy)) << "a map has no height";
}

TEST(DisplacedSurface, IsNotMadeWhereThePlateKnowsBetter) {
  const Scene wavy = scene_at(1, 0.3);
  Buffers with_depth = bare(), with_normals = bare();
  with_depth.fill(PlaneId::kSurfaceDepth, 2);
  with_normals.normal({0, 1, 0});
  EXPECT_FALSE(is_made(sines(), with_depth.frame, wavy));
  EXPECT_FALSE(is_made(sines(), with_normals.frame, wavy));
}

TEST(DisplacedSurface, IsToldByThePlan) {
  const Plan plan = make_plan(sines(), test::inputs_of(bare().frame, scene_at(1, 0.3)));
  EXPECT_EQ(plan.of<WaveNormals>().reason, "displaced_surface is computed");
  EXPECT_EQ(plan.of<WaveNormals>().rule, "complete_planes");
}

// --- pictures of the surface ---------------------------------------------------------------------

/// A beach that falls away from the camera and goes through the calm water, and the runs on it.
struct Beach {
  static constexpr double kSlope = 0.1;
  /// Height over the calm water.
  static double height(const glm::dvec3& p) { return kSlope * (p.z - 17.5); }

  Beach() {
    buffers.set(PlaneId::kDepth, [&](int x, int y) { return static_cast<float>(depth(x, y)); });
  }
  double depth(int x, int y) const {
    const glm::dvec3 at = made.point(x, y, 0), ray = made.point(x, y, 1) - at;
    const double falls = ray.y - kSlope * ray.z;
    return falls < 0 ? (kSlope * (at.z - 17.5) - (at.y - 1)) / falls : kInf;
  }

  Made made{scene_at(1.2, 0.6), nullptr};
  Buffers buffers = bare();
};

using Runner = test::Picture (*)(const Look&, const Frame&, const Scene&);
test::Picture run_fast(const Look& look, const Frame& frame, const Scene& scene) {
  return test::fused(look, frame, scene);
}

TEST(DisplacedSurface, MovesTheWaterline) {
  const Beach beach;
  for (const Runner run : {Runner{&test::reference}, Runner{&run_fast}}) {
    const test::Picture p = run(sines(), beach.buffers.frame, beach.made.scene);
    int higher = 0, lower = 0;
    for_each_pixel([&](int x, int y) {
      const double dry = beach.depth(x, y);
      const double over = beach.made.over(x, y, dry), calm = beach.made.point(x, y, dry).y - 1;
      if (std::abs(over) < 1e-5) return;  // too close for float
      const bool wet = over < 0;
      EXPECT_EQ(std::isfinite(p.aov(Aov::kSurfaceDepth, x, y)), wet) << x << ", " << y;
      higher += wet && calm > 0;
      lower += !wet && calm < 0;
    });
    EXPECT_GT(higher, 20);
    EXPECT_GT(lower, 20);
  }
}

/// Both runners agree within rounding, by which their reads of the surface differ.
TEST(DisplacedSurface, IsTheSameToBothRunners) {
  const Beach beach;
  Look look = sines();
  look.of<Refraction>() = {};
  look.of<DepthFog>() = {};
  const test::Picture judge = test::reference(look, beach.buffers.frame, beach.made.scene);
  const test::Picture fast = test::fused(look, beach.buffers.frame, beach.made.scene);
  for_each_pixel([&](int x, int y) {
    const double depth = judge.aov(Aov::kSurfaceDepth, x, y);
    if (!std::isfinite(depth)) return;
    EXPECT_NEAR(fast.aov(Aov::kSurfaceDepth, x, y), depth, 3e-6 * depth);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(fast.aov(Aov::kNormal, x, y, i), judge.aov(Aov::kNormal, x, y, i), 1e-5);
    }
  });
}

TEST(DisplacedSurface, GivesWayToThePlates) {
  Beach beach;
  beach.buffers.fill(PlaneId::kSurfaceDepth, 0.25f);
  const test::Picture p = test::fused(sines(), beach.buffers.frame, beach.made.scene);
  for_each_pixel([&](int x, int y) { ASSERT_EQ(p.aov(Aov::kSurfaceDepth, x, y), 0.25); });
}

}  // namespace
}  // namespace limpid
