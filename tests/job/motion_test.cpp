#include "job/motion.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "limpid/core/error.h"
#include "limpid/core/scene.h"
#include "limpid/files/exr/exr_file.h"
#include "limpid/files/exr/exr_writer.h"
#include "limpid/files/text/look_file.h"
#include "limpid/job/composite.h"

#include "job/parallax.h"
#include "job/screen.h"

/// Motion vectors of the bottom behind the water, and of objects that the water mirrors.

namespace limpid {
namespace {

namespace fs = std::filesystem;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
using Value = std::function<double(int x, int y)>;

Plane plane_of(const Rect& window, const Value& value) {
  Plane plane(window);
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      plane.view().at(x, y) = static_cast<float>(value(x, y));
    }
  }
  return plane;
}

/// A map that looks up (ax x + bx y + cx, ...) at the pixel (x, y), y down.
class Lens {
 public:
  Lens(const std::function<std::array<double, 2>(double x, double y)>& place, float depth = 1)
      : u_(plane_of(kDisplay,
                    [&](int x, int y) { return place(x + 0.5, y + 0.5)[0] / kDisplay.width(); })),
        v_(plane_of(
            kDisplay,
            [&](int x, int y) { return 1 - place(x + 0.5, y + 0.5)[1] / kDisplay.height(); })),
        depth_(plane_of(kDisplay, [&](int, int) { return depth; })) {}

  LookedUp looked_up() const { return {u_.view(), v_.view(), depth_.view(), kDisplay}; }

  /// Vectors that grow to the right and down, carried through the lookup.
  std::array<Plane, 2> carried(const Rect& window = kDisplay) const {
    const Plane x = plane_of(kDisplay, [](int px, int) { return 2 + px; });
    const Plane y = plane_of(kDisplay, [](int, int py) { return -3 - py; });
    std::array<Plane, 2> seen{Plane(window), Plane(window)};
    carry_motion(looked_up(), x.view(), y.view(), seen[0].view(), seen[1].view());
    return seen;
  }

  static constexpr Rect kDisplay{0, 0, 40, 30};

 private:
  Plane u_, v_, depth_;
};

TEST(Motion, OfDryPixelsIsThePlates) {
  const Lens lens([](double x, double y) { return std::array{y, x}; }, kInfinity);
  const auto seen = lens.carried();
  EXPECT_EQ(seen[0].view().at(7, 9), 9);
  EXPECT_EQ(seen[1].view().at(7, 9), -12);
}

TEST(Motion, IsTurnedAndStretchedAsTheLookupIs) {
  // The place moves by (1.5, -0.25) and (0.5, 0.8) for a step to the right and down.
  const Lens lens([](double x, double y) {
    return std::array{1.5 * x + 0.5 * y - 15, -0.25 * x + 0.8 * y + 5};
  });
  const auto seen = lens.carried();
  const int x = 20, y = 12;
  const double from_x = std::floor(1.5 * 20.5 + 0.5 * 12.5 - 15);
  const double from_y = std::floor(-0.25 * 20.5 + 0.8 * 12.5 + 5);
  const double dx = seen[0].view().at(x, y), dy = -seen[1].view().at(x, y);
  EXPECT_NEAR(1.5 * dx + 0.5 * dy, 2 + from_x, 1e-3);
  EXPECT_NEAR(-0.25 * dx + 0.8 * dy, 3 + from_y, 1e-3);
  // At the rim there are no slopes: the result is the texel's own vector.
  EXPECT_EQ(seen[0].view().at(0, 12), 2 + std::floor(0.75 + 6.25 - 15 < 0 ? 0 : 0.75 + 6.25 - 15));
}

TEST(Motion, OfFoldsIsTheTexels) {
  const Lens mirrored([](double x, double y) { return std::array{39 - x, y}; });
  const auto seen = mirrored.carried();
  EXPECT_EQ(seen[0].view().at(10, 10), 2 + std::floor(39 - 10.5));
  EXPECT_EQ(seen[1].view().at(10, 10), -13);
}

