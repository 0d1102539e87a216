#pragma once
#include <memory>

#include "limpid/core/executor.h"

#include "gpu/commands.h"
#include "gpu/memory.h"
#include "shade/program.h"

namespace limpid {

/// An image on the device, and the memory for its transfers.
struct Passage {
  /// Storage of a channel; bits: 32 bits for a whole texel.
  enum class Storage { kByte, kHalf, kFloat, kBits };

  GpuImage image;
  GpuBuffer buffer;
  int step = 0;  ///< channels per texel: 1 or 4
  Storage storage = Storage::kFloat;

  /// Makes both, unless they exist, for an image that a program writes, in float.
  void fit_output(const std::shared_ptr<GpuDevice>& device, Size size);

  /// Copies the values of a program's texture into the memory, and makes an image for them: of
  /// halves or, for textures that are not planes of the frame, of bytes, if those represent the
  /// values exactly. Narrow images are faster for shaders and for the bus. Once values of a size
  /// did not fit, the image stays wide.
  void fill(const std::shared_ptr<GpuDevice>& device, const ProgramTexture& texture,
            Executor& executor);
  /// From the memory to the device, for shaders to read.
  void upload(const Vulkan& vk, VkCommandBuffer commands) const;
  /// From the device, after shaders have written, into the memory.
  void download(const Vulkan& vk, VkCommandBuffer commands) const;

 private:
  void fit(const std::shared_ptr<GpuDevice>& device, Size size, int channels, Storage chosen,
           VkImageUsageFlags image_use, VkBufferUsageFlags buffer_use);
};

}  // namespace limpid
