#include "farm/farm_status.h"

#include <gmock/gmock.h>

#include "farm/temporary_folder.h"

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// Six frames in three tasks; two of the sequence's eight frames existed before the farm.
class FarmStatusTest : public ::testing::Test {
 protected:
  FarmStatusTest() : folder_(temporary_.path / "wet.farm") {
    folder_.make();
    record_.folder = temporary_.path;
    record_.outputs = {"wet.####.exr", "wet.####.png"};
    record_.frames = 8;
    record_.kept = 2;
    record_.jobs = {12, 13};
    write_text(folder_.file("chunks.txt"), "1,2\n3,4\n5,6\n");
  }
  void make(int frame) const {
    for (const char* ending : {".exr", ".png"}) {
      write_text(temporary_.path / ("wet.000" + std::to_string(frame) + ending), "made");
    }
  }
  void note(int frame, const std::string& sentence) const {
    write_text(folder_.path() / "failed" / (std::to_string(frame) + ".txt"), sentence + "\n");
  }
  FarmStatus status(const FarmQueue& queue) const { return status_of(folder_, record_, queue); }

  TemporaryFolder temporary_;
  FarmFolder folder_;
  FarmRecord record_;
};

TEST_F(FarmStatusTest, AFrameIsMadeWhenAllOfItsFilesAreThere) {
  make(2);
  write_text(temporary_.path / "wet.0003.exr", "made");  // without the preview
  EXPECT_THAT(made_frames(record_, folder_.chunks()), ElementsAre(2));
  write_text(temporary_.path / "wet.0003.png", "made");
  EXPECT_THAT(made_frames(record_, folder_.chunks()), ElementsAre(2, 3));
}

TEST_F(FarmStatusTest, APictureThatWasThereBeforeIsNotMade) {
  make(2);
  record_.before[2] = state_of(temporary_.path / "wet.0002.exr");
  EXPECT_THAT(made_frames(record_, folder_.chunks()), ElementsAre());
  write_text(temporary_.path / "new.exr", "made");
  fs::rename(temporary_.path / "new.exr", temporary_.path / "wet.0002.exr");
  EXPECT_THAT(made_frames(record_, folder_.chunks()), ElementsAre(2));
}

TEST_F(FarmStatusTest, TellsOfTasksThatRunAndWait) {
  make(1);
  const FarmStatus now = status({{{12, 1, "RUNNING", "", "n1"},
                                  {12, 2, "PENDING", "Resources", ""},
                                  {12, 3, "PENDING", "Priority", ""}},
                                 true,
                                 ""});
  EXPECT_EQ(now.done, 3u);
  EXPECT_EQ(now.running, 1u);
  EXPECT_EQ(now.waiting, 2u);
  EXPECT_TRUE(now.failed.empty());
  EXPECT_EQ(to_text(now), "3 of 8 frames are done\n1 tasks run, 2 wait (Resources)\n");
}

TEST_F(FarmStatusTest, AFrameThatFailedHasItsSentence) {
  make(3);
  note(4, "frame 4: no depth");
  note(3, "frame 3: failed once, was made then");
  const FarmStatus now = status({{{12, 2, "FAILED", "NonZeroExitCode", "n1"},
                                  {12, 1, "RUNNING", "", "n2"},
                                  {12, 3, "PENDING", "", ""}},
                                 true,
                                 ""});
  EXPECT_THAT(to_text(now), HasSubstr("\nframe 4: no depth\n"));
  EXPECT_THAT(to_text(now), Not(HasSubstr("frame 3")));
}

TEST_F(FarmStatusTest, ATaskThatEndedWithoutAWordIsNamedWithItsState) {
  make(1);
  write_text(folder_.path() / "log/12.3.txt", "== frames 5,6\n");
  const FarmStatus now = status({{{12, 1, "TIMEOUT", "TimeLimit", "n1"},
                                  {12, 2, "NODE_FAIL", "", "n2"},
                                  {12, 3, "OUT_OF_MEMORY", "exit code 0:125", "n3"}},
                                 false,
                                 ""});
  const std::string text = to_text(now);
  EXPECT_THAT(text, HasSubstr("no task waits or runs\n"));
  EXPECT_THAT(
      text, HasSubstr("\nframe 2: task 1 has ended (TIMEOUT, TimeLimit, on n1); it has no log\n"));
  EXPECT_THAT(text, HasSubstr("\nframes 3-4: task 2 has ended (NODE_FAIL, on n2)"));
  EXPECT_THAT(
      text,
      HasSubstr("\nframes 5-6: task 3 has ended (OUT_OF_MEMORY, exit code 0:125, on n3); see "));
  EXPECT_THAT(text, HasSubstr("log/12.3.txt\n"));
}