TEST(Motion, IsFinite) {
  const Lens lens([](double x, double y) { return std::array{x, y}; });
  const Plane bad = plane_of(Lens::kDisplay, [](int x, int) {
    return x == 3 ? std::nan("") : x == 4 ? HUGE_VAL : 1;
  });
  std::array<Plane, 2> seen{Plane(Lens::kDisplay), Plane(Lens::kDisplay)};
  carry_motion(lens.looked_up(), bad.view(), bad.view(), seen[0].view(), seen[1].view());
  EXPECT_EQ(seen[0].view().at(3, 5), 0);
  EXPECT_EQ(seen[1].view().at(4, 5), 0);
  EXPECT_NEAR(seen[0].view().at(6, 5), 1, 1e-5);
}

/// The water mirrors a wall 8 in front of a level camera, which stands 1.5 above the water.
class WallTest : public ::testing::Test {
 protected:
  static constexpr Rect kDisplay{0, 0, 80, 60};
  static constexpr double kWall = 8, kEye = 1.5;

  WallTest() {
    scene_.camera = Camera{glm::lookAt(glm::dvec3(0, kEye, 0), glm::dvec3(0, kEye, -1), {0, 1, 0}),
                           perspective(glm::radians(60.0), 80.0 / 60, 0.1, 100, ClipSpace::kGl),
                           ClipSpace::kGl};
    scene_.water = WaterPlane{{0, 1, 0}, 0};
  }

  /// The vectors (2, 1 + row / 10), reflected by a normal that leans by the angle `lean` to the
  /// right; the picture has the depth `shown`, the mirror image the depth `image`.
  std::array<Plane, 2> reflected(double lean = 0, double shown = kWall,
                                 double image = kWall) const {
    const auto constant = [](double value) {
      return plane_of(kDisplay, [=](int, int) { return value; });
    };
    const WaterView view(scene_, kDisplay);
    const Plane surface = plane_of(kDisplay, [&](int x, int y) {
      const double z = -kEye / view.rays.ray_at(x + 0.5, y + 0.5).y;
      return z > 0 && z < kWall ? z : HUGE_VAL;
    });
    const Plane nx = constant(std::sin(lean)), ny = constant(std::cos(lean)), nz = constant(0);
    const Plane depth = constant(shown), mirror = constant(image), x = constant(2);
    const Plane y = plane_of(kDisplay, [](int, int row) { return 1 + row / 10.0; });
    std::array<Plane, 2> seen{Plane(kDisplay), Plane(kDisplay)};
    reflect_motion(
        {surface.view(), nx.view(), ny.view(), nz.view(), mirror.view(), depth.view(), view},
        x.view(), y.view(), seen[0].view(), seen[1].view());
    return seen;
  }

  Scene scene_;
};

// The horizon lies between the rows 29 and 30, the wall's foot 1.5 / 8 * 30 / tan 30 = 9.7 rows
// below the horizon. The image of a point at the height h is at -h: twice those rows further below
// the horizon than the point is above the horizon.
TEST_F(WallTest, IsTheThingsUpsideDown) {
  const auto seen = reflected();
  for (const int below : {11, 15, 25}) {
    const double rows_to_foot = 1.5 / 8 * 30 / std::tan(glm::radians(30.0));
    const double row = 30 - (below + 0.5 - 2 * rows_to_foot);
    const int thing = static_cast<int>(std::floor(row));
    for (const int column : {5, 40, 77}) {
      EXPECT_NEAR(seen[0].view().at(column, 30 + below), 2, 1e-4) << below;
      EXPECT_NEAR(seen[1].view().at(column, 30 + below), -(1 + thing / 10.0), 1e-4) << below;
    }
  }
  EXPECT_EQ(seen[0].view().at(40, 20), 0) << "dry";
  EXPECT_EQ(seen[0].view().at(40, 35), 0) << "the wall's foot";
}

// A mirrored point moves by the matrix 1 - 2 n n^T, which is its own inverse.
TEST_F(WallTest, IsTurnedAsTheNormalSays) {
  const double lean = glm::radians(-10.0);
  const auto seen = reflected(lean);
  const double c = std::cos(2 * lean), s = std::sin(2 * lean);
  int found = 0;
  for (int y = 42; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      const double dx = seen[0].view().at(x, y), dy = seen[1].view().at(x, y);
      if (dx == 0 && dy == 0) continue;
      ++found;
      EXPECT_NEAR(c * dx - s * dy, 2, 1e-4) << x << " " << y;
      EXPECT_GE(-s * dx - c * dy, 1 - 1e-4) << x << " " << y;
    }
  }
  EXPECT_GT(found, 50);
}

