#pragma once
#include <algorithm>

#include "limpid/core/executor.h"
#include "limpid/core/rect.h"

namespace limpid {

/// work(y) for each row of a window, some rows per task. Hidden, so that its instantiations in
/// headers export no symbol to hosts.
template <class Work>
[[gnu::visibility("hidden")]] void each_row(Executor& executor, const Rect& window,
                                            const Work& work) {
  constexpr int kRows = 8;
  run_each(executor, (window.height() + kRows - 1) / kRows, [&](int index) {
    const int begin = window.y0 + index * kRows;
    for (int y = begin; y < std::min(begin + kRows, window.y1); ++y) work(y);
  });
}

}  // namespace limpid
