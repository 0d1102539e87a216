#pragma once
#include <memory>

#include "limpid/core/executor.h"

#include "gpu/commands.h"
#include "gpu/memory.h"
#include "shade/program.h"

namespace limpid {

/// A picture on the device, and the memory through which it comes or goes.
struct Passage {
  /// How a channel is stored; bits: 32 of them for a whole texel.
  enum class Storage { kByte, kHalf, kFloat, kBits };

  GpuImage image;
  GpuBuffer buffer;
  int step = 0;  ///< channels a texel: 1 or 4
  Storage storage = Storage::kFloat;

  /// Makes both for a picture that a program writes, in float, unless they are there.
  void fit_output(const std::shared_ptr<GpuDevice>& device, Size size);

  /// Takes the values of a program's texture into the memory, and makes an image that fits them:
  /// of halves, or for what is no plane of the frame of bytes, if those are the very values.
  /// Shaders are faster the narrower it is, and so is the bus. Once values of a size were not such,
  /// they stay wide.
  void fill(const std::shared_ptr<GpuDevice>& device, const ProgramTexture& texture,
            Executor& executor);
  /// From there to the device, for shaders to read.
  void upload(const Vulkan& vk, VkCommandBuffer commands) const;
  /// From the device, where shaders have written it, into the memory.
  void download(const Vulkan& vk, VkCommandBuffer commands) const;

 private:
  void fit(const std::shared_ptr<GpuDevice>& device, Size size, int channels, Storage chosen,
           VkImageUsageFlags image_use, VkBufferUsageFlags buffer_use);
};

}  // namespace limpid
