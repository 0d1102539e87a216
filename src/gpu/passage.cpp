#include "gpu/passage.h"

#include "complete/rows.h"

namespace limpid {
namespace {

VkBufferImageCopy whole(const GpuImage& image) {
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = {static_cast<std::uint32_t>(image.size().width),
                      static_cast<std::uint32_t>(image.size().height), 1};
  return copy;
}

}  // namespace

bool Passage::fit(const std::shared_ptr<GpuDevice>& device, Size size, int channels,
                  VkImageUsageFlags image_use, VkBufferUsageFlags buffer_use) {
  const int stored = channels == 1 ? 1 : 4;
  if (image.size() == size && step == stored) return false;
  *this = {};  // before another is made
  const VkFormat format = stored == 1 ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
  image = GpuImage(device, size, format, image_use);
  const std::size_t texels = static_cast<std::size_t>(size.width) * size.height;
  buffer = GpuBuffer(device, texels * stored * sizeof(float), buffer_use);
  step = stored;
  return true;
}

bool Passage::fit_input(const std::shared_ptr<GpuDevice>& device, const ProgramTexture& texture) {
  return fit(device, {texture.width, texture.height}, texture.channels,
             VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
             VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
}

bool Passage::fit_output(const std::shared_ptr<GpuDevice>& device, Size size) {
  return fit(device, size, 4, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
             VK_BUFFER_USAGE_TRANSFER_DST_BIT);
}

void Passage::fill(const ProgramTexture& texture, Executor& executor) const {
  const std::ptrdiff_t row = std::ptrdiff_t{step} * texture.width;
  each_row(executor, {0, 0, texture.width, texture.height},
           [&](int y) { texture.fill(y, buffer.floats() + row * y, step); });
}

void Passage::upload(const Vulkan& vk, VkCommandBuffer commands) const {
  turn(vk, commands, image.handle(), kUnused, kCopiedTo);
  const VkBufferImageCopy copy = whole(image);
  vk.vkCmdCopyBufferToImage(commands, buffer.handle(), image.handle(), kCopiedTo.layout, 1, &copy);
  turn(vk, commands, image.handle(), kCopiedTo, kRead);
}

void Passage::download(const Vulkan& vk, VkCommandBuffer commands) const {
  turn(vk, commands, image.handle(), kWritten, kCopiedFrom);
  const VkBufferImageCopy copy = whole(image);
  vk.vkCmdCopyImageToBuffer(commands, image.handle(), kCopiedFrom.layout, buffer.handle(), 1,
                            &copy);
  turn(vk, commands, image.handle(), kCopiedFrom, kWritten);
}

}  // namespace limpid
