#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/plan/plan.h"
#include "limpid/run/target.h"

namespace limpid {

struct GpuOptions {
  /// Part of the name of the device; letter case is ignored. "" for the first device of the fastest
  /// kind: discrete, integrated, virtual, software.
  std::string device = {};
  /// A folder that caches compiled shaders, "" for none; it is created if missing. If it cannot be
  /// written, shaders are compiled again at the next start.
  std::filesystem::path cache = {};
  /// Instruction set of the work on the CPU, as in FusedOptions.
  std::string simd = {};
};

/// The runner on a GPU, through Vulkan 1.2: the plan as one shader (shade/shader_text.h), run
/// over arrays in this program's memory. Completers, mixed edges, and AOVs that are planes of
/// the frame run on the CPU; the shader does the rest, with the same operators on every pixel:
/// there is no survey of cells, and Plan::max_error has no effect. The error against
/// run_reference() is that of the fused runner: see docs/gpu.md. The bits depend on the device
/// and its driver.
///
/// The library does not link Vulkan: the constructor loads libvulkan.so.1. The shader is compiled
/// when a plan first needs it (by the module limpid_shaders); memory is kept from frame to frame,
/// also that of the device. All runners of one device share it, and their transfers overlap the
/// shaders of others. One run at a time.
class GpuRunner {
 public:
  /// Throws Error if there is no such device with Vulkan 1.2 that preserves infinity in floats.
  explicit GpuRunner(const GpuOptions& options = {});
  GpuRunner(GpuRunner&&) noexcept;
  GpuRunner& operator=(GpuRunner&&) noexcept;
  ~GpuRunner();

  /// Throws Error as run_reference() does, for a frame that is larger than the images of the
  /// device, if the device is out of memory, and if the device is lost.
  void run(const Plan& plan, const Frame& frame, const Scene& scene, const Target& target,
           Executor& executor);

  /// "NVIDIA H100 80GB HBM3 (NVIDIA 580.159)": the device, and its driver.
  const std::string& device() const;

 private:
  struct Kept;  // from frame to frame
  std::unique_ptr<Kept> kept_;
};

/// A device for a runner.
struct GpuInfo {
  std::string name;
  bool software = false;  ///< not a GPU, but a driver that computes on the CPU
};
/// All devices, those of the fastest kind first. Throws Error if the Vulkan loader is not
/// installed.
std::vector<GpuInfo> gpu_devices();

}  // namespace limpid
