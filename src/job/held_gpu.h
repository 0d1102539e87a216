#pragma once
#include <mutex>
#include <optional>
#include <string>

#include "limpid/gpu/gpu_runner.h"
#include "limpid/job/output.h"

namespace limpid {

/// What a runner on a GPU is made with.
inline GpuOptions gpu_options(const OutputChoice& choice) {
  return {.device = choice.gpu, .cache = choice.gpu_cache, .simd = choice.simd};
}

/// Keeps the device of many frames open, so that none opens it anew. Any threads may ask.
class HeldGpu {
 public:
  /// GpuRunner::device() of the one that is chosen; "" for other runners. Throws Error as
  /// GpuRunner.
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
