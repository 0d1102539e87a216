#include "gpu/bindings.h"

#include <iterator>
#include <utility>

namespace limpid {

GpuBindings::GpuBindings(std::shared_ptr<const GpuDevice> device,
                         std::shared_ptr<const GpuPipeline> pipeline, const ShaderProgram& program)
    : GpuBindings() {  // a delegating constructor: the pool is destroyed if the set cannot be made
  device_ = std::move(device);
  pipeline_ = std::move(pipeline);
  const Vulkan& vk = device_->vk();
  const VkDescriptorPoolSize sizes[] = {
      {kBlockType, 1},
      {kTextureType, static_cast<std::uint32_t>(program.textures.size())},
      {kOutputType, static_cast<std::uint32_t>(program.outputs.size())}};
  auto pool =
      vulkan_struct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool.maxSets = 1;
  pool.poolSizeCount = std::size(sizes);
  pool.pPoolSizes = sizes;
  expect(vk.vkCreateDescriptorPool(device_->handle(), &pool, nullptr, &pool_),
         "vkCreateDescriptorPool");
  auto set =
      vulkan_struct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  const VkDescriptorSetLayout layout = pipeline_->set_layout();
  set.descriptorPool = pool_;
  set.descriptorSetCount = 1;
  set.pSetLayouts = &layout;
  expect(vk.vkAllocateDescriptorSets(device_->handle(), &set, &set_), "vkAllocateDescriptorSets");
}

GpuBindings::~GpuBindings() {
  if (device_) device_->vk().vkDestroyDescriptorPool(device_->handle(), pool_, nullptr);
}

GpuBindings::GpuBindings(GpuBindings&& other) noexcept { *this = std::move(other); }

GpuBindings& GpuBindings::operator=(GpuBindings&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(pipeline_, other.pipeline_);
  std::swap(pool_, other.pool_);
  std::swap(set_, other.set_);
  return *this;
}

void GpuBindings::bind_block(int binding, VkBuffer buffer) const {
  const VkDescriptorBufferInfo info{buffer, 0, VK_WHOLE_SIZE};
  write(binding, kBlockType, &info, nullptr);
}

void GpuBindings::bind_texture(int binding, VkImageView view, VkImageLayout layout,
                               VkSampler sampler) const {
  const VkDescriptorImageInfo info{sampler ? sampler : pipeline_->sampler(), view, layout};
  write(binding, kTextureType, nullptr, &info);
}

void GpuBindings::bind_output(int binding, VkImageView view) const {
  const VkDescriptorImageInfo info{VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_GENERAL};
  write(binding, kOutputType, nullptr, &info);
}

void GpuBindings::write(int binding, VkDescriptorType type, const VkDescriptorBufferInfo* buffer,
                        const VkDescriptorImageInfo* image) const {
  auto set = vulkan_struct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
  set.dstSet = set_;
  set.dstBinding = static_cast<std::uint32_t>(binding);
  set.descriptorCount = 1;
  set.descriptorType = type;
  set.pBufferInfo = buffer;
  set.pImageInfo = image;
  device_->vk().vkUpdateDescriptorSets(device_->handle(), 1, &set, 0, nullptr);
}

void GpuBindings::dispatch(VkCommandBuffer commands, const ShaderProgram& program) const {
  const Vulkan& vk = device_->vk();
  vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_->handle());
  vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_->layout(), 0, 1,
                             &set_, 0, nullptr);
  const auto groups = [](int pixels, int group) {
    return static_cast<std::uint32_t>((pixels + group - 1) / group);
  };
  const Size size = program.work.size();
  vk.vkCmdDispatch(commands, groups(size.width, program.group.width),
                   groups(size.height, program.group.height), 1);
}

}  // namespace limpid
