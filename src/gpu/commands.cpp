#include "gpu/commands.h"

#include <utility>

namespace limpid {

GpuCommands::GpuCommands(std::shared_ptr<GpuDevice> device) : device_(std::move(device)) {
  const Vulkan& vk = device_->vk();
  const VkDevice d = device_->handle();
  try {
    auto pool = vulkan_struct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = device_->family();
    expect(vk.vkCreateCommandPool(d, &pool, nullptr, &pool_), "vkCreateCommandPool");
    auto allocate =
        vulkan_struct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocate.commandPool = pool_;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    expect(vk.vkAllocateCommandBuffers(d, &allocate, &commands_), "vkAllocateCommandBuffers");
    const auto fence = vulkan_struct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    expect(vk.vkCreateFence(d, &fence, nullptr, &fence_), "vkCreateFence");
  } catch (...) {
    destroy();
    throw;
  }
}

GpuCommands::~GpuCommands() { destroy(); }

void GpuCommands::destroy() {
  const Vulkan& vk = device_->vk();
  vk.vkDestroyFence(device_->handle(), fence_, nullptr);
  vk.vkDestroyCommandPool(device_->handle(), pool_, nullptr);
}

void GpuCommands::run(const std::function<void(VkCommandBuffer)>& write) {
  const Vulkan& vk = device_->vk();
  auto begin = vulkan_struct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  expect(vk.vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
  try {
    write(commands_);
  } catch (...) {
    vk.vkEndCommandBuffer(commands_);  // as the next begin expects
    throw;
  }
  expect(vk.vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
  device_->submit(commands_, fence_);
}

void turn(const Vulkan& vk, VkCommandBuffer commands, VkImage image, const ImageUse& from,
          const ImageUse& to) {
  auto barrier = vulkan_struct<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
  barrier.srcAccessMask = from.access;
  barrier.dstAccessMask = to.access;
  barrier.oldLayout = from.layout;
  barrier.newLayout = to.layout;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  vk.vkCmdPipelineBarrier(commands, from.stage, to.stage, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

}  // namespace limpid
