#include "limpid/job/sequence.h"

#include <atomic>
#include <functional>
#include <mutex>
#include <set>
#include <string>

#include <gmock/gmock.h>

#include "limpid/core/error.h"

namespace limpid {
namespace {

/// The record of a sequence's slots and frames; `event` can make a step throw.
struct Story {
  std::function<void(const std::string& step, int frame)> event = [](const std::string&, int) {};
  std::atomic<int> slots = 0, busy = 0, most_busy = 0;
  std::mutex mutex;
  std::set<int> begun, written;
  std::vector<int> order;
  std::vector<SequenceProgress> told;
};

/// A slot that is busy with a frame from begin() to done().
class TellingSlot : public FrameSlot {
 public:
  explicit TellingSlot(Story& story) : story_(story) { ++story_.slots; }
  ~TellingSlot() override { --story_.slots; }

  void begin(int frame) override {
    EXPECT_FALSE(has_frame_) << "frame " << frame_ << " is not done";
    has_frame_ = true;
    frame_ = frame;
    story_.begun.insert(frame);
    story_.order.push_back(frame);
    const int busy = ++story_.busy;
    if (busy > story_.most_busy) story_.most_busy = busy;
    story_.event("begin", frame_);
  }
  void read(Executor&) override { story_.event("read", frame_); }
  void run(Executor& executor) override {
    std::atomic<int> tiles = 0;
    executor.run(
        8, [](void* count, int) { ++*static_cast<std::atomic<int>*>(count); }, &tiles);
    EXPECT_EQ(tiles, 8);
    story_.event("run", frame_);
  }
  void write() override {
    story_.event("write", frame_);
    const std::lock_guard lock(story_.mutex);
    story_.written.insert(frame_);
  }
  void done(const SequenceProgress& progress) override {
    EXPECT_EQ(progress.frame, frame_);
    story_.event("done", frame_);
    story_.told.push_back(progress);
    has_frame_ = false;
    --story_.busy;
  }

 private:
  Story& story_;
  bool has_frame_ = false;
  int frame_ = 0;
};

void tell(Story& story, const Sequence& sequence, int threads) {
  const auto executor = make_executor(threads);
  run_sequence(
      sequence, [&] { return std::make_unique<TellingSlot>(story); }, *executor);
}

std::vector<int> numbers(int count) {
  std::vector<int> frames;
  for (int i = 0; i < count; ++i) frames.push_back(100 - 2 * i);
  return frames;
}

class SequenceThreads : public testing::TestWithParam<int> {};

TEST_P(SequenceThreads, TellsOfEachFrameInOrder) {
  Story story;
  const Sequence sequence{numbers(25), 3};
  tell(story, sequence, GetParam());
  EXPECT_EQ(story.order, sequence.frames);
  ASSERT_EQ(story.told.size(), 25u);
  for (int i = 0; i < 25; ++i) {
    const SequenceProgress& at = story.told[static_cast<std::size_t>(i)];
    EXPECT_EQ(at.frame, 100 - 2 * i);
    EXPECT_EQ(at.done, i + 1);
    EXPECT_EQ(at.total, 25);
    if (i > 0) {
      EXPECT_GE(at.seconds, story.told[static_cast<std::size_t>(i) - 1].seconds);
    }
  }
}

TEST_P(SequenceThreads, NeverHasMoreFramesThanSlots) {
  for (const int in_flight : {1, 2, 5}) {
    Story story;
    int most_slots = 0;
    story.event = [&](const std::string& step, int) {
      if (step == "begin") most_slots = std::max(most_slots, story.slots.load());
    };
    tell(story, {numbers(30), in_flight}, GetParam());
    EXPECT_EQ(most_slots, in_flight);
    EXPECT_LE(story.most_busy, in_flight);
    EXPECT_EQ(story.slots, 0) << "all are gone in the end";
  }
}

TEST_P(SequenceThreads, TheFirstErrorStopsItAndNamesTheFrame) {
  for (const std::string where : {"begin", "read", "run", "write", "done"}) {
    Story story;
    story.event = [&](const std::string& step, int frame) {
      if (step == where && frame == 86) throw Error("the dog ate it", Fault::kRetry);
    };
    const Sequence sequence{numbers(30), 3};
    try {
      tell(story, sequence, GetParam());
      ADD_FAILURE() << "no error from " << where;
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "frame 86: the dog ate it");
      EXPECT_EQ(error.fault(), Fault::kRetry);
    }
    // 86 is the eighth frame: seven are written and told, and at most two frames began after 86.
    EXPECT_EQ(story.told.size(), 7u) << where;
    for (int i = 0; i < 7; ++i) EXPECT_TRUE(story.written.contains(100 - 2 * i)) << where;
    EXPECT_EQ(story.written.contains(86), where == "done");
    EXPECT_LE(story.begun.size(), 10u) << where;
    EXPECT_EQ(story.slots, 0);
  }
}

/// Frame 98 fails last, but comes before the other failing frames in the sequence.
TEST_P(SequenceThreads, TheEarliestFrameThatFailsIsTheOneNamed) {
  Story story;
  story.event = [&](const std::string& step, int frame) {
    if (step == "write" && frame == 98) throw Error("late");
    if (step == "read" && frame < 98) throw Error("early");
  };
  try {
    tell(story, {numbers(9), 4}, GetParam());
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "frame 98: late");
  }
  ASSERT_EQ(story.told.size(), 1u);
  EXPECT_EQ(story.told[0].frame, 100);
}

