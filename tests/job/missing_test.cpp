#include "limpid/job/missing.h"

#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Files plate.<frame>.exr in a folder for each test; the library never opens the files.
class MissingTest : public ::testing::Test {
 protected:
  MissingTest()
      : folder_(fs::path(testing::TempDir()) /
                (std::string("missing_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~MissingTest() override { fs::remove_all(folder_); }

  fs::path plate(int frame) const { return folder_ / ("plate." + std::to_string(frame) + ".exr"); }
  void make(const std::vector<int>& frames) const {
    for (const int frame : frames) std::ofstream(plate(frame)) << "no picture";
  }
  JobOfFrame<CompositeJob> job_of() const {
    return [this](int frame) {
      CompositeJob job;
      job.plate.files = {plate(frame)};
      job.scene.scene.time = 100 + frame;  // tells the frame of the scene
      job.look.name = std::to_string(frame);
      job.output.picture = folder_ / (std::to_string(frame) + ".exr");
      job.time.fallback = frame / 4.0;
      return job;
    };
  }

  fs::path folder_;
};

TEST_F(MissingTest, AnErrorIsLeftToItsTurn) {
  const FilledSequence filled = fill_missing({3, 1}, job_of(), Missing::kError);
  EXPECT_THAT(filled.frames, ElementsAre(3, 1));
  EXPECT_THAT(filled.missing, IsEmpty());
  EXPECT_EQ(filled.job_of(3).plate.files[0], plate(3));
}

TEST_F(MissingTest, SkippedFramesAreLeftOut) {
  make({1, 3, 5});
  const FilledSequence filled = fill_missing({5, 4, 3, 2, 1}, job_of(), Missing::kSkip);
  EXPECT_THAT(filled.frames, ElementsAre(5, 3, 1));
  ASSERT_EQ(filled.missing.size(), 2u);
  EXPECT_EQ(filled.missing[0].frame, 4);
  EXPECT_EQ(filled.missing[0].file, plate(4));
  EXPECT_FALSE(filled.missing[0].stand_in);
  EXPECT_EQ(filled.missing[1].frame, 2);
}

TEST_F(MissingTest, TheNearestBeforeStandsInElseTheFirstAfter) {
  make({3, 4, 8});
  // Frame 6 is not in the sequence, so frame 6 stands in for no other frame.
  make({6});
  const FilledSequence filled = fill_missing({1, 2, 3, 4, 5, 7, 8, 9}, job_of(), Missing::kHold);
  EXPECT_THAT(filled.frames, ElementsAre(1, 2, 3, 4, 5, 7, 8, 9));
  const auto stands_in = [&](int frame) { return filled.job_of(frame).plate.files[0]; };
  EXPECT_EQ(stands_in(1), plate(3));
  EXPECT_EQ(stands_in(2), plate(3));
  EXPECT_EQ(stands_in(3), plate(3));
  EXPECT_EQ(stands_in(5), plate(4));
  EXPECT_EQ(stands_in(7), plate(4));
  EXPECT_EQ(stands_in(9), plate(8));
  std::vector<int> numbers;
  for (const MissingPlate& plate : filled.missing) numbers.push_back(*plate.stand_in);
  EXPECT_THAT(numbers, ElementsAre(3, 3, 4, 4, 8));

  const CompositeJob held = filled.job_of(7);
  EXPECT_EQ(held.scene.scene.time, 104) << "the camera belongs to the plate";
  EXPECT_EQ(held.look.name, "7");
  EXPECT_EQ(held.output.picture, folder_ / "7.exr");
  EXPECT_EQ(held.time.fallback, 7 / 4.0);
  EXPECT_EQ(held.time.plate_offset, 3 / 4.0);
  EXPECT_EQ(filled.job_of(1).time.plate_offset, -2 / 4.0);
  EXPECT_EQ(filled.job_of(4).time.plate_offset, 0);
}

TEST_F(MissingTest, AnyFileOfThePlateCounts) {
  make({1, 2});
  std::ofstream(folder_ / "depth.1.exr") << "no picture";
  const auto with_depth = [&](int frame) {
    CompositeJob job = job_of()(frame);
    const std::string depth = (folder_ / ("depth." + std::to_string(frame) + ".exr")).string();
    job.plate.named["depth"] = depth + ":Z";
    job.plate.named["shadow"] = (folder_ / "no.exr").string();
    job.plate.layers["shadow"] = "none";  // so that no.exr is not opened
    job.plate.layers["reflection"] = depth;
    return job;
  };
  const FilledSequence filled = fill_missing({1, 2}, with_depth, Missing::kSkip);
  EXPECT_THAT(filled.frames, ElementsAre(1));
  ASSERT_EQ(filled.missing.size(), 1u);
  EXPECT_EQ(filled.missing[0].file, folder_ / "depth.2.exr");
}

TEST_F(MissingTest, WhatGoesLaterIsWorthAnotherTry) {
  make({1, 2});
  for (const Missing missing : {Missing::kSkip, Missing::kHold}) {
    const FilledSequence filled = fill_missing({1, 2, 3}, job_of(), missing);
    fs::remove(plate(2));
    for (const int frame : {2, 3}) {
      if (frame == 3 && missing == Missing::kSkip) continue;
      try {
        filled.job_of(frame);
        ADD_FAILURE() << frame;
      } catch (const Error& error) {
        EXPECT_THAT(
            error.what(),
            HasSubstr(
                "plate.2.exr: has disappeared since the sequence began; run the sequence again"));
        EXPECT_EQ(error.fault(), Fault::kRetry);
      }
    }
    make({2});
  }
}

TEST_F(MissingTest, OtherErrorsAreLeftToTheirTurn) {
  make({2});
  const auto failing = [&](int frame) {
    if (frame == 1) throw Error("no scene");
    return job_of()(frame);
  };
  const FilledSequence filled = fill_missing({1, 2, 3}, failing, Missing::kHold);
  EXPECT_THAT(filled.frames, ElementsAre(1, 2, 3));
  EXPECT_EQ(filled.job_of(3).plate.files[0], plate(2));
  EXPECT_THROW(filled.job_of(1), Error);
}

TEST_F(MissingTest, NothingAtAllIsAnError) {
  for (const Missing missing : {Missing::kSkip, Missing::kHold}) {
    try {
      fill_missing({7, 8}, job_of(), missing);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()),
                plate(7).string() + ": no such file, and no other frame has its plates");
      EXPECT_EQ(error.fault(), Fault::kJob);
    }
  }
  EXPECT_THAT(fill_missing({}, job_of(), Missing::kHold).frames, IsEmpty());
}

}  // namespace
}  // namespace limpid
