#include "limpid/core/executor.h"

#include <algorithm>
#include <string>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "limpid/core/error.h"

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

  void run(int count, Task task, void* context) override {
    arena_.execute([&] { tbb::parallel_for(0, count, [&](int index) { task(context, index); }); });
  }

 private:
  tbb::task_scheduler_handle pool_{tbb::attach{}};
  tbb::task_arena arena_;
};

class CallingThread : public Executor {
 public:
  void run(int count, Task task, void* context) override {
    for (int i = 0; i < count; ++i) task(context, i);
  }
};

}  // namespace

std::unique_ptr<Executor> make_executor(int threads) {
  if (threads < 0) throw Error("threads = " + std::to_string(threads) + ": expected 0 or more");
  if (threads == 1) return std::make_unique<CallingThread>();
  return std::make_unique<TbbExecutor>(threads);
}

}  // namespace limpid
