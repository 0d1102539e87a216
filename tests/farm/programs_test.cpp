#include "farm/programs.h"

#include <csignal>
#include <thread>

#include <gmock/gmock.h>
#include <unistd.h>

#include "limpid/core/error.h"

namespace limpid::test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

TEST(ProgramsTest, AWordIsAnArgumentWhateverIsInIt) {
  const ProgramRun run = run_program({"printf", "%s|", "a b", "$(id)", "it's \"x\"", "", "a\nb"});
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.out, "a b|$(id)|it's \"x\"||a\nb|");
  EXPECT_EQ(run.err, "");
  EXPECT_GT(run.memory, 0);
  EXPECT_GE(run.seconds, 0);
}

TEST(ProgramsTest, WhatItPrintsIsReadHoweverMuchItIs) {
  // More bytes than a pipe holds, on both pipes: a reader of one pipe at a time would never end.
  const ProgramRun run = run_program(
      {"bash", "-c", "for i in {1..20000}; do echo out $i; echo err $i >&2; done; exit 7"});
  EXPECT_EQ(run.code, 7);
  EXPECT_THAT(run.out, HasSubstr("out 20000\n"));
  EXPECT_EQ(last_words(run), "err 20000");
}

TEST(ProgramsTest, ASignalIsTold) {
  const ProgramRun run = run_program({"bash", "-c", "kill -KILL $$"});
  EXPECT_EQ(run.code, -SIGKILL);
  EXPECT_EQ(last_words(run), "ended by signal 9");
}

TEST(ProgramsTest, NobodyTypesAnythingAndSignalsAreAsUsual) {
  EXPECT_EQ(run_program({"cat"}).out, "");
  std::signal(SIGPIPE, SIG_IGN);  // as in the tool
  EXPECT_EQ(run_program({"bash", "-c", "kill -PIPE $$"}).code, -SIGPIPE);
  std::signal(SIGPIPE, SIG_DFL);
}

TEST(ProgramsTest, OneThatIsNotThereIsNamed) {
  try {
    run_program({"/no/such/program"});
    FAIL() << "it ran";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/no/such/program: cannot be started (No such file"));
  }
}

// In a separate process: after stopping, a process can start no more programs.
TEST(ProgramsDeathTest, StoppingEndsThemAndWhatTheyHaveStarted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        int ends[2];
        if (::pipe(ends) != 0) std::_Exit(3);
        // bash's child inherits the writing end: the pipe hangs up when all of them have ended.
        std::thread sleeper([&] {
          const std::string pipe =
              "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(ends[1]);
          run_program({"bash", "-c", "exec 9>" + pipe + "; echo begun >&9; sleep 1000; :"});
        });
        char byte = 0;
        for (int i = 0; i < 6; ++i) {
          if (::read(ends[0], &byte, 1) != 1) std::_Exit(4);
        }
        ::close(ends[1]);
        stop_programs();
        sleeper.join();
        if (::read(ends[0], &byte, 1) != 0) std::_Exit(5);
        try {
          run_program({"true"});
        } catch (const Error&) {
          std::_Exit(42);
        }
        std::_Exit(6);
      },
      ::testing::ExitedWithCode(42), "");
}

}  // namespace
}  // namespace limpid::test
