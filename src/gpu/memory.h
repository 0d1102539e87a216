#pragma once
#include <cstddef>
#include <memory>

#include "limpid/core/rect.h"

#include "gpu/device.h"

namespace limpid {

/// Memory that both the device and this program access.
class GpuBuffer {
 public:
  GpuBuffer() = default;
  GpuBuffer(std::shared_ptr<const GpuDevice> device, std::size_t size, VkBufferUsageFlags usage);
  ~GpuBuffer();
  GpuBuffer(GpuBuffer&& other) noexcept;
  GpuBuffer& operator=(GpuBuffer&& other) noexcept;

  VkBuffer handle() const { return buffer_; }
  std::byte* bytes() const { return bytes_; }
  float* floats() const { return reinterpret_cast<float*>(bytes_); }
  std::size_t size() const { return size_; }

 private:
  std::shared_ptr<const GpuDevice> device_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  std::byte* bytes_ = nullptr;
  std::size_t size_ = 0;
};

/// An image in device memory.
class GpuImage {
 public:
  GpuImage() = default;
  /// Throws Error for an image larger than the device supports.
  GpuImage(std::shared_ptr<const GpuDevice> device, Size size, VkFormat format,
           VkImageUsageFlags usage);
  ~GpuImage();
  GpuImage(GpuImage&& other) noexcept;
  GpuImage& operator=(GpuImage&& other) noexcept;

  VkImage handle() const { return image_; }
  VkImageView view() const { return view_; }
  Size size() const { return size_; }
  VkFormat format() const { return format_; }

 private:
  std::shared_ptr<const GpuDevice> device_;
  VkImage image_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkImageView view_ = VK_NULL_HANDLE;
  Size size_;
  VkFormat format_ = VK_FORMAT_UNDEFINED;
};

}  // namespace limpid
