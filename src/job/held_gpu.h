#pragma once
#include <mutex>
#include <optional>
#include <string>

#include "limpid/gpu/gpu_runner.h"
#include "limpid/job/output.h"

namespace limpid {

/// Options of a GPU runner for an output.
inline GpuOptions gpu_options(const OutputChoice& choice) {
  return {.device = choice.gpu, .cache = choice.gpu_cache, .simd = choice.simd};
}

/// Keeps a device open over many frames. Any number of threads may use it.
class HeldGpu {
 public:
  /// GpuRunner::device() of the chosen device; "" for other runners. Throws Error as GpuRunner.
  std::string name(const OutputChoice& choice) {
    if (choice.runner != Runner::kGpu) return "";
    const std::lock_guard lock(mutex_);
    if (!holder_ || choice.gpu != held_) holder_.emplace(gpu_options(choice));
    held_ = choice.gpu;
    return holder_->device();
  }

 private:
  std::mutex mutex_;
  std::string held_;
  std::optional<GpuRunner> holder_;
};

}  // namespace limpid
