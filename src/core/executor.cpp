#include "limpid/core/executor.h"

#include <string>

#include "limpid/core/error.h"

#include "core/executor_pool.h"

namespace limpid {
namespace {

class CallingThread : public Executor {
 public:
  void run(int count, Task task, void* context) override {
    for (int i = 0; i < count; ++i) task(context, i);
  }
};

}  // namespace

void Executor::pipeline(int count, int /*in_flight*/, std::span<const Task> steps, void* context) {
  for (int index = 0; index < count; ++index) {
    for (const Task step : steps) step(context, index);
  }
}

std::unique_ptr<Executor> make_executor(int threads) {
  if (threads < 0) throw Error("threads = " + std::to_string(threads) + ": expected 0 or more");
  if (threads == 1) return std::make_unique<CallingThread>();
  return make_pool(threads);
}

}  // namespace limpid
