#pragma once
#include <atomic>
#include <exception>
#include <memory>
#include <span>

namespace limpid {

/// Who runs the tiles: the library's own pool, or a host's. Tasks do not throw.
class Executor {
 public:
  using Task = void (*)(void* context, int index);
  virtual ~Executor() = default;

  /// Calls task(context, i) once for each i in 0 ... count - 1, on any threads, in any order, and
  /// returns when all are done. Several threads may call it at once, if they share the executor.
  virtual void run(int count, Task task, void* context) = 0;

  /// Takes the items 0 ... count - 1 through all steps, and returns when all are through. The first
  /// and the last step take them in order, one at a time; those between take several at once, in
  /// any order, and may call run(). Item i begins when item i - in_flight has left the last step.
  /// A host that does not override it has each item go through alone.
  virtual void pipeline(int count, int in_flight, std::span<const Task> steps, void* context);
};

/// Calls work(i) once for each i in 0 ... count - 1, as Executor::run() does. Work that throws, for
/// want of memory as a rule, harms no executor: the first exception is thrown again here when all
/// that had begun is done, and what had not begun by then is left out.
template <class Work>
void run_each(Executor& executor, int count, const Work& work) {
  struct Tasks {
    const Work& work;
    std::atomic<bool> failed = false;
    std::exception_ptr failure = {};
  } tasks{work};
  const auto task = [](void* context, int index) {
    Tasks& all = *static_cast<Tasks*>(context);
    if (all.failed.load(std::memory_order_relaxed)) return;
    try {
      all.work(index);
    } catch (...) {
      if (!all.failed.exchange(true)) all.failure = std::current_exception();
    }
  };
  executor.run(count, task, &tasks);
  if (tasks.failure) std::rethrow_exception(tasks.failure);
}

/// oneTBB with that many threads, but no more than the machine has; 0 means all of them. Where the
/// system lets the process make fewer (`ulimit -u`, or no memory for their stacks) it has those.
/// Throws Error for a negative number.
std::unique_ptr<Executor> make_executor(int threads);

}  // namespace limpid