TEST_F(FarmStatusTest, TheLastThatIsKnownOfATaskCounts) {
  const FarmStatus now =
      status({{{12, 1, "NODE_FAIL", "", "n1"}, {12, 1, "PENDING", "BeginTime", ""}}, true, ""});
  EXPECT_EQ(now.waiting, 1u);
  EXPECT_THAT(to_text(now), Not(HasSubstr("task 1 has ended")));
}

TEST_F(FarmStatusTest, TasksThatTheQueueHasForgottenHaveEnded) {
  // Accounting is not set up, and squeue forgets after some minutes.
  const FarmStatus over = status({{}, false, ""});
  EXPECT_THAT(to_text(over), HasSubstr("frames 1-2: task 1 has ended; it has no log\n"));
  const FarmStatus others_run = status({{{12, 3, "RUNNING", "", "n1"}}, true, ""});
  EXPECT_EQ(others_run.failed.size(), 2u);
}

TEST_F(FarmStatusTest, WithoutAnAnswerTheFramesAloneAreToldOf) {
  make(1);
  const FarmStatus now = status({{}, std::nullopt, "Slurm does not answer"});
  EXPECT_EQ(to_text(now), "3 of 8 frames are done\nSlurm does not answer\n");
}

TEST_F(FarmStatusTest, TasksHereHaveNotEndedWhileTheFarmIsAtWork) {
  record_.jobs.clear();
  EXPECT_TRUE(status({{}, true, ""}).failed.empty());
  EXPECT_EQ(status({{}, false, ""}).failed.size(), 3u);
}

TEST_F(FarmStatusTest, IsCompleteWithAllFrames) {
  for (int frame = 1; frame <= 6; ++frame) make(frame);
  const FarmStatus now = status({{}, false, ""});
  EXPECT_TRUE(now.complete());
  EXPECT_EQ(to_text(now), "8 of 8 frames are done\n");
}

TEST(FarmRateTest, IsThatOfTheLastFrames) {
  EXPECT_EQ(rate_of({}), 0);
  EXPECT_EQ(rate_of({5}), 0);
  EXPECT_EQ(rate_of({5, 5}), 0);
  EXPECT_DOUBLE_EQ(rate_of({14, 10, 12}), 0.5);
  std::vector<double> times;
  for (int i = 0; i < 100; ++i) times.push_back(i * 100.0);  // the first frames are slow
  for (int i = 0; i < 60; ++i) times.push_back(1e5 + i * 0.25);
  EXPECT_DOUBLE_EQ(rate_of(times), 4);
}

TEST(FarmStatusText, HasRateAndTimeLeftWhileThereIsWork) {
  FarmStatus status;
  status.frames = 240;
  status.done = 117;
  status.frames_per_second = 3.0961;
  status.at_work = true;
  EXPECT_THAT(to_text(status), StartsWith("117 of 240 frames are done, 3.1 frames/s, 40 s left\n"));
  status.frames_per_second = 0.03;
  EXPECT_THAT(to_text(status), HasSubstr("1 h 8 min left"));
  status.frames_per_second = 1;
  EXPECT_THAT(to_text(status), HasSubstr("2 min 3 s left"));
  status.at_work = false;
  EXPECT_THAT(to_text(status), Not(HasSubstr("left")));
}

TEST(FarmSummaryTest, NamesEveryFrameThatIsNotWhole) {
  const FarmVerdict verdict{
      5, {2, 3, 4}, {{2, "wet.2.exr has changed"}, {3, "wet.3.exr was made differently (look)"}}};
  FarmStatus status;
  status.failed = {{{3}, "no depth"}};
  EXPECT_EQ(summary_text(verdict, status),
            "2 of 5 frames are complete, by the hashes in their headers\n"
            "frame 2: wet.2.exr has changed\n"
            "frame 3: no depth\n"
            "frame 4: is missing\n");
  EXPECT_EQ(summary_text({5, {}, {}}, {}),
            "5 of 5 frames are complete, by the hashes in their headers\n");
}

}  // namespace
}  // namespace limpid::test