TEST_F(WallTest, IsNoneOfWhatThePictureDoesNotShow) {
  const std::array<Plane, 2> hidden = reflected(0, 7), sky = reflected(0, kWall, HUGE_VAL);
  for (const auto& seen : {std::cref(hidden), std::cref(sky)}) {
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 80; ++x) {
        EXPECT_EQ(seen.get()[0].view().at(x, y), 0);
        EXPECT_EQ(seen.get()[1].view().at(x, y), 0);
      }
    }
  }
  // A normal that leans by 40 degrees reflects points outside the picture, far to the right.
  EXPECT_EQ(reflected(glm::radians(40.0))[0].view().at(75, 50), 0);
}

/// A light spot moves on the bottom of a pool; the water is calm, the camera stands still.
class SpotTest : public ::testing::Test {
 protected:
  SpotTest()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("motion_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    camera_.view = glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 2 - 0.6, -1), {0, 1, 0});
    camera_.projection = perspective(glm::radians(50.0), 160.0 / 90, 0.1, 100, ClipSpace::kGl);
  }
  ~SpotTest() override { fs::remove_all(folder_); }

  static constexpr Rect kPicture{0, 0, 160, 90};
  static constexpr double kBottom = -1.5;

  /// The point of the bottom that a pixel shows; w = 0: none.
  glm::dvec4 bottom(int x, int y) const {
    const Rays rays = rays_of(camera_, {kPicture.width(), kPicture.height()});
    const glm::dvec3 ray = rays.ray_at(x + 0.5, y + 0.5);
    const double distance = (kBottom - camera_.eye().y) / ray.y;
    if (!(distance > 0)) return {0, 0, 0, 0};
    return {camera_.eye() + distance * ray, 1};
  }
  glm::dvec2 on_screen(const glm::dvec4& world) const {
    const glm::dvec4 clip = camera_.projection * camera_.view * world;
    return {(clip.x / clip.w + 1) / 2 * kPicture.width(),
            (1 - clip.y / clip.w) / 2 * kPicture.height()};
  }

  /// Writes the spot at a place of the bottom, and the vectors of a bottom that moves by `step`.
  void write(const std::string& name, glm::dvec3 spot, glm::dvec3 step) const {
    std::vector<Plane> planes;
    ExrOutput output;
    output.data = output.display = kPicture;
    planes.reserve(8);
    const auto add = [&](const std::string& channel, const Value& value) {
      planes.push_back(plane_of(kPicture, value));
      output.channels.push_back({channel, planes.back().view(), false});
    };
    for (const char* channel : {"R", "G", "B"}) {
      add(channel, [&](int x, int y) {
        const glm::dvec4 p = bottom(x, y);
        const double away = glm::length(glm::dvec3(p) - spot);
        return p.w > 0 ? std::exp(-away * away / (2 * 0.25 * 0.25)) : 0;
      });
    }
    add("depth.Z", [&](int x, int y) {
      const glm::dvec4 p = bottom(x, y);
      return p.w > 0 ? -(camera_.view * p).z : HUGE_VAL;
    });
    const auto motion = [&](int x, int y) {
      const glm::dvec4 p = bottom(x, y);
      if (!(p.w > 0)) return glm::dvec2(0);
      return on_screen(p + glm::dvec4(step, 0)) - glm::dvec2(x + 0.5, y + 0.5);
    };
    add("forward.u", [&](int x, int y) { return motion(x, y).x; });
    add("forward.v", [&](int x, int y) { return -motion(x, y).y; });
    write_exr(folder_ / name, output);
  }

