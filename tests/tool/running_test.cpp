#include "tool/running.h"

#include "tool/new_files.h"
#include "tool/tool.h"

/// A wait for a program that has ended returns.

namespace limpid::test {
namespace {

using RunningTest = ToolTest;

TEST_F(RunningTest, TellsOfTheLastLine) {
  Running running(folder_, {"/bin/sh", "-c", "echo; echo one; printf half"});
  EXPECT_EQ(running.line(), "");
  EXPECT_EQ(running.line(), "one");
  EXPECT_EQ(running.line(), std::nullopt);
  EXPECT_EQ(running.line(), std::nullopt);
  EXPECT_EQ(running.wait(), 0);
}

TEST_F(RunningTest, TellsOfTheLastFile) {
  NewFiles files(folder_);
  Running running(folder_, {"/bin/sh", "-c", "touch one; touch two; exit 3"});
  EXPECT_EQ(files.next(running), "one");
  EXPECT_EQ(files.next(running), "two");
  EXPECT_EQ(files.next(running), std::nullopt);
  EXPECT_EQ(running.wait(), 3);
}

}  // namespace
}  // namespace limpid::test
