#include "gpu/memory.h"

#include <algorithm>
#include <string>
#include <utility>

#include "limpid/core/error.h"

namespace limpid {

GpuBuffer::GpuBuffer(std::shared_ptr<const GpuDevice> device, std::size_t size,
                     VkBufferUsageFlags usage)
    : GpuBuffer() {  // a delegating constructor: what exists is destroyed if the next step fails
  device_ = std::move(device);
  size_ = size;
  const Vulkan& vk = device_->vk();
  const VkDevice d = device_->handle();
  auto info = vulkan_struct<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = size;
  info.usage = usage;
  expect(vk.vkCreateBuffer(d, &info, nullptr, &buffer_), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vk.vkGetBufferMemoryRequirements(d, buffer_, &needs);
  // Uncached memory is slow to read, and to write with a stride.
  memory_ = device_->allocate(
      needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
      VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
  expect(vk.vkBindBufferMemory(d, buffer_, memory_, 0), "vkBindBufferMemory");
  void* mapped = nullptr;
  expect(vk.vkMapMemory(d, memory_, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
  bytes_ = static_cast<std::byte*>(mapped);
  std::fill_n(bytes_, size, std::byte{0});
}

GpuBuffer::~GpuBuffer() {
  if (!device_) return;
  device_->vk().vkDestroyBuffer(device_->handle(), buffer_, nullptr);
  device_->vk().vkFreeMemory(device_->handle(), memory_, nullptr);
}

GpuBuffer::GpuBuffer(GpuBuffer&& other) noexcept { *this = std::move(other); }

GpuBuffer& GpuBuffer::operator=(GpuBuffer&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(memory_, other.memory_);
  std::swap(bytes_, other.bytes_);
  std::swap(size_, other.size_);
  return *this;
}

GpuImage::GpuImage(std::shared_ptr<const GpuDevice> device, Size size, VkFormat format,
                   VkImageUsageFlags usage)
    : GpuImage() {  // as above
  device_ = std::move(device);
  size_ = size;
  format_ = format;
  const Vulkan& vk = device_->vk();
  const VkDevice d = device_->handle();
  const auto most = device_->limits().maxImageDimension2D;
  if (static_cast<std::uint32_t>(std::max(size.width, size.height)) > most) {
    throw Error("a picture of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                " pixels: " + device_->name() + " has at most " + std::to_string(most) + " a side");
  }
  auto info = vulkan_struct<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height),
                 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage;
  expect(vk.vkCreateImage(d, &info, nullptr, &image_), "vkCreateImage");
  VkMemoryRequirements needs;
  vk.vkGetImageMemoryRequirements(d, image_, &needs);
  memory_ = device_->allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  expect(vk.vkBindImageMemory(d, image_, memory_, 0), "vkBindImageMemory");
  auto view = vulkan_struct<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  view.image = image_;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  expect(vk.vkCreateImageView(d, &view, nullptr, &view_), "vkCreateImageView");
}

GpuImage::~GpuImage() {
  if (!device_) return;
  const Vulkan& vk = device_->vk();
  vk.vkDestroyImageView(device_->handle(), view_, nullptr);
  vk.vkDestroyImage(device_->handle(), image_, nullptr);
  vk.vkFreeMemory(device_->handle(), memory_, nullptr);
}

GpuImage::GpuImage(GpuImage&& other) noexcept { *this = std::move(other); }

GpuImage& GpuImage::operator=(GpuImage&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(image_, other.image_);
  std::swap(memory_, other.memory_);
  std::swap(view_, other.view_);
  std::swap(size_, other.size_);
  std::swap(format_, other.format_);
  return *this;
}

}  // namespace limpid