  CompositeJob job(const std::string& plate, const std::string& output) const {
    CompositeJob job;
    job.plate.files = {folder_ / plate};
    job.scene.scene.water = WaterPlane{{0, 1, 0}, 0};
    job.scene.camera = CameraSpec{};
    job.scene.camera->view = camera_.view;
    job.scene.camera->lens = CameraSpec::Lens::kProjection;
    job.scene.camera->projection = camera_.projection;
    for (const char* setting :
         {"wave_normals.strength=0", "prism_split.gain=0", "caustics.strength=0",
          "depth_fog.water_type=custom", "depth_fog.absorption=[0, 0, 0]",
          "depth_fog.scattering=[0, 0, 0]", "fresnel_reflection.source=constant"}) {
      apply_setting(job.look, setting);
    }
    job.output.picture = folder_ / output;
    job.output.aovs = {Aov::kTransmitted};
    job.output.store_float = true;
    job.output.motion = true;
    return job;
  }
  std::vector<Plane> read(const std::string& file, const std::vector<std::string>& channels) const {
    std::vector<Plane> planes;
    const ExrFile exr = ExrFile::open(folder_ / file);
    for (const std::string& channel : channels) {
      planes.emplace_back(kPicture);
      exr.read(std::array{ExrRequest{0, channel, planes.back().view()}});
    }
    return planes;
  }
  /// The mean of a value over the light of the spot.
  static double mean(const Plane& light, const Value& value) {
    double sum = 0, all = 0;
    for (int y = 0; y < kPicture.y1; ++y) {
      for (int x = 0; x < kPicture.x1; ++x) {
        const double weight = light.view().at(x, y);
        sum += weight * value(x, y);
        all += weight;
      }
    }
    return sum / all;
  }
  static glm::dvec2 centre(const Plane& light) {
    return {mean(light, [](int x, int) { return x; }), mean(light, [](int, int y) { return y; })};
  }

  fs::path folder_;
  Camera camera_;
};

TEST_F(SpotTest, IsWhereTheNextFrameShowsIt) {
  const glm::dvec3 spot(0.3, kBottom, -4);
  const auto executor = make_executor(1);
  for (const glm::dvec3 step :
       {glm::dvec3(0.2, 0, 0), glm::dvec3(0, 0, 0.2), glm::dvec3(-0.1, 0, -0.15)}) {
    write("now.exr", spot, step);
    write("then.exr", spot + step, step);
    composite(job("now.exr", "wet_now.exr"), *executor);
    composite(job("then.exr", "wet_then.exr"), *executor);
    const std::vector<Plane> now =
        read("wet_now.exr", {"transmitted.R", "motion_forward.u", "motion_forward.v"});
    const std::vector<Plane> then = read("wet_then.exr", {"transmitted.R"});
    const std::vector<Plane> dry = read("now.exr", {"R", "forward.u", "forward.v"});
    const glm::dvec2 rendered = centre(then[0]) - centre(now[0]);
    const auto predicted_by = [](const std::vector<Plane>& of) {
      return glm::dvec2(mean(of[0], [&](int x, int y) { return of[1].view().at(x, y); }),
                        -mean(of[0], [&](int x, int y) { return of[2].view().at(x, y); }));
    };
    const double error = glm::length(predicted_by(now) - rendered);
    const double of_dry = glm::length(predicted_by(dry) - rendered);
    EXPECT_GT(glm::length(rendered), 2) << "there is something to tell";
    EXPECT_LT(error, 0.03 * glm::length(rendered));
    EXPECT_LT(error, 0.3 * of_dry) << "the dry picture's vectors are worse";
    RecordProperty("pixels", std::to_string(glm::length(rendered)) + ", error " +
                                 std::to_string(error) + ", of the dry vectors " +
                                 std::to_string(of_dry));
  }
}

