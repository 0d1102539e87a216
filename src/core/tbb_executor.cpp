#include <algorithm>
#include <atomic>
#include <system_error>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "limpid/core/error.h"

#include "core/executor_pool.h"
#include "core/memory.h"
#include "core/threads.h"

namespace limpid {
namespace {

/// oneTBB's stack size, or the program's thread stack size if it is smaller.
std::size_t stack_bytes() {
  using tbb::global_control;
  return std::min(global_control::active_value(global_control::thread_stack_size),
                  usual_stack_bytes());
}

/// The least of the requested threads, the machine's cores, and the threads that can be made,
/// including the calling thread.
int threads_of(int asked) {
  const int most = tbb::this_task_arena::max_concurrency();
  return 1 + threads_to_be_had((asked == 0 ? most : std::min(asked, most)) - 1, stack_bytes());
}

/// The destructor of the last executor joins the pool's threads. Otherwise they could still be
/// ending while the program ends, which leak checkers report.
class TbbExecutor : public Executor {
 public:
  explicit TbbExecutor(int threads) : arena_(threads_of(threads)) {}

  ~TbbExecutor() override {
    if (lacks_thread_) return;  // finalize() would wait for a thread that never began
    arena_.terminate();
    tbb::finalize(pool_, std::nothrow);  // false if another user of the pool remains
  }

  /// Isolated: a thread that waits for the last tiles must not start other work, such as another
  /// frame's file.
  void run(int count, Task task, void* context) override {
    const auto all = [&] { tbb::parallel_for(0, count, [&](int index) { task(context, index); }); };
    execute([&] { tbb::this_task_arena::isolate(all); });
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
    execute([&] { tbb::parallel_pipeline(static_cast<std::size_t>(in_flight), whole); });
  }

 private:
  /// oneTBB makes its threads when there is work for them.
  template <class Work>
  void execute(Work work) {
    try {
      arena_.execute(work);
    } catch (const std::system_error& error) {
      lacks_thread_ = true;
      if (!has_memory(stack_bytes())) throw no_memory("the stack of a thread");
      throw Error(error.what(), Fault::kRetry);
    }
  }

  tbb::global_control stacks_{tbb::global_control::thread_stack_size, stack_bytes()};
  tbb::task_scheduler_handle pool_{tbb::attach{}};
  tbb::task_arena arena_;
  std::atomic<bool> lacks_thread_ = false;
};

}  // namespace

std::unique_ptr<Executor> make_pool(int threads) { return std::make_unique<TbbExecutor>(threads); }

}  // namespace limpid
