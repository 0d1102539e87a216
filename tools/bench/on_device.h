#pragma once
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "limpid/core/executor.h"

#include "gpu/bindings.h"
#include "gpu/commands.h"
#include "gpu/passage.h"
#include "shade/program.h"

namespace limpid::bench {

/// A program and its textures on a device, for any number of runs.
class OnDevice {
 public:
  /// With `filter` the device's own bilinear filter reads the textures; those named in `tiled`
  /// repeat.
  OnDevice(std::shared_ptr<GpuDevice> device, const ShaderProgram& program, Executor& executor,
           bool filter = false, const std::string& tiled = "");
  ~OnDevice();

  /// Runs the shader once and many times in a row, with data on the device.
  void time_shader();
  /// Seconds of one run: the shortest time of many runs in a row less the shortest of one run,
  /// divided by kTimes. A device that has rested is slow at first, so the first times do not count
  /// unless they are all.
  double shader_seconds() const { return (many_ - one_) / kTimes; }
  /// Seconds to copy all textures to the device and the pictures back, without a run.
  double bus_seconds();
  /// One frame from memory that the device reads and writes by itself, back into such memory:
  /// textures to the device, the shader, the pictures back.
  void run_frame();
  /// Bytes of textures, picture and AOVs.
  std::size_t bytes() const;
  /// The first output: four floats per pixel.
  std::vector<float> picture();

 private:
  void upload(VkCommandBuffer c) const;
  void download(VkCommandBuffer c) const;
  double seconds_of_run(const std::function<void(VkCommandBuffer)>& write);

  static constexpr int kTimes = 100;
  std::shared_ptr<GpuDevice> device_;
  ShaderProgram program_;
  GpuCommands commands_;
  GpuBindings bindings_;
  GpuBuffer block_;
  VkSampler clamped_ = VK_NULL_HANDLE, tiled_ = VK_NULL_HANDLE;
  std::vector<Passage> inputs_, outputs_;
  double one_ = HUGE_VAL, many_ = HUGE_VAL;
};

}  // namespace limpid::bench
