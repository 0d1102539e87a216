#include "farm/farm_folder.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include "limpid/core/error.h"

#include "farm/programs.h"
#include "farm/temporary_folder.h"

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

template <class Work>
std::string refused(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was refused";
}

std::string this_machine() {
  char name[256] = "";
  ::gethostname(name, sizeof name - 1);
  return name;
}

class FarmFolderTest : public ::testing::Test {
 protected:
  FarmFolderTest() : folder_(temporary_.path / "wet.farm") { folder_.make(); }

  TemporaryFolder temporary_;
  FarmFolder folder_;
};

TEST(FarmFolderNameTest, IsThatOfTheOutputs) {
  EXPECT_EQ(farm_folder_of("wet.####.exr"), "wet.farm");
  EXPECT_EQ(farm_folder_of("wet.%04d.exr"), "wet.farm");
  EXPECT_EQ(farm_folder_of("shot 7/wet_#_v2.exr"), "shot 7/wet__v2.farm");
  EXPECT_EQ(farm_folder_of("/shot/wet@@@.exr"), "/shot/wet.farm");
  EXPECT_EQ(farm_folder_of("/shot/####.exr"), "/shot/frames.farm");
  EXPECT_EQ(farm_folder_of("shot/####/wet.exr"), "shot/wet.farm");
  EXPECT_EQ(farm_folder_of("shot/wet.exr"), "shot/wet.farm");
}

TEST_F(FarmFolderTest, ARecordComesBackAsItWas) {
  EXPECT_FALSE(folder_.has_record());
  FarmRecord record;
  record.folder = temporary_.path;
  record.outputs = {"it's \"wet\".####.exr", "wet.####.png"};
  record.frames = 240;
  record.kept = 12;
  record.before = {{-3, "1 2 3.4"}, {7, "5 6 7.8"}};
  record.jobs = {123, 124};
  folder_.write(record);
  ASSERT_TRUE(folder_.has_record());
  const FarmRecord read = folder_.record();
  EXPECT_EQ(read.folder, record.folder);
  EXPECT_EQ(read.outputs, record.outputs);
  EXPECT_EQ(read.frames, 240u);
  EXPECT_EQ(read.kept, 12u);
  EXPECT_EQ(read.before, record.before);
  EXPECT_EQ(read.jobs, record.jobs);
}

TEST_F(FarmFolderTest, WhatIsNoFarmIsNamed) {
  EXPECT_THAT(refused([&] { folder_.record(); }), HasSubstr("wet.farm: not a farm"));
  write_text(folder_.file("farm.json"), "{\"folder\": 3}");
  EXPECT_THAT(refused([&] { folder_.record(); }), HasSubstr("farm.json"));
  write_text(folder_.file("farm.json"), "nonsense");
  EXPECT_THAT(refused([&] { folder_.record(); }), HasSubstr("farm.json"));
  write_text(folder_.file("chunks.txt"), "1,2\nx\n");
  EXPECT_THAT(refused([&] { folder_.chunks(); }), HasSubstr("chunks.txt: line 2"));
}

TEST_F(FarmFolderTest, FailuresAreSentencesOfFrames) {
  write_text(folder_.path() / "failed/7.txt", "frame 7: no depth\n");
  write_text(folder_.path() / "failed/-2.txt", "it ended\n");
  write_text(folder_.path() / "failed/.8.3", "half a sent");
  write_text(folder_.path() / "failed/9.txt", "");
  write_text(folder_.file("summary.txt"), "old");
  EXPECT_THAT(folder_.failed(), ElementsAre(Pair(-2, "it ended"), Pair(7, "no depth")));
  folder_.forget_failures();
  EXPECT_TRUE(folder_.failed().empty());
  EXPECT_FALSE(fs::exists(folder_.file("summary.txt")));
  EXPECT_TRUE(fs::exists(folder_.path() / "failed"));
}

TEST_F(FarmFolderTest, AFileThatIsReplacedHasAnotherState) {
  const fs::path file = temporary_.path / "wet.exr", other = temporary_.path / "other.exr";
  EXPECT_EQ(state_of(file), "");
  write_text(file, "one");
  const FileState before = state_of(file);
  EXPECT_EQ(state_of(file), before);
  write_text(other, "two");
  fs::last_write_time(other, fs::last_write_time(file));
  fs::rename(other, file);
  EXPECT_NE(state_of(file), before);
}

TEST_F(FarmFolderTest, TheLockIsHeldByOneAlone) {
  EXPECT_EQ(FarmLock::holder(folder_), "");
  {
    const FarmLock lock(folder_);
    EXPECT_EQ(FarmLock::holder(folder_),
              "process " + std::to_string(::getpid()) + " on " + this_machine());
    EXPECT_THAT(refused([&] { const FarmLock second(folder_); }),
                AllOf(HasSubstr("is being submitted, or run, by process"), HasSubstr("remove")));
    EXPECT_NE(FarmLock::holder(folder_), "") << "the one that was refused took it away";
  }
  EXPECT_EQ(FarmLock::holder(folder_), "");
  const FarmLock again(folder_);
}

TEST_F(FarmFolderTest, TheLockOfAProcessThatIsNoMoreIsTakenOver) {
  const std::string gone = "4194305 ";  // larger than any process number
  write_text(folder_.file("lock"), gone + this_machine() + "\n");
  EXPECT_EQ(FarmLock::holder(folder_), "");
  const FarmLock lock(folder_);
  EXPECT_THAT(FarmLock::holder(folder_), HasSubstr(std::to_string(::getpid())));
}

TEST_F(FarmFolderTest, TheLockOfAnotherMachineIsLeftAlone) {
  write_text(folder_.file("lock"), "4194305 another machine\n");
  EXPECT_THAT(refused([&] { const FarmLock lock(folder_); }),
              HasSubstr("by process 4194305 on another machine"));
  EXPECT_EQ(text_of(folder_.file("lock")), "4194305 another machine\n");
}

}  // namespace
}  // namespace limpid::test
