#pragma once
#include <memory>

#include "limpid/core/executor.h"

#include "gpu/commands.h"
#include "gpu/memory.h"
#include "shade/program.h"

namespace limpid {

/// A picture of floats on the device, and the memory through which it comes or goes.
struct Passage {
  GpuImage image;
  GpuBuffer buffer;
  int step = 0;  ///< floats a texel: 1 or 4

  /// Makes both, unless they are there. Returns whether they are new.
  bool fit(const std::shared_ptr<GpuDevice>& device, Size size, int channels,
           VkImageUsageFlags image_use, VkBufferUsageFlags buffer_use);
  /// For a texture of a program.
  bool fit_input(const std::shared_ptr<GpuDevice>& device, const ProgramTexture& texture);
  /// For a picture that a program makes.
  bool fit_output(const std::shared_ptr<GpuDevice>& device, Size size);

  /// The texture into the memory.
  void fill(const ProgramTexture& texture, Executor& executor) const;
  /// From there to the device, for shaders to read.
  void upload(const Vulkan& vk, VkCommandBuffer commands) const;
  /// From the device, where shaders have written it, into the memory.
  void download(const Vulkan& vk, VkCommandBuffer commands) const;
};

}  // namespace limpid
