#pragma once
#include <memory>

#include "gpu/device.h"
#include "gpu/pipeline.h"

namespace limpid {

/// The resources bound while a pipeline runs: a descriptor set.
class GpuBindings {
 public:
  GpuBindings() = default;
  GpuBindings(std::shared_ptr<const GpuDevice> device, std::shared_ptr<const GpuPipeline> pipeline,
              const ShaderProgram& program);
  ~GpuBindings();
  GpuBindings(GpuBindings&& other) noexcept;
  GpuBindings& operator=(GpuBindings&& other) noexcept;

  const GpuPipeline* pipeline() const { return pipeline_.get(); }
  void bind_block(int binding, VkBuffer buffer) const;
  /// Fetched by texel, unless a sampler is given.
  void bind_texture(int binding, VkImageView view, VkImageLayout layout,
                    VkSampler sampler = VK_NULL_HANDLE) const;
  void bind_output(int binding, VkImageView view) const;  ///< in layout general
  /// One thread per pixel.
  void dispatch(VkCommandBuffer commands, const ShaderProgram& program) const;

 private:
  void write(int binding, VkDescriptorType type, const VkDescriptorBufferInfo* buffer,
             const VkDescriptorImageInfo* image) const;

  std::shared_ptr<const GpuDevice> device_;
  std::shared_ptr<const GpuPipeline> pipeline_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace limpid
