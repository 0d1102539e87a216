#pragma once
#include <cstdint>
#include <functional>

#include <vulkan/vulkan.h>

// The objects that every engine has: an instance, a device with one queue, images and memory.

void expect(VkResult result, const char* call);

struct Device {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  std::uint32_t family = 0;  // the family of the queue, which computes and copies
  VkCommandPool pool = VK_NULL_HANDLE;

  Device();
  ~Device();
  VkDeviceMemory memory(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags) const;
};

// Memory that the program and the device share.
struct Buffer {
  const Device& owner;
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* bytes = nullptr;

  Buffer(const Device& device, VkDeviceSize size);
  ~Buffer();
};

struct Image {
  const Device& owner;
  VkFormat format;
  VkExtent3D extent;
  VkImage image = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;

  Image(const Device& device, VkFormat format, std::uint32_t width, std::uint32_t height);
  ~Image();
  void copy_from(VkCommandBuffer commands, const Buffer& buffer) const;  // to layout general
  void copy_to(VkCommandBuffer commands, const Buffer& buffer) const;    // from layout general
};
