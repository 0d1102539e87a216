#pragma once
#include <atomic>
#include <exception>
#include <memory>
#include <span>

namespace limpid {

/// Runs tasks on threads: the library's own pool, or a host's. Tasks do not throw.
class Executor {
 public:
  using Task = void (*)(void* context, int index);
  virtual ~Executor() = default;

  /// Calls task(context, i) once for each i in 0 ... count - 1, on any threads, in any order, and
  /// returns when all calls have returned. Threads that share the executor may call run() at once.
  virtual void run(int count, Task task, void* context) = 0;

  /// Takes the items 0 ... count - 1 through all steps, and returns when all are done. The first
  /// and the last step take the items in order, one at a time; those between take several at once,
  /// in any order, and may call run(). Item i begins when item i - in_flight has left the last
  /// step. The default, for hosts that do not override it, takes one item at a time.
  virtual void pipeline(int count, int in_flight, std::span<const Task> steps, void* context);
};

/// Calls work(i) once for each i in 0 ... count - 1, as Executor::run() does. If a call throws
/// (usually std::bad_alloc), calls that have not begun are skipped, and the first exception is
/// rethrown after the others have returned.
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

/// An executor of oneTBB with this number of threads, at most one per core of the machine; 0 means
/// one per core. It has fewer threads if the system does not let the process start more (`ulimit
/// -u`, or no memory for their stacks). Throws Error for a negative number.
std::unique_ptr<Executor> make_executor(int threads);

}  // namespace limpid
