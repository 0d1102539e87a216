#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "core/executor_pool.h"

/// The executor of the build with ThreadSanitizer: threads of the standard library, made for each
/// call. It keeps the promises of executor.h and no others, so that code that relies on more fails.

namespace limpid {
namespace {

constexpr int kUsualThreads = 4;

template <class Work>
void on_threads(int threads, Work&& work) {
  std::vector<std::thread> pool;
  for (int i = 0; i < threads; ++i) pool.emplace_back(work);
  for (std::thread& thread : pool) thread.join();
}

class ThreadExecutor : public Executor {
 public:
  explicit ThreadExecutor(int threads) : threads_(threads == 0 ? kUsualThreads : threads) {}

  void run(int count, Task task, void* context) override {
    std::atomic<int> next = 0;
    on_threads(std::min(threads_, count), [&] {
      // Relaxed: no promise covers the order of two tasks.
      for (int i = next.fetch_add(1, std::memory_order_relaxed); i < count;
           i = next.fetch_add(1, std::memory_order_relaxed)) {
        task(context, i);
      }
    });
  }

  void pipeline(int count, int in_flight, std::span<const Task> steps, void* context) override {
    if (steps.size() < 2) return Executor::pipeline(count, in_flight, steps, context);
    std::mutex first, last;
    std::condition_variable left;
    int next = 0, leaving = 0;
    // Each thread works on one item at a time.
    on_threads(std::min(in_flight, count), [&] {
      for (;;) {
        int item = 0;
        {
          const std::lock_guard lock(first);
          if (next == count) return;
          item = next++;
          steps.front()(context, item);
        }
        for (const Task step : steps.subspan(1, steps.size() - 2)) step(context, item);
        std::unique_lock lock(last);
        left.wait(lock, [&] { return leaving == item; });
        steps.back()(context, item);
        ++leaving;
        left.notify_all();
      }
    });
  }

 private:
  int threads_;
};

}  // namespace

std::unique_ptr<Executor> make_pool(int threads) {
  return std::make_unique<ThreadExecutor>(threads);
}

}  // namespace limpid
