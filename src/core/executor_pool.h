#pragma once
#include <memory>

#include "limpid/core/executor.h"

namespace limpid {

/// An executor of two or more threads; 0: one per core of the machine.
std::unique_ptr<Executor> make_pool(int threads);

}  // namespace limpid
