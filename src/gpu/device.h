#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "limpid/core/rect.h"
#include "limpid/gpu/gpu_runner.h"

#include "gpu/vulkan.h"
#include "shade/program.h"

namespace limpid {

class GpuPipeline;

/// A device: the handles from which all its objects are made, and the pipelines that it keeps. Any
/// number of threads may use it at once.
class GpuDevice {
 public:
  /// A device that a host has opened; it stays the host's. Throws Error as open().
  GpuDevice(PFN_vkGetInstanceProcAddr get, VkInstance instance, VkPhysicalDevice physical,
            VkDevice device);
  ~GpuDevice();
  GpuDevice(const GpuDevice&) = delete;
  GpuDevice& operator=(const GpuDevice&) = delete;

  /// Opens a device; simultaneous users of the same device share it. `name` is a part of its name,
  /// in any case, or "" for the first of the fastest kind. Throws Error if there is no such device,
  /// or none with the features that shaders need: Vulkan 1.2, and infinity in floats.
  static std::shared_ptr<GpuDevice> open(const std::string& name);
  /// All devices that open() can open, the fastest kind first.
  static std::vector<GpuInfo> known();

  const Vulkan& vk() const { return vk_; }
  VkInstance instance() const { return instance_; }
  VkPhysicalDevice physical() const { return physical_; }
  VkDevice handle() const { return device_; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  /// Largest number of threads in a group (ShaderOptions::max_threads).
  int max_threads() const { return static_cast<int>(limits_.maxComputeWorkGroupInvocations); }
  /// "NVIDIA H100 80GB HBM3 (NVIDIA 580.159)": the device, and its driver.
  const std::string& name() const { return name_; }
  std::uint32_t family() const { return family_; }  ///< of its queues

  /// Runs commands and waits for their end. Queues are used in turn.
  void submit(VkCommandBuffer commands, VkFence fence);

  /// Allocates device memory, of the first kind that has all properties of `must` and, if possible,
  /// all of `may`. Throws Error.
  VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags must,
                          VkMemoryPropertyFlags may = 0) const;

  /// The pipeline of a program: made on the first request, or read from a file in the folder
  /// `cache`, if the name is not empty. A new pipeline is stored there, too.
  std::shared_ptr<const GpuPipeline> pipeline(const ShaderProgram& program,
                                              const std::filesystem::path& cache);

 private:
  GpuDevice() = default;
  void take(VkPhysicalDevice physical);

  Vulkan vk_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  bool own_ = false;
  VkPhysicalDeviceLimits limits_{};
  VkPhysicalDeviceMemoryProperties memory_{};
  std::string name_, uuid_;
  std::uint32_t family_ = 0;
  struct Queue {
    VkQueue handle = VK_NULL_HANDLE;
    std::mutex busy;
  };
  std::vector<std::unique_ptr<Queue>> queues_;
  std::size_t next_queue_ = 0;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const GpuPipeline>> pipelines_;
};

}  // namespace limpid