/// The spot stands still, and the camera moves; the plates' vectors are not used.
TEST_F(SpotTest, LeadsToWhereTheSecondFrameShowsIt) {
  const glm::dvec3 spot(0.3, kBottom, -4);
  const auto executor = make_executor(1);
  const Camera start = camera_;
  for (const bool previous : {false, true}) {
    for (const glm::dvec3 step : {glm::dvec3(0.3, 0, 0), glm::dvec3(0, 0.3, -0.2)}) {
      camera_ = start;
      write("now.exr", spot, {});
      CompositeJob now_job = job("now.exr", "wet_now.exr");
      camera_.view = glm::translate(start.view, -step);
      write("then.exr", spot, {});
      const CompositeJob then_job = job("then.exr", "wet_then.exr");
      now_job.second = {then_job.plate, then_job.scene, {}, previous};
      composite(now_job, *executor);
      CompositeJob unmoved = then_job;
      composite(unmoved, *executor);
      const std::string layer = previous ? "motion_backward" : "motion_forward";
      const std::vector<Plane> now =
          read("wet_now.exr", {"transmitted.R", layer + ".u", layer + ".v"});
      const std::vector<Plane> then = read("wet_then.exr", {"transmitted.R"});
      const glm::dvec2 rendered = centre(then[0]) - centre(now[0]);
      const glm::dvec2 predicted(
          mean(now[0], [&](int x, int y) { return now[1].view().at(x, y); }),
          -mean(now[0], [&](int x, int y) { return now[2].view().at(x, y); }));
      EXPECT_GT(glm::length(rendered), 2) << "there is something to tell";
      EXPECT_LT(glm::length(predicted - rendered), 0.03 * glm::length(rendered));
    }
  }
}

/// The same over waves, judged at each pixel by what the second frame's own lookups and normals
/// show in the place that the vectors lead to.
class WavesTest : public SpotTest {
 protected:
  /// Mean distances, in pixels, on the second picture: between the points of the bottom that are
  /// seen through the water at both ends of the vectors, and between the directions of the sky
  /// that are mirrored there.
  struct Off {
    double seen = 0, mirrored = 0;
  };
  struct Judged {
    Off with_waves, calm;
  };

  Judged judged(const std::vector<SineWave>& waves, const glm::dvec3& step, double seconds) {
    const Camera start = camera_;
    write("now.exr", {0, kBottom, -4}, {});
    CompositeJob now = job_over(waves, "now.exr", "wet_now.exr", 0);
    camera_.view = glm::translate(start.view, -step);
    write("then.exr", {0, kBottom, -4}, {});
    const CompositeJob then = job_over(waves, "then.exr", "wet_then.exr", seconds);
    now.second = {then.plate, then.scene};
    const auto executor = make_executor(2);
    composite(now, *executor);
    composite(then, *executor);
    const WaterView first(scene(start), kPicture), second(scene(camera_), kPicture);
    const Shown shows(*this, "wet_now.exr", first), shows_then(*this, "wet_then.exr", second);
    const std::vector<Plane> made =
        read("wet_now.exr", {"motion_forward.u", "motion_forward.v", "motion_reflected_forward.u",
                             "motion_reflected_forward.v"});
    std::vector<Plane> calm;
    for (int i = 0; i < 4; ++i) calm.emplace_back(kPicture);
    const Parallax parallax(first, second, now.look.water.ior);
    const Plane depth = std::move(read("now.exr", {"depth.Z"}).front());
    const auto& of = shows.planes;
    parallax.seen({of[0].view(), of[1].view(), of[2].view(), kPicture}, depth.view(),
                  calm[0].view(), calm[1].view(), *executor);
    parallax.reflected(
        {of[2].view(), of[3].view(), of[4].view(), of[5].view(), of[6].view(), depth.view(), first},
        calm[2].view(), calm[3].view(), *executor);
    return {off(shows, shows_then, made), off(shows, shows_then, calm)};
  }

 private:
  CompositeJob job_over(const std::vector<SineWave>& waves, const std::string& plate,
                        const std::string& output, double seconds) const {
    CompositeJob job = this->job(plate, output);
    job.scene.scene.water->waves = waves;
    job.scene.scene.time = seconds;
    job.scene.time = seconds;
    apply_setting(job.look, "wave_normals.model=sines");
    apply_setting(job.look, "wave_normals.strength=1");
    apply_setting(job.look, "wave_normals.filter=none");
    job.output.aovs = {Aov::kStmapG, Aov::kSurfaceDepth, Aov::kNormal, Aov::kReflectionDepth};
    job.output.motion_reflected = true;
    return job;
  }
  static Scene scene(const Camera& camera) {
    Scene scene;
    scene.camera = camera;
    scene.water = WaterPlane{{0, 1, 0}, 0};
    return scene;
  }

  /// What a wet picture shows.
  struct Shown {
    Shown(const WavesTest& test, const std::string& file, const WaterView& of_view)
        : planes(test.read(file, {"stmap.g.U", "stmap.g.V", "surface_depth.Z", "normal.X",
                                  "normal.Y", "normal.Z", "reflection_depth.Z"})),
          view(of_view) {}

