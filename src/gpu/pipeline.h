#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "gpu/vulkan.h"
#include "shade/program.h"

namespace limpid {

class GpuDevice;

/// The kinds of resources bound to a program.
inline constexpr VkDescriptorType kBlockType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
inline constexpr VkDescriptorType kTextureType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
inline constexpr VkDescriptorType kOutputType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;

/// A program, compiled for a device: of Stage::kCompute, in descriptor set 0.
class GpuPipeline {
 public:
  /// With a folder `cache`, the compiled program is read from a file there, or stored there; if the
  /// folder cannot be written, the next start takes as long as this one. `uuid`: that of the
  /// driver, whose format the file has. Throws Error for a program with more bindings than the
  /// device supports, and as spirv_of() does.
  GpuPipeline(const GpuDevice& device, const ShaderProgram& program,
              const std::filesystem::path& cache, const std::string& uuid);
  ~GpuPipeline();
  GpuPipeline(const GpuPipeline&) = delete;
  GpuPipeline& operator=(const GpuPipeline&) = delete;

  VkPipeline handle() const { return pipeline_; }
  VkPipelineLayout layout() const { return layout_; }
  VkDescriptorSetLayout set_layout() const { return set_layout_; }
  VkSampler sampler() const { return sampler_; }  ///< for textures, which are fetched by texel

 private:
  void destroy();
  void make_layout(const ShaderProgram& program);
  void make_pipeline(const std::vector<std::uint32_t>& spirv, VkPipelineCache cache);

  const GpuDevice& device_;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkSampler sampler_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace limpid
