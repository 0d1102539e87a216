// The scripts, run by bash: a program stands in for limpid, and writes down its arguments.
#include "farm/scripts.h"

#include <gmock/gmock.h>

#include "limpid/core/error.h"

#include "farm/programs.h"
#include "farm/temporary_folder.h"

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// Writes its arguments, a line each call, and ends with the code in `code.FRAMES`, by default 0.
constexpr const char* kStandIn = R"sh(#!/bin/bash
printf '<%s>' "$@" >>called.txt
echo >>called.txt
echo "a line of the log"
for frames; do :; done
[ -e "code.$frames" ] || exit 0
echo "limpid: a note" >&2
[ ! -s "says.$frames" ] || cat "says.$frames" >&2
exit "$(cat "code.$frames")"
)sh";

class ScriptsTest : public ::testing::Test {
 protected:
  ScriptsTest() {
    plan_.name = "wet it's";
    plan_.folder = folder_.path;
    plan_.program = folder_.path / "stand in";
    plan_.farm = folder_.path / "wet it's.farm";
    plan_.command = {"composite", "my plate's.####.exr", "-o", "wet $(x) \"y\".####.exr",
                     "--resume"};
    plan_.range = "1-6";
    plan_.tasks = 3;
    plan_.cores = 2;
    fs::create_directories(plan_.farm / "log");
    fs::create_directories(plan_.farm / "failed");
    write_text(plan_.program, kStandIn);
    fs::permissions(plan_.program, fs::perms::owner_all);
    write_text(plan_.farm / "chunks.txt", "1,2\n3,4\n5,6\n");
  }
  /// The exit code.
  int run_task(const std::string& number) {
    write_text(plan_.farm / "task.sh", task_script(plan_));
    return run_program({"bash", (plan_.farm / "task.sh").string(), number}).code;
  }
  std::string called() const { return text_of(folder_.path / "called.txt"); }
  std::string failed(const std::string& frame) const {
    return text_of(plan_.farm / "failed" / (frame + ".txt"));
  }
  void fail(const std::string& frames, const std::string& code,
            const std::string& says = "") const {
    write_text(folder_.path / ("code." + frames), code);
    if (!says.empty()) write_text(folder_.path / ("says." + frames), says);
  }
  static std::string call_of(const std::string& frames) {
    return "<composite><my plate's.####.exr><-o><wet $(x) \"y\".####.exr><--resume><--frames><" +
           frames + ">\n";
  }

  TemporaryFolder folder_;
  FarmPlan plan_;
};

TEST_F(ScriptsTest, ATaskMakesTheFramesOfItsLineWhateverNamesHold) {
  EXPECT_EQ(run_task("2"), 0);
  EXPECT_EQ(called(), call_of("3,4"));
  EXPECT_THAT(text_of(plan_.farm / "log/local.2.txt"), HasSubstr("== frames 3,4 on "));
  EXPECT_THAT(text_of(plan_.farm / "log/local.2.txt"), HasSubstr("a line of the log\n"));
}

TEST_F(ScriptsTest, AFrameThatFailsIsNamedAndTheOthersAreMade) {
  fail("3,4", "1", "limpid ERROR: frame 3: no depth\n");
  fail("3", "1", "limpid: warning: other\nlimpid ERROR: frame 3: no depth\n");
  EXPECT_EQ(run_task("2"), 1);
  EXPECT_EQ(called(), call_of("3,4") + call_of("3") + call_of("4"));
  EXPECT_EQ(failed("3"), "frame 3: no depth\n");
  EXPECT_FALSE(fs::exists(plan_.farm / "failed/4.txt"));
}

TEST_F(ScriptsTest, AFrameThatEndsTheProgramIsNamed) {
  fail("5,6", "139");
  fail("6", "139");
  EXPECT_EQ(run_task("3"), 1);
  EXPECT_EQ(failed("6"), "frame 6: limpid ended with exit code 139\n");
}

TEST_F(ScriptsTest, WhatIsWorthTryingAgainIsSaidByTheExitCode) {
  fail("1,2", "75");
  fail("2", "75", "limpid ERROR: frame 2: no space left\n");
  EXPECT_EQ(run_task("1"), 75);
  EXPECT_EQ(failed("2"), "frame 2: no space left\n");
  fail("1", "1", "limpid ERROR: frame 1: no depth\n");
  EXPECT_EQ(run_task("1"), 1) << "trying again would not help frame 1";
}

TEST_F(ScriptsTest, ATaskThatIsEndedTriesNothingMore) {
  fail("1,2", "143");
  EXPECT_EQ(run_task("1"), 143);
  EXPECT_EQ(called(), call_of("1,2"));
}

TEST_F(ScriptsTest, ATaskWithoutALineOrWithoutItsFolderMakesNothing) {
  EXPECT_EQ(run_task("4"), 2);
  EXPECT_THAT(text_of(plan_.farm / "log/local.4.txt"), HasSubstr("chunks.txt has no line 4\n"));
  fs::remove(plan_.farm / "chunks.txt");
  EXPECT_EQ(run_task("1"), 75);
  EXPECT_EQ(called(), "");
}

TEST_F(ScriptsTest, SlurmReadsWhatATaskNeeds) {
  plan_.memory = (std::int64_t{3} << 30) + 1;
  plan_.minutes = 35;
  plan_.sbatch = {"--partition=render", "--exclude=n[1-3]"};
  const std::string script = task_script(plan_);
  for (const char* line :
       {"#SBATCH --job-name=limpid-wet_it_s\n", "#SBATCH --array=1-3\n",
        "#SBATCH --cpus-per-task=2\n", "#SBATCH --mem=3073M\n", "#SBATCH --time=35\n",
        "#SBATCH --requeue\n", "#SBATCH --partition=render\n", "#SBATCH --exclude=n[1-3]\n"}) {
    EXPECT_THAT(script, HasSubstr(line));
  }
  // Slurm reads no further than the first command.
  EXPECT_LT(script.rfind("#SBATCH"), script.find("\nlimpid="));
  const std::string verify = verify_script(plan_);
  EXPECT_THAT(verify, HasSubstr("#SBATCH --job-name=limpid-wet_it_s-verify\n"));
  EXPECT_THAT(verify, Not(HasSubstr("--array")));
  plan_.memory.reset();
  plan_.minutes.reset();
  EXPECT_THAT(task_script(plan_), Not(HasSubstr("--mem")));
  EXPECT_THAT(task_script(plan_), Not(HasSubstr("--time=")));
}

TEST_F(ScriptsTest, TheLastJobLooksAtAllFrames) {
  write_text(plan_.farm / "verify.sh", verify_script(plan_));
  EXPECT_EQ(run_program({"bash", (plan_.farm / "verify.sh").string()}).code, 0);
  EXPECT_EQ(called(), "<farm><verify><" + plan_.farm.string() +
                          "><--><composite><my plate's.####.exr><-o><wet $(x) "
                          "\"y\".####.exr><--resume><--frames><1-6>\n");
}

TEST_F(ScriptsTest, OnlyWordsThatNeedNoQuotesGoToSbatch) {
  expect_sbatch_word("--gres=gpu:1");
  expect_sbatch_word("--nodelist=n[1-3]");
  for (const char* bad : {"partition", "--", "--comment=a b", "--comment='a'", "--x=a\nrm", "",
                          "--array=1-9%2", "--wrap=true"}) {
    EXPECT_THROW(expect_sbatch_word(bad), Error) << bad;
  }
}

}  // namespace
}  // namespace limpid::test