    /// Bilinear, in place of pixels; NaN beyond the water.
    double at(std::size_t plane, glm::dvec2 place) const {
      const int x = static_cast<int>(std::floor(place.x - 0.5));
      const int y = static_cast<int>(std::floor(place.y - 0.5));
      if (!kPicture.contains({x, y, x + 2, y + 2})) return NAN;
      const double right = place.x - 0.5 - x, below = place.y - 0.5 - y;
      double sum = 0;
      for (const int j : {0, 1}) {
        for (const int i : {0, 1}) {
          if (!std::isfinite(planes[2].view().at(x + i, y + j))) return NAN;
          sum += (i ? right : 1 - right) * (j ? below : 1 - below) *
                 planes[plane].view().at(x + i, y + j);
        }
      }
      return sum;
    }
    /// Whether the place looks up what the picture shows: beyond it the bottom is a guess.
    bool looks_within(glm::dvec2 place) const {
      const double u = at(0, place) * kPicture.width(), v = at(1, place) * kPicture.height();
      return u > 1 && v > 1 && u < kPicture.width() - 1 && v < kPicture.height() - 1;
    }
    /// The point of the bottom that the place looks up.
    glm::dvec3 bottom(glm::dvec2 place) const {
      const glm::dvec3 ray =
          view.rays.ray_at(at(0, place) * kPicture.width(), (1 - at(1, place)) * kPicture.height());
      return view.eye + (kBottom - view.eye.y) / ray.y * ray;
    }
    /// The direction from which its mirrored light comes.
    glm::dvec3 sky(glm::dvec2 place) const {
      const glm::dvec3 normal =
          glm::normalize(glm::dvec3(at(3, place), at(4, place), at(5, place)));
      return glm::reflect(view.rays.ray_at(place.x, place.y), normal);
    }

    std::vector<Plane> planes;
    const WaterView& view;
  };

  static Off off(const Shown& now, const Shown& then, const std::vector<Plane>& vectors) {
    const Screen screen(then.view);
    Off mean;
    int seen = 0, mirrored = 0;
    // Away from the sides of the picture and from the horizon.
    for (int y = kPicture.y1 / 2; y < kPicture.y1 - 10; ++y) {
      for (int x = 10; x < kPicture.x1 - 10; ++x) {
        const glm::dvec2 here(x + 0.5, y + 0.5);
        const auto to = [&](std::size_t u) {
          return here + glm::dvec2(vectors[u].view().at(x, y), -vectors[u + 1].view().at(x, y));
        };
        const auto bottom = screen.place_of(now.bottom(here) - then.view.eye);
        const auto shown = screen.place_of(then.bottom(to(0)) - then.view.eye);
        if (bottom && shown && now.looks_within(here) && then.looks_within(to(0))) {
          mean.seen += std::hypot(shown->x - bottom->x, shown->y - bottom->y);
          ++seen;
        }
        const auto calm = [&](const glm::dvec3& sky) {
          return screen.place_of_direction({sky.x, -sky.y, sky.z});
        };
        const auto sky = calm(now.sky(here)), there = calm(then.sky(to(2)));
        if (sky && there && std::isfinite(there->x)) {
          mean.mirrored += std::hypot(there->x - sky->x, there->y - sky->y);
          ++mirrored;
        }
      }
    }
    EXPECT_GT(seen, 2000);
    EXPECT_GT(mirrored, 2000);
    return {mean.seen / seen, mean.mirrored / mirrored};
  }
};

TEST_F(WavesTest, LeadsToTheSamePointThroughGentleWaves) {
  const std::vector<SineWave> waves{{0.008, 3, 1, 0.4, 5}, {0.005, -1, 4, 1.9, 6}};
  for (const glm::dvec3 step : {glm::dvec3(0), glm::dvec3(0.1, 0, -0.05)}) {
    const Judged off = judged(waves, step, 0.25);
    EXPECT_GT(off.calm.seen, 0.3) << "there is something to tell";
    EXPECT_GT(off.calm.mirrored, 3);
    EXPECT_LT(off.with_waves.seen, 0.02 * off.calm.seen);
    EXPECT_LT(off.with_waves.mirrored, 0.05 * off.calm.mirrored);
    RecordProperty("pixels", std::to_string(off.with_waves.seen) + " of " +
                                 std::to_string(off.calm.seen) + ", mirrored " +
                                 std::to_string(off.with_waves.mirrored) + " of " +
                                 std::to_string(off.calm.mirrored));
  }
}

