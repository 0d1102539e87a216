#pragma once
#include <stdexcept>
#include <string>

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan_core.h>

/// @file
/// libvulkan, the loader of Vulkan's drivers: opened when first needed, never linked, because most
/// render machines have no device.

namespace limpid {

#define LIMPID_VULKAN_OF_INSTANCE(F)          \
  F(vkDestroyInstance)                        \
  F(vkEnumeratePhysicalDevices)               \
  F(vkEnumerateDeviceExtensionProperties)     \
  F(vkGetPhysicalDeviceProperties2)           \
  F(vkGetPhysicalDeviceQueueFamilyProperties) \
  F(vkGetPhysicalDeviceMemoryProperties)      \
  F(vkCreateDevice)                           \
  F(vkGetDeviceProcAddr)

#define LIMPID_VULKAN_OF_DEVICE(F) \
  F(vkDestroyDevice)               \
  F(vkGetDeviceQueue)              \
  F(vkQueueSubmit)                 \
  F(vkAllocateMemory)              \
  F(vkFreeMemory)                  \
  F(vkMapMemory)                   \
  F(vkCreateBuffer)                \
  F(vkDestroyBuffer)               \
  F(vkGetBufferMemoryRequirements) \
  F(vkBindBufferMemory)            \
  F(vkCreateImage)                 \
  F(vkDestroyImage)                \
  F(vkGetImageMemoryRequirements)  \
  F(vkBindImageMemory)             \
  F(vkCreateImageView)             \
  F(vkDestroyImageView)            \
  F(vkCreateSampler)               \
  F(vkDestroySampler)              \
  F(vkCreateShaderModule)          \
  F(vkDestroyShaderModule)         \
  F(vkCreateDescriptorSetLayout)   \
  F(vkDestroyDescriptorSetLayout)  \
  F(vkCreatePipelineLayout)        \
  F(vkDestroyPipelineLayout)       \
  F(vkCreatePipelineCache)         \
  F(vkDestroyPipelineCache)        \
  F(vkGetPipelineCacheData)        \
  F(vkCreateComputePipelines)      \
  F(vkDestroyPipeline)             \
  F(vkCreateDescriptorPool)        \
  F(vkDestroyDescriptorPool)       \
  F(vkAllocateDescriptorSets)      \
  F(vkUpdateDescriptorSets)        \
  F(vkCreateCommandPool)           \
  F(vkDestroyCommandPool)          \
  F(vkAllocateCommandBuffers)      \
  F(vkBeginCommandBuffer)          \
  F(vkEndCommandBuffer)            \
  F(vkCmdPipelineBarrier)          \
  F(vkCmdCopyBufferToImage)        \
  F(vkCmdCopyImageToBuffer)        \
  F(vkCmdCopyImage)                \
  F(vkCmdBindPipeline)             \
  F(vkCmdBindDescriptorSets)       \
  F(vkCmdDispatch)                 \
  F(vkCreateFence)                 \
  F(vkDestroyFence)                \
  F(vkWaitForFences)               \
  F(vkResetFences)

/// The Vulkan functions that limpid calls, by name.
struct Vulkan {
#define LIMPID_VULKAN(name) PFN_##name name = nullptr;
  LIMPID_VULKAN_OF_INSTANCE(LIMPID_VULKAN)
  LIMPID_VULKAN_OF_DEVICE(LIMPID_VULKAN)
#undef LIMPID_VULKAN

  /// Loads the functions of an instance. Throws Error if one is missing.
  void load_instance(PFN_vkGetInstanceProcAddr get, VkInstance instance);
  /// Loads the functions of a device of it.
  void load_device(VkDevice device);
};

/// The entry of libvulkan.so.1. Throws Error if it cannot be opened.
PFN_vkGetInstanceProcAddr vulkan_loader();

/// Throws Error unless a call has succeeded: "vkCreateImage: no device memory is left".
void expect(VkResult result, const std::string& call);

/// A struct of Vulkan, zero except for its type.
template <class T>
T vulkan_struct(VkStructureType type) {
  T made{};
  made.sType = type;
  return made;
}

}  // namespace limpid
