#pragma once
#include <functional>
#include <memory>

#include "gpu/device.h"

namespace limpid {

/// Commands that are recorded, run and waited for, again and again.
class GpuCommands {
 public:
  explicit GpuCommands(std::shared_ptr<GpuDevice> device);
  ~GpuCommands();
  GpuCommands(const GpuCommands&) = delete;
  GpuCommands& operator=(const GpuCommands&) = delete;

  void run(const std::function<void(VkCommandBuffer)>& write);

 private:
  void destroy();

  std::shared_ptr<GpuDevice> device_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
};

/// The use of an image before or after a command.
struct ImageUse {
  VkImageLayout layout;
  VkPipelineStageFlags stage;
  VkAccessFlags access;
};
inline constexpr ImageUse kUnused{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0};
inline constexpr ImageUse kCopiedTo{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                    VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT};
inline constexpr ImageUse kCopiedFrom{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                      VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT};
inline constexpr ImageUse kRead{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT};
inline constexpr ImageUse kWritten{VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                   VK_ACCESS_SHADER_WRITE_BIT};

/// A barrier between two uses.
void turn(const Vulkan& vk, VkCommandBuffer commands, VkImage image, const ImageUse& from,
          const ImageUse& to);

}  // namespace limpid