/// Waves that focus what is below them show it at several places.
TEST_F(WavesTest, IsBetterThanOfCalmWaterThroughSteepWaves) {
  const std::vector<SineWave> waves{{0.02, 9, 3, 0.4, 9}, {0.01, -4, 12, 1.9, 11}};
  const Judged off = judged(waves, {0.1, 0, -0.05}, 1.0 / 24);
  EXPECT_LT(off.with_waves.seen, 0.5 * off.calm.seen);
  EXPECT_LT(off.with_waves.mirrored, 0.5 * off.calm.mirrored);
  RecordProperty("pixels", std::to_string(off.with_waves.seen) + " of " +
                               std::to_string(off.calm.seen) + ", mirrored " +
                               std::to_string(off.with_waves.mirrored) + " of " +
                               std::to_string(off.calm.mirrored));
}

TEST_F(WavesTest, IsZeroWhereNothingMoves) {
  judged({{0.02, 9, 3, 0.4, 9}, {0.01, -4, 12, 1.9, 11}}, {0, 0, 0}, 0);
  for (const Plane& plane : read(
           "wet_now.exr", {"motion_forward.u", "motion_forward.v", "motion_reflected_forward.u"})) {
    for (int y = 0; y < kPicture.y1; ++y) {
      for (int x = 0; x < kPicture.x1; ++x) EXPECT_NEAR(plane.view().at(x, y), 0, 1e-9);
    }
  }
}

TEST_F(SpotTest, LeadsToNoFrameUnderWater) {
  write("now.exr", {0, kBottom, -4}, {});
  CompositeJob job = this->job("now.exr", "wet.exr");
  SceneFile below = job.scene;
  below.camera->view = glm::translate(camera_.view, glm::dvec3(0, 3, 0));
  job.second = {job.plate, below};
  const auto executor = make_executor(1);
  try {
    composite(job, *executor);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("the next frame, for motion vectors: "));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("the camera of the second frame is -1.0"));
  }
  EXPECT_FALSE(fs::exists(folder_ / "wet.exr"));
}

TEST_F(SpotTest, MayBeOfWhatIsMirroredAlone) {
  const glm::dvec3 spot(0.3, kBottom, -4);
  write("now.exr", spot, {0.2, 0, 0});
  const auto executor = make_executor(1);
  CompositeJob job = this->job("now.exr", "wet.exr");
  job.output.motion_reflected = true;
  composite(job, *executor);
  const std::vector<Plane> both =
      read("wet.exr", {"motion_forward.u", "motion_reflected_forward.v"});
  EXPECT_NE(both[0].view().at(80, 60), 0);
  EXPECT_EQ(both[1].view().at(80, 60), 0) << "nothing but water is mirrored";
  job.output.motion = false;
  job.output.picture = folder_ / "reflected.exr";
  composite(job, *executor);
  read("reflected.exr", {"motion_reflected_forward.u"});
  const ExrFile file = ExrFile::open(folder_ / "reflected.exr");
  for (const ExrChannel& channel : file.parts().front().channels) {
    EXPECT_NE(channel.name, "motion_forward.u");
  }
  EXPECT_THAT(file.text_attribute(0, "limpid/options").value_or(""),
              ::testing::HasSubstr("motion_of = [\"reflected\"]"));
}

TEST_F(SpotTest, WantsVectorsOfThePlate) {
  write("now.exr", {0, kBottom, -4}, {});
  CompositeJob none = job("now.exr", "wet.exr");
  none.plate.motion = "speed";
  const auto executor = make_executor(1);
  try {
    composite(none, *executor);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("motion=speed: no such vectors"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("forward (v u)"));
  }
  EXPECT_FALSE(fs::exists(folder_ / "wet.exr"));
}

}  // namespace
}  // namespace limpid
