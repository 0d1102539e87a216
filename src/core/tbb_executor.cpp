#include <algorithm>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "core/executor_pool.h"

namespace limpid {
namespace {

/// The last of these to go joins the pool's threads. Left to themselves they would still be ending
/// while the program ends, which leak checkers stumble over.
class TbbExecutor : public Executor {
 public:
  explicit TbbExecutor(int threads)
      : arena_(threads == 0 ? tbb::task_arena::automatic
                            : std::min(threads, tbb::this_task_arena::max_concurrency())) {}

  ~TbbExecutor() override {
    arena_.terminate();
    tbb::finalize(pool_, std::nothrow);  // false while somebody else still uses the pool
  }

  /// Isolated: who waits for the last tiles must not begin with something else, such as another
  /// frame's file.
  void run(int count, Task task, void* context) override {
    const auto all = [&] { tbb::parallel_for(0, count, [&](int index) { task(context, index); }); };
    arena_.execute([&] { tbb::this_task_arena::isolate(all); });
  }

  void pipeline(int count, int in_flight, std::span<const Task> steps, void* context) override {
    if (steps.size() < 2) return Executor::pipeline(count, in_flight, steps, context);
    int next = 0;
    auto line = tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order,
                                            [&](tbb::flow_control& flow) {
                                              if (next == count) {
                                                flow.stop();
                                                return next;
                                              }
                                              steps.front()(context, next);
                                              return next++;
                                            });
    for (const Task step : steps.subspan(1, steps.size() - 2)) {
      line = line & tbb::make_filter<int, int>(tbb::filter_mode::parallel, [=](int index) {
               step(context, index);
               return index;
             });
    }
    const auto whole =
        line & tbb::make_filter<int, void>(tbb::filter_mode::serial_in_order,
                                           [&](int index) { steps.back()(context, index); });
    arena_.execute([&] { tbb::parallel_pipeline(static_cast<std::size_t>(in_flight), whole); });
  }

 private:
  tbb::task_scheduler_handle pool_{tbb::attach{}};
  tbb::task_arena arena_;
};

}  // namespace

std::unique_ptr<Executor> make_pool(int threads) { return std::make_unique<TbbExecutor>(threads); }

}  // namespace limpid
