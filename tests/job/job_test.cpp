#include <filesystem>
#include <string>

#include <gmock/gmock.h>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_file.h"
#include "limpid/files/gltf/gltf.h"
#include "limpid/files/text/frame_range.h"
#include "limpid/job/composite.h"
#include "limpid/job/resume.h"
#include "limpid/job/sequence.h"
#include "limpid/job/water.h"

#include "paths.h"

/// The laws that all kinds of jobs obey, on the pool of data/scenes.

namespace limpid {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::Not;
using ::testing::StartsWith;

class JobTest : public ::testing::Test {
 protected:
  JobTest()
      : folder_(
            fs::path(testing::TempDir()) /
            (std::string("job_") + testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~JobTest() override { fs::remove_all(folder_); }

  fs::path at(const std::string& name, int frame) const {
    return folder_ / name_of_frame(name + ".%d.exr", frame);
  }
  RenderJob render_job(int frame = 0) const {
    RenderJob job;
    job.scene = scene_;
    job.render.size = {32, 18};
    job.output.plate = at("plate", frame);
    return job;
  }
  WaterJob water_job(int frame = 0) const {
    WaterJob job;
    job.scene = scene_;
    job.render.size = {32, 18};
    job.output.picture = at("water", frame);
    return job;
  }
  CompositeJob composite_job(int frame = 0) const {
    CompositeJob job;
    job.plate.files = {at("plate", frame)};
    job.output.picture = at("composite", frame);
    return job;
  }
  /// The time in a file's header.
  static double time_in(const fs::path& file) {
    const auto text = ExrFile::open(file).text_attribute(0, "limpid/scene");
    return text ? scene_from_toml(*text, file.string()).scene.time : -1;
  }

  fs::path folder_;
  SceneFile scene_ = load_scene(LIMPID_DATA "/scenes/pool.toml");
  Model model_ = load_gltf(scene_.geometry);
  std::unique_ptr<Executor> executor_ = make_executor(2);
};

TEST(JobTime, IsAskedForThenOfTheSceneThenOfThePlate) {
  SceneFile scene;
  JobTime time{.fallback = 1, .plate_offset = 2};
  EXPECT_EQ(time.of(scene), 1);
  EXPECT_EQ(time.of(scene, 10), 12);
  scene.time = 5;
  EXPECT_EQ(time.of(scene, 10), 5);
  time.explicit_time = 7;
  EXPECT_EQ(time.of(scene, 10), 7);
}

TEST_F(JobTest, TheTimeOfASceneFileCountsInEveryKind) {
  scene_.time = 1.5;
  render(model_, render_job(), *executor_);
  water(model_, water_job(), *executor_);
  EXPECT_EQ(time_in(at("plate", 0)), 1.5);
  EXPECT_EQ(time_in(at("water", 0)), 1.5);
  CompositeJob job = composite_job();
  composite(job, *executor_);
  EXPECT_EQ(time_in(at("composite", 0)), 1.5) << "the plate says it";
  job.scene.time = 3;
  composite(job, *executor_);
  EXPECT_EQ(time_in(at("composite", 0)), 3);

  RenderJob asked = render_job();
  asked.time.explicit_time = 0;
  render(model_, asked, *executor_);
  EXPECT_EQ(time_in(at("plate", 0)), 0);
}

/// The bytes of a file.
std::string bytes_of(const fs::path& file) {
  const ExrFile exr = ExrFile::open(file);
  EXPECT_TRUE(exr.is_as_written().value_or(false)) << file;
  return exr.content_hash();
}

TEST_F(JobTest, AFrameAloneIsASequenceOfOneInEveryKind) {
  const Sequence one{{7}, 1}, three{{6, 7, 8}, 2};
  render(model_, render_job(7), *executor_);
  water(model_, water_job(7), *executor_);
  composite(composite_job(7), *executor_);
  const auto expect_kept = [&](auto rest_of) {
    EXPECT_EQ(rest_of(one).kept, 1);
    EXPECT_THAT(rest_of(three).frames, ElementsAre(6, 8));
  };
  const auto render_of = [&](int frame) { return render_job(frame); };
  const auto water_of = [&](int frame) { return water_job(frame); };
  const auto composite_of = [&](int frame) { return composite_job(frame); };
  expect_kept([&](const Sequence& s) { return rest_of_render(model_, s, render_of, *executor_); });
  expect_kept([&](const Sequence& s) { return rest_of_water(model_, s, water_of, *executor_); });
  expect_kept([&](const Sequence& s) { return rest_of_composite(s, composite_of, *executor_); });

  const std::string alone[] = {bytes_of(at("plate", 7)), bytes_of(at("water", 7)),
                               bytes_of(at("composite", 7))};
  render_sequence(model_, one, render_of, {}, *executor_);
  water_sequence(model_, one, water_of, {}, *executor_);
  composite_sequence(one, composite_of, {}, *executor_);
  EXPECT_EQ(bytes_of(at("plate", 7)), alone[0]);
  EXPECT_EQ(bytes_of(at("water", 7)), alone[1]);
  EXPECT_EQ(bytes_of(at("composite", 7)), alone[2]);
}

/// The sentence of the Error that the work throws.
template <class Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

TEST_F(JobTest, ErrorsOfASequenceNameTheFrameAndThoseOfOneJobDoNot) {
  const auto composite_of = [&](int frame) { return composite_job(frame); };
  EXPECT_THAT(refusal([&] { composite(composite_job(3), *executor_); }), Not(StartsWith("frame")));
  EXPECT_THAT(refusal([&] {
                composite_sequence({{3}, 1}, composite_of, {}, *executor_);
              }),
              StartsWith("frame 3: "));
  const auto water_of = [&](int frame) {
    WaterJob job = water_job(frame);
    job.samples = 17;
    return job;
  };
  const std::string alone = refusal([&] { water(model_, water_of(3), *executor_); });
  EXPECT_THAT(alone, StartsWith("samples = 17: expected 1 ... 16"));
  EXPECT_EQ(refusal([&] {
              water_sequence(model_, {{3}, 1}, water_of, {}, *executor_);
            }),
            "frame 3: " + alone);
}

}  // namespace
}  // namespace limpid
