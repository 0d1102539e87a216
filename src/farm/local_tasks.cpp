#include "farm/local_tasks.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <thread>

#include "limpid/core/error.h"

#include "farm/programs.h"

namespace limpid {

void run_tasks(const FarmFolder& folder, std::size_t tasks, int at_once,
               const std::function<void()>& on_end) {
  std::mutex mutex;
  std::size_t next = 1;
  std::optional<Error> failure;
  const auto take = [&]() -> std::size_t {
    const std::lock_guard lock(mutex);
    return failure || next > tasks ? 0 : next++;
  };
  const auto work = [&] {
    try {
      while (const std::size_t task = take()) {
        run_program({"bash", folder.file("task.sh").string(), std::to_string(task)});
        const std::lock_guard lock(mutex);
        on_end();
      }
    } catch (const Error& error) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = error;
    }
  };
  {
    std::vector<std::jthread> threads;
    const std::size_t wanted = std::min(tasks, static_cast<std::size_t>(at_once));
    while (threads.size() < wanted) threads.emplace_back(work);
  }
  if (failure) throw *failure;
}

}  // namespace limpid
