#include "limpid/core/executor.h"

#include <array>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "memory_end.h"
#include "sanitized.h"

namespace limpid {
namespace {

/// A line of work that counts how often each step took each item, the order at both ends, and the
/// largest number of items under way.
struct Line {
  Line(int items, int allowed) : in_flight(allowed), taken(static_cast<std::size_t>(items)) {}

  static Line& of(void* context) { return *static_cast<Line*>(context); }
  static void begin(void* context, int index) {
    Line& line = of(context);
    line.begun.push_back(index);
    line.most = std::max(line.most, line.begun.size() - line.left);
    EXPECT_LT(index, static_cast<int>(line.left) + line.in_flight);
    ++line.taken[static_cast<std::size_t>(index)][0];
  }
  template <int kStep>
  static void work(void* context, int index) {
    const std::lock_guard lock(of(context).mutex);
    auto& steps = of(context).taken[static_cast<std::size_t>(index)];
    EXPECT_EQ(steps[kStep - 1], 1) << "step " << kStep << " of item " << index;
    ++steps[kStep];
  }
  static void end(void* context, int index) {
    Line& line = of(context);
    EXPECT_EQ(line.left, static_cast<std::size_t>(index));
    EXPECT_EQ(line.taken[static_cast<std::size_t>(index)][2], 1);
    ++line.left;
  }

  int in_flight;
  std::vector<std::array<int, 3>> taken;
  std::vector<int> begun;
  std::atomic<std::size_t> left = 0;
  std::size_t most = 0;
  std::mutex mutex;
};

constexpr Executor::Task kSteps[] = {&Line::begin, &Line::work<1>, &Line::work<2>, &Line::end};

class Pipeline : public testing::TestWithParam<int> {};

TEST_P(Pipeline, TakesEachItemThroughEachStepInOrderAtBothEnds) {
  const auto executor = make_executor(GetParam());
  for (const int in_flight : {1, 2, 3, 7}) {
    Line line(40, in_flight);
    executor->pipeline(40, in_flight, kSteps, &line);
    EXPECT_EQ(line.left, 40u);
    EXPECT_LE(line.most, static_cast<std::size_t>(in_flight));
    for (int i = 0; i < 40; ++i) EXPECT_EQ(line.begun[static_cast<std::size_t>(i)], i);
  }
}

TEST_P(Pipeline, NothingIsDoneForNoItems) {
  Line line(0, 3);
  make_executor(GetParam())->pipeline(0, 3, kSteps, &line);
  EXPECT_TRUE(line.begun.empty());
}

/// A step whose executor runs tiles, as in compositing.
TEST_P(Pipeline, StepsMayRunTiles) {
  struct Job {
    std::unique_ptr<Executor> executor;
    std::atomic<int> tiles = 0;
  } job{make_executor(GetParam())};
  constexpr auto kNothing = [](void*, int) {};
  constexpr Executor::Task kTiles[] = {
      kNothing,
      [](void* context, int) {
        const auto tile = [](void* inner, int) { ++static_cast<Job*>(inner)->tiles; };
        static_cast<Job*>(context)->executor->run(50, tile, context);
      },
      kNothing};
  job.executor->pipeline(20, 4, kTiles, &job);
  EXPECT_EQ(job.tiles, 1000);
}

INSTANTIATE_TEST_SUITE_P(Threads, Pipeline, testing::Values(0, 1, 2),
                         [](const auto& with) { return std::to_string(with.param); });

/// A host's own pool that runs tiles only.
class Host : public Executor {
 public:
  void run(int count, Task task, void* context) override {
    for (int i = count; i-- > 0;) task(context, i);
  }
};

TEST(Pipeline, OfAHostThatKnowsTilesOnlyGoesItemByItem) {
  Host host;
  Line line(5, 3);
  host.pipeline(5, 3, kSteps, &line);
  EXPECT_EQ(line.left, 5u);
  EXPECT_EQ(line.most, 1u);
}

/// Ends the process with the sum of an executor's tasks.
[[noreturn]] void count_without_threads() {
  test::make_threads_impossible();
  const tbb::global_control stacks(tbb::global_control::thread_stack_size, std::size_t{4} << 30);
  std::atomic<int> sum = 0;
  make_executor(2)->run(
      8, [](void* context, int index) { *static_cast<std::atomic<int>*>(context) += index; }, &sum);
  std::_Exit(sum);
}

TEST(Executor, HasFewerThreadsWhereNoMoreCanBeMade) {
  if (test::kSanitized) GTEST_SKIP() << "a sanitizer has addresses of its own";
  EXPECT_EXIT(count_without_threads(), ::testing::ExitedWithCode(28), "");
}

/// A host's executor whose tasks must not throw.
class Strict : public Executor {
 public:
  void run(int count, Task task, void* context) override {
    for (int i = 0; i < count; ++i) {
      try {
        task(context, i);
        ++done;
      } catch (...) {
        ++thrown;
      }
    }
  }
  int done = 0, thrown = 0;
};

TEST(RunEach, CallsEachOnce) {
  for (const int threads : {1, 2}) {
    std::array<std::atomic<int>, 100> taken{};
    run_each(*make_executor(threads), 100, [&](int i) { ++taken[static_cast<std::size_t>(i)]; });
    for (const auto& times : taken) EXPECT_EQ(times, 1);
  }
}

TEST(RunEach, CarriesWhatIsThrownPastTheExecutor) {
  Strict host;
  int worked = 0;
  const auto work = [&](int i) {
    if (i >= 3) throw i;
    ++worked;
  };
  try {
    run_each(host, 10, work);
    ADD_FAILURE() << "nothing was thrown";
  } catch (int first) {
    EXPECT_EQ(first, 3);
  }
  EXPECT_EQ(worked, 3);
  EXPECT_EQ(host.done, 10);
  EXPECT_EQ(host.thrown, 0);
  EXPECT_THROW(run_each(*make_executor(2), 10, work), int);
}

}  // namespace
}  // namespace limpid
