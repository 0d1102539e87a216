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
  /// A part of the name of the device, in any case; "" for the first of the fastest kind: discrete,
  /// integrated, virtual, software.
  std::string device = {};
  /// A folder in which compiled shaders are kept for the next start, "" for none; it is made at
  /// need. Where nothing can be written the next start takes longer, no more.
  std::filesystem::path cache = {};
  /// Instruction set of what is made on the CPU before, as in FusedOptions.
  std::string simd = {};
};

/// The runner on a GPU, through Vulkan 1.2: the plan as one shader (shade/shader_text.h), run over
/// arrays of this program's memory. What completers make, mixed edges, and AOVs that are planes of
/// the frame are the CPU's; all else that the fused runner does the shader does, too, on every
/// pixel alike: no cell is looked at first, and Plan::max_error leaves nothing out. Against
/// run_reference() it is as the fused runner: see the README. The bits depend on the device and its
/// driver.
///
/// Nothing is linked: libvulkan.so.1 is opened by the constructor. The shader is compiled when a
/// plan first needs it (by the module limpid_shaders); memory is kept from frame to frame, the
/// device's, too. All runners of one device share it, and their transfers overlap the shaders of
/// others. One run at a time.
class GpuRunner {
 public:
  /// Throws Error where there is no such device, or none that promises Vulkan 1.2 and to keep
  /// infinity among floats.
  explicit GpuRunner(const GpuOptions& options = {});
  GpuRunner(GpuRunner&&) noexcept;
  GpuRunner& operator=(GpuRunner&&) noexcept;
  ~GpuRunner();

  /// Throws Error as run_reference() does, for a frame that is larger than the device's pictures
  /// can be, for want of its memory, and when the device is lost.
  void run(const Plan& plan, const Frame& frame, const Scene& scene, const Target& target,
           Executor& executor);

  /// "NVIDIA H100 80GB HBM3 (NVIDIA 580.159)": the device, and its driver.
  const std::string& device() const;

 private:
  struct Kept;  // from frame to frame
  std::unique_ptr<Kept> kept_;
};

/// A device that a runner would run on.
struct GpuInfo {
  std::string name;
  bool software = false;  ///< no GPU at all, but a driver that computes on the CPU
};
/// All of them, those of the fastest kind first. Throws Error where Vulkan's loader is not
/// installed.
std::vector<GpuInfo> gpu_devices();

}  // namespace limpid
