#pragma once
#include <memory>

namespace limpid {

/// Who runs the tiles: the library's own pool, or a host's. `run` calls task(context, i) once for
/// each i in 0 ... count - 1, on any threads, in any order, and returns when all are done. Tasks do
/// not throw.
class Executor {
 public:
  using Task = void (*)(void* context, int index);
  virtual ~Executor() = default;
  virtual void run(int count, Task task, void* context) = 0;
};

/// oneTBB with that many threads, but no more than the machine has; 0 means all of them. Throws
/// Error for a negative number.
std::unique_ptr<Executor> make_executor(int threads);

}  // namespace limpid
