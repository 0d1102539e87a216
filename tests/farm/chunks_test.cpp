#include "farm/chunks.h"

#include <numeric>

#include <gmock/gmock.h>

#include "limpid/core/error.h"

namespace limpid::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<int> first(int count) {
  std::vector<int> frames(static_cast<std::size_t>(count));
  std::iota(frames.begin(), frames.end(), 1);
  return frames;
}

TEST(ChunksTest, ATaskTakesAboutTwoMinutes) {
  EXPECT_EQ(frames_a_task(1, 1200, 1000), 120);
  EXPECT_EQ(frames_a_task(0.5, 480, 1000), 240);
  EXPECT_EQ(frames_a_task(50, 240, 1000), 2);
  EXPECT_EQ(frames_a_task(500, 240, 1000), 1);
}

TEST(ChunksTest, TasksAreAboutEquallyLong) {
  // A task could take 120 frames: 4 tasks and a rest of 20 frames.
  EXPECT_EQ(frames_a_task(1, 500, 1000), 100);
  EXPECT_EQ(frames_a_task(1, 121, 1000), 61);
  EXPECT_EQ(frames_a_task(1e-6, 7, 1000), 7);
}

TEST(ChunksTest, ThereAreNoMoreTasksThanTheSchedulerTakes) {
  EXPECT_EQ(frames_a_task(1000, 5000, 1000), 5);
  EXPECT_EQ(frames_a_task(1000, 5001, 1000), 6);
  EXPECT_EQ(chunks_of(first(5001), 6).size(), 834u);
  try {
    frames_a_task(1, 1'000'000, 99);
    FAIL() << "99 tasks of 10000 frames are no million";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("1000000 frames: expected at most 990000, in 99 tasks"));
  }
}

TEST(ChunksTest, EveryFrameIsInOneInTheOrderOfTheRange) {
  EXPECT_THAT(chunks_of({9, 7, 5, 3, 1}, 2), ElementsAre(Chunk{9, 7}, Chunk{5, 3}, Chunk{1}));
  EXPECT_THAT(chunks_of({4, 5}, 8), ElementsAre(Chunk{4, 5}));
  EXPECT_TRUE(chunks_of({}, 8).empty());
}

TEST(ChunksTest, AreAFileWithALineATask) {
  const std::vector<Chunk> chunks = {{1, 3, 5}, {-7}, {9, 8}};
  EXPECT_EQ(chunks_text(chunks), "1,3,5\n-7\n9,8\n");
  EXPECT_EQ(chunks_in(chunks_text(chunks)), chunks);
}

TEST(ChunksTest, AFileThatSomebodyHasEditedIsReadLikeFrames) {
  EXPECT_THAT(chunks_in("1-4x3\n7"), ElementsAre(Chunk{1, 4}, Chunk{7}));
  try {
    chunks_in("1\nzwei\n");
    FAIL() << "no number";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("line 2: frames 'zwei': expected ranges"));
  }
}

}  // namespace
}  // namespace limpid::test
