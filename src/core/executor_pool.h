#pragma once
#include <memory>

#include "limpid/core/executor.h"

namespace limpid {

/// An executor of two threads or more; 0: as many as the machine has cores.
std::unique_ptr<Executor> make_pool(int threads);

}  // namespace limpid
