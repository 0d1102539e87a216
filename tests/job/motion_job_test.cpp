#include <cmath>
#include <filesystem>
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
#include "job/plane_of.h"
#include "job/screen.h"

/// Motion vectors of whole jobs, beside the place where the next frame shows a thing.

namespace limpid {
namespace {

namespace fs = std::filesystem;

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

  /// The normal that waves give to the calm surface where a pixel shows it; 0 where it shows none.
  glm::dvec3 normal(int x, int y, const std::vector<SineWave>& waves, double seconds) const {
    const Rays rays = rays_of(camera_, {kPicture.width(), kPicture.height()});
    const glm::dvec3 ray = rays.ray_at(x + 0.5, y + 0.5);
    if (!(ray.y < 0)) return glm::dvec3(0);
    const glm::dvec3 at = camera_.eye() - camera_.eye().y / ray.y * ray, up(0, 1, 0);
    const PlaneAxes axes = plane_axes(up);
    glm::dvec3 sum = up;
    for (const SineWave& w : waves) {
      const double phase =
          w.k_x * glm::dot(at, axes.x) + w.k_y * glm::dot(at, axes.y) + w.phase - w.omega * seconds;
      sum -= w.amplitude * std::cos(phase) * (w.k_x * axes.x + w.k_y * axes.y);
    }
    return glm::normalize(sum);
  }

  /// Writes the spot at a place of the bottom, the vectors of a bottom that moves by `step`, and
  /// the normals of waves, if there are any.
  void write(const std::string& name, glm::dvec3 spot, glm::dvec3 step,
             const std::vector<SineWave>& waves = {}, double seconds = 0) const {
    std::vector<Plane> planes;
    ExrOutput output;
    output.data = output.display = kPicture;
    planes.reserve(11);  // its views stay valid
    const auto add = [&](const std::string& channel, const PixelValue& value) {
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
    if (!waves.empty()) {
      add("surface.NX", [&](int x, int y) { return normal(x, y, waves, seconds).x; });
      add("surface.NY", [&](int x, int y) { return normal(x, y, waves, seconds).y; });
      add("surface.NZ", [&](int x, int y) { return normal(x, y, waves, seconds).z; });
    }
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
  static double mean(const Plane& light, const PixelValue& value) {
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

  enum class From { kScene, kPlates };  ///< of the waves

  Judged judged(const std::vector<SineWave>& waves, const glm::dvec3& step, double seconds,
                From from = From::kScene) {
    const Camera start = camera_;
    const bool plates = from == From::kPlates;
    const std::vector<SineWave> of_scene = plates ? std::vector<SineWave>{} : waves;
    const std::vector<SineWave> of_plates = plates ? waves : std::vector<SineWave>{};
    write("now.exr", {0, kBottom, -4}, {}, of_plates, 0);
    CompositeJob now = job_over(of_scene, "now.exr", "wet_now.exr", 0);
    camera_.view = glm::translate(start.view, -step);
    write("then.exr", {0, kBottom, -4}, {}, of_plates, seconds);
    const CompositeJob then = job_over(of_scene, "then.exr", "wet_then.exr", seconds);
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

  static void record(const Judged& off) {
    RecordProperty("pixels", std::to_string(off.with_waves.seen) + " of " +
                                 std::to_string(off.calm.seen) + ", mirrored " +
                                 std::to_string(off.with_waves.mirrored) + " of " +
                                 std::to_string(off.calm.mirrored));
  }
  static void expect_followed(const Judged& off) {
    EXPECT_GT(off.calm.seen, 0.3) << "there is something to tell";
    EXPECT_GT(off.calm.mirrored, 3);
    EXPECT_LT(off.with_waves.seen, 0.02 * off.calm.seen);
    EXPECT_LT(off.with_waves.mirrored, 0.05 * off.calm.mirrored);
    record(off);
  }

 private:
  CompositeJob job_over(const std::vector<SineWave>& waves, const std::string& plate,
                        const std::string& output, double seconds) const {
    CompositeJob job = this->job(plate, output);
    job.scene.scene.water->waves = waves;
    job.scene.scene.time = seconds;
    job.scene.time = seconds;
    apply_setting(job.look,
                  waves.empty() ? "wave_normals.model=plate" : "wave_normals.model=sines");
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
    expect_followed(judged(waves, step, 0.25));
  }
}

TEST_F(WavesTest, LeadsToTheSamePointByNormalsOfBothPlates) {
  const std::vector<SineWave> waves{{0.008, 3, 1, 0.4, 5}, {0.005, -1, 4, 1.9, 6}};
  expect_followed(judged(waves, {0.1, 0, -0.05}, 0.25, From::kPlates));
}

TEST_F(SpotTest, WarnsOfASecondPlateWithoutNormals) {
  write("now.exr", {0, kBottom, -4}, {}, {{0.008, 3, 1, 0.4, 5}});
  write("then.exr", {0, kBottom, -4}, {});
  CompositeJob job = this->job("now.exr", "wet.exr");
  apply_setting(job.look, "wave_normals.strength=1");
  const auto executor = make_executor(1);
  const auto warnings = [&](const std::string& second) {
    CompositeJob then = this->job(second, "then_wet.exr");
    job.second = {then.plate, then.scene};
    return composite(job, *executor).warnings;
  };
  const auto calm =
      ::testing::Contains(::testing::HasSubstr("frame has no normals of the surface"));
  EXPECT_THAT(warnings("then.exr"), calm);
  EXPECT_THAT(warnings("now.exr"), ::testing::Not(calm));
}

/// Waves that focus what is below them show it at several places.
TEST_F(WavesTest, IsBetterThanOfCalmWaterThroughSteepWaves) {
  const std::vector<SineWave> waves{{0.02, 9, 3, 0.4, 9}, {0.01, -4, 12, 1.9, 11}};
  const Judged off = judged(waves, {0.1, 0, -0.05}, 1.0 / 24);
  EXPECT_LT(off.with_waves.seen, 0.5 * off.calm.seen);
  EXPECT_LT(off.with_waves.mirrored, 0.5 * off.calm.mirrored);
  record(off);
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