TEST_P(SequenceThreads, WhatIsNoErrorOfOursBecomesOne) {
  const auto error_of = [&](const std::function<void()>& event) {
    Story story;
    story.event = [&](const std::string& step, int) {
      if (step == "run") event();
    };
    try {
      tell(story, {{7}, 3}, GetParam());
    } catch (const Error& error) {
      return error;
    }
    return Error("none");
  };
  const Error memory = error_of([] { throw std::bad_alloc(); });
  EXPECT_STREQ(memory.what(), "frame 7: needs more memory than there is");
  EXPECT_EQ(memory.fault(), Fault::kMemory);
  EXPECT_STREQ(error_of([] { throw std::runtime_error("odd"); }).what(), "frame 7: odd");
  EXPECT_THAT(error_of([] { throw 5; }).what(), ::testing::StartsWith("frame 7: "));
}

TEST_P(SequenceThreads, MayBeShorterThanItsSlotsOrEmpty) {
  Story one;
  int slots = 0;
  one.event = [&](const std::string&, int) { slots = one.slots; };
  tell(one, {{4}, 3}, GetParam());
  EXPECT_EQ(slots, 1);
  EXPECT_EQ(one.told.size(), 1u);
  Story none;
  tell(none, {{}, 3}, GetParam());
  EXPECT_TRUE(none.told.empty());
}

INSTANTIATE_TEST_SUITE_P(Threads, SequenceThreads, testing::Values(0, 1, 2),
                         [](const auto& with) { return std::to_string(with.param); });

TEST(Sequence, RefusesToHaveNothingOrTooMuchInFlight) {
  for (const int in_flight : {0, -1, 65}) {
    Story story;
    try {
      tell(story, {{1}, in_flight}, 1);
      ADD_FAILURE() << in_flight;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()),
                "frames in flight = " + std::to_string(in_flight) + ": expected 1 ... 64");
      EXPECT_EQ(error.fault(), Fault::kUsage);
    }
    EXPECT_TRUE(story.begun.empty());
  }
}

TEST(Sequence, ProgressKnowsRateAndTimeLeft) {
  const SequenceProgress progress{8, 10, 40, 5};
  EXPECT_EQ(progress.frames_per_second(), 2);
  EXPECT_EQ(progress.seconds_left(), 15);
}

}  // namespace
}  // namespace limpid
