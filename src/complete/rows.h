#pragma once
#include <algorithm>

#include "limpid/core/executor.h"
#include "limpid/core/rect.h"

namespace limpid {

/// work(y) for each row of a window, some rows a task.
template <class Work>
void each_row(Executor& executor, const Rect& window, const Work& work) {
  constexpr int kRows = 8;
  struct Job {
    const Rect& window;
    const Work& work;
    static void run(void* self, int index) {
      const Job& job = *static_cast<const Job*>(self);
      const int begin = job.window.y0 + index * kRows;
      for (int y = begin; y < std::min(begin + kRows, job.window.y1); ++y) job.work(y);
    }
  };
  Job job{window, work};
  executor.run((window.height() + kRows - 1) / kRows, Job::run, &job);
}

}  // namespace limpid
