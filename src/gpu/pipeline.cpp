#include "gpu/pipeline.h"

#include "limpid/core/error.h"
#include "limpid/gpu/shader_languages.h"

#include "gpu/device.h"
#include "gpu/pipeline_file.h"
#include "gpu/spirv.h"

namespace limpid {
namespace {

/// A VkPipelineCache during the creation of one pipeline.
class PipelineCache {
 public:
  PipelineCache(const GpuDevice& device, const std::vector<std::byte>& code) : device_(device) {
    auto info =
        vulkan_struct<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
    info.initialDataSize = code.size();
    info.pInitialData = code.data();
    expect(device.vk().vkCreatePipelineCache(device.handle(), &info, nullptr, &cache_),
           "vkCreatePipelineCache");
  }
  ~PipelineCache() { device_.vk().vkDestroyPipelineCache(device_.handle(), cache_, nullptr); }
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  VkPipelineCache handle() const { return cache_; }
  std::vector<std::byte> code() const {
    const auto get = device_.vk().vkGetPipelineCacheData;
    std::size_t size = 0;
    expect(get(device_.handle(), cache_, &size, nullptr), "vkGetPipelineCacheData");
    std::vector<std::byte> code(size);
    expect(get(device_.handle(), cache_, &size, code.data()), "vkGetPipelineCacheData");
    code.resize(size);
    return code;
  }

 private:
  const GpuDevice& device_;
  VkPipelineCache cache_ = VK_NULL_HANDLE;
};

/// A shader module, likewise.
class ShaderModule {
 public:
  ShaderModule(const GpuDevice& device, const std::vector<std::uint32_t>& spirv) : device_(device) {
    auto info =
        vulkan_struct<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = spirv.size() * sizeof(std::uint32_t);
    info.pCode = spirv.data();
    expect(device.vk().vkCreateShaderModule(device.handle(), &info, nullptr, &module_),
           "vkCreateShaderModule");
  }
  ~ShaderModule() { device_.vk().vkDestroyShaderModule(device_.handle(), module_, nullptr); }
  ShaderModule(const ShaderModule&) = delete;
  ShaderModule& operator=(const ShaderModule&) = delete;

  VkShaderModule handle() const { return module_; }

 private:
  const GpuDevice& device_;
  VkShaderModule module_ = VK_NULL_HANDLE;
};

void expect_at_most(std::size_t wanted, std::uint32_t most, const char* what,
                    const GpuDevice& device) {
  if (wanted <= most) return;
  throw Error("the shader has " + std::to_string(wanted) + " " + what + ": " + device.name() +
              " has at most " + std::to_string(most));
}

}  // namespace

GpuPipeline::GpuPipeline(const GpuDevice& device, const ShaderProgram& program,
                         const std::filesystem::path& cache, const std::string& uuid)
    : device_(device) {
  const VkPhysicalDeviceLimits& limits = device.limits();
  expect_at_most(program.textures.size(), limits.maxPerStageDescriptorSampledImages, "textures",
                 device);
  expect_at_most(program.outputs.size(), limits.maxPerStageDescriptorStorageImages,
                 "pictures to write", device);
  expect_at_most(program.block.size(), limits.maxUniformBufferRange, "bytes of numbers", device);
  std::filesystem::path path;
  std::optional<CompiledPipeline> compiled;
  if (!cache.empty()) {
    path = cache / (program.id + "-" + uuid + ".pipeline");
    compiled = read_pipeline(path);
  }
  const bool found = compiled.has_value();
  if (!found) {
    compiled = {keeping_infinity(spirv_of(program.text, ShaderOptions::Stage::kCompute)), {}};
  }
  const PipelineCache kept(device, compiled->device_code);
  try {
    make_layout(program);
    make_pipeline(compiled->spirv, kept.handle());
  } catch (...) {
    destroy();
    throw;
  }
  if (found || path.empty()) return;
  compiled->device_code = kept.code();
  try {
    write_pipeline(path, *compiled);
  } catch (const Error&) {
    // Without the file, only the next start is slower.
  }
}

GpuPipeline::~GpuPipeline() { destroy(); }

void GpuPipeline::destroy() {
  const Vulkan& vk = device_.vk();
  const VkDevice d = device_.handle();
  vk.vkDestroyPipeline(d, pipeline_, nullptr);
  vk.vkDestroyPipelineLayout(d, layout_, nullptr);
  vk.vkDestroyDescriptorSetLayout(d, set_layout_, nullptr);
  vk.vkDestroySampler(d, sampler_, nullptr);
}

void GpuPipeline::make_layout(const ShaderProgram& program) {
  const Vulkan& vk = device_.vk();
  const VkDevice d = device_.handle();
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  const auto declare = [&](int binding, VkDescriptorType type) {
    bindings.push_back(
        {static_cast<std::uint32_t>(binding), type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
  };
  declare(program.block_binding, kBlockType);
  for (const ProgramTexture& texture : program.textures) declare(texture.binding, kTextureType);
  for (const ShaderOutput& output : program.outputs) declare(output.binding, kOutputType);
  auto set = vulkan_struct<VkDescriptorSetLayoutCreateInfo>(
      VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set.bindingCount = static_cast<std::uint32_t>(bindings.size());
  set.pBindings = bindings.data();
  expect(vk.vkCreateDescriptorSetLayout(d, &set, nullptr, &set_layout_),
         "vkCreateDescriptorSetLayout");
  auto layout =
      vulkan_struct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &set_layout_;
  expect(vk.vkCreatePipelineLayout(d, &layout, nullptr, &layout_), "vkCreatePipelineLayout");
  auto sampler = vulkan_struct<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
  sampler.addressModeU = sampler.addressModeV = sampler.addressModeW =
      VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  expect(vk.vkCreateSampler(d, &sampler, nullptr, &sampler_), "vkCreateSampler");
}

void GpuPipeline::make_pipeline(const std::vector<std::uint32_t>& spirv, VkPipelineCache cache) {
  const ShaderModule module(device_, spirv);
  auto info =
      vulkan_struct<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage = vulkan_struct<VkPipelineShaderStageCreateInfo>(
      VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module.handle();
  info.stage.pName = "main";
  info.layout = layout_;
  expect(
      device_.vk().vkCreateComputePipelines(device_.handle(), cache, 1, &info, nullptr, &pipeline_),
      "vkCreateComputePipelines");
}

}  // namespace limpid
