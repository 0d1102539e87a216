#pragma once
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "limpid/job/shader.h"
#include "limpid/shade/shader_text.h"

/// A host of a shader: as small a Vulkan program as can be, that runs a compute shader over one
/// frame and waits. It knows the shader by ShaderText alone.

namespace limpid::test {

class VulkanHost {
 public:
  /// The first device; none where there is no driver. `layers`: with the validation layer, whose
  /// messages are messages().
  static std::optional<std::string> device_name() {
    try {
      return VulkanHost().name_;
    } catch (const std::runtime_error&) {
      return {};
    }
  }

  VulkanHost() {
    const VkApplicationInfo application{
        VK_STRUCTURE_TYPE_APPLICATION_INFO, nullptr, "limpid", 0, "limpid", 0, VK_API_VERSION_1_1};
    std::vector<const char*> layers, extensions;
    if (has_layer("VK_LAYER_KHRONOS_validation")) {
      layers.push_back("VK_LAYER_KHRONOS_validation");
      extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
      validates_ = true;
    }
    auto messenger = of_type<VkDebugUtilsMessengerCreateInfoEXT>(
        VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT |
                                VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = &VulkanHost::tell;
    messenger.pUserData = this;
    auto info = of_type<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &application;
    info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    if (validates_) info.pNext = &messenger;
    expect(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");
    if (validates_) {
      const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
          vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
      expect(create(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
    }
    std::uint32_t count = 1;
    VkPhysicalDevice device = VK_NULL_HANDLE;
    vkEnumeratePhysicalDevices(instance_, &count, &device);
    if (count == 0 || device == VK_NULL_HANDLE) throw std::runtime_error("no Vulkan device");
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    vkGetPhysicalDeviceMemoryProperties(device, &memory_);
    name_ = properties.deviceName;
    period_ = properties.limits.timestampPeriod;
    const float priority = 1;
    auto queue = of_type<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    auto device_info = of_type<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    device_info.queueCreateInfoCount = 1;
    device_info.pQueueCreateInfos = &queue;
    expect(vkCreateDevice(device, &device_info, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, 0, 0, &queue_);
    auto pool = of_type<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    expect(vkCreateCommandPool(device_, &pool, nullptr, &commands_), "vkCreateCommandPool");
  }
  ~VulkanHost() {
    if (device_) {
      vkDestroyCommandPool(device_, commands_, nullptr);
      vkDestroyDevice(device_, nullptr);
    }
    if (messenger_) {
      reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(
          instance_, "vkDestroyDebugUtilsMessengerEXT"))(instance_, messenger_, nullptr);
    }
    vkDestroyInstance(instance_, nullptr);
  }
  VulkanHost(const VulkanHost&) = delete;
  VulkanHost& operator=(const VulkanHost&) = delete;

  const std::string& name() const { return name_; }
  bool validates() const { return validates_; }
  const std::vector<std::string>& messages() const { return messages_; }

  /// Of each output four floats a pixel of shader.work(), row after row. `milliseconds`: how long
  /// the shader itself took, the least of `times` runs.
  std::vector<std::vector<float>> run(const ShaderText& shader, const Frame& frame, int times = 1,
                                      double* milliseconds = nullptr) {
    Run run(*this, shader, frame);
    return run.pictures(times, milliseconds);
  }

 private:
  template <class T>
  static T of_type(VkStructureType type) {
    T made{};
    made.sType = type;
    return made;
  }
  static void expect(VkResult result, const char* what) {
    if (result != VK_SUCCESS) {
      throw std::runtime_error(std::string(what) + ": " + std::to_string(result));
    }
  }
  static bool has_layer(const char* name) {
    std::uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    for (const VkLayerProperties& layer : layers) {
      if (std::strcmp(layer.layerName, name) == 0) return true;
    }
    return false;
  }
  static VKAPI_ATTR VkBool32 VKAPI_CALL tell(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                             VkDebugUtilsMessageTypeFlagsEXT,
                                             const VkDebugUtilsMessengerCallbackDataEXT* data,
                                             void* self) {
    static_cast<VulkanHost*>(self)->messages_.emplace_back(data->pMessage);
    return VK_FALSE;
  }

  struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr;
  };
  struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    int width, height;
  };

  VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags) {
    for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
      const bool fits = (needs.memoryTypeBits >> i & 1) != 0;
      if (!fits || (memory_.memoryTypes[i].propertyFlags & flags) != flags) continue;
      VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, i};
      VkDeviceMemory memory;
      expect(vkAllocateMemory(device_, &info, nullptr, &memory), "vkAllocateMemory");
      return memory;
    }
    throw std::runtime_error("no such memory");
  }
  Buffer buffer(std::size_t size, VkBufferUsageFlags usage) {
    Buffer made;
    auto info = of_type<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = size;
    info.usage = usage;
    expect(vkCreateBuffer(device_, &info, nullptr, &made.buffer), "vkCreateBuffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device_, made.buffer, &needs);
    made.memory =
        allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    vkBindBufferMemory(device_, made.buffer, made.memory, 0);
    expect(vkMapMemory(device_, made.memory, 0, VK_WHOLE_SIZE, 0, &made.mapped), "vkMapMemory");
    return made;
  }
  Image image(int width, int height, VkFormat format, VkImageUsageFlags usage) {
    Image made{};
    made.width = width, made.height = height;
    auto info = of_type<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = usage;
    expect(vkCreateImage(device_, &info, nullptr, &made.image), "vkCreateImage");
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device_, made.image, &needs);
    made.memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    vkBindImageMemory(device_, made.image, made.memory, 0);
    auto view = of_type<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    view.image = made.image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    expect(vkCreateImageView(device_, &view, nullptr, &made.view), "vkCreateImageView");
    return made;
  }

  /// Everything of one frame.
  class Run {
   public:
    Run(VulkanHost& host, const ShaderText& shader, const Frame& frame)
        : h_(host), shader_(shader) {
      block_ = h_.buffer(shader.block().size(), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
      std::memcpy(block_.mapped, shader.block().data(), shader.block().size());
      for (const ShaderTexture& texture : shader.textures()) add_texture(texture, frame);
      for (std::size_t i = 0; i < shader.outputs().size(); ++i) {
        outputs_.push_back(h_.image(shader.work().width(), shader.work().height(),
                                    VK_FORMAT_R32G32B32A32_SFLOAT,
                                    VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT));
        read_.push_back(h_.buffer(16 * static_cast<std::size_t>(shader.work().area()),
                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT));
      }
      auto sampler = of_type<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
      expect(vkCreateSampler(h_.device_, &sampler, nullptr, &sampler_), "vkCreateSampler");
      auto queries = of_type<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
      queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
      queries.queryCount = 2;
      expect(vkCreateQueryPool(h_.device_, &queries, nullptr, &queries_), "vkCreateQueryPool");
      make_descriptors();
      make_pipeline();
    }
    ~Run() {
      const VkDevice d = h_.device_;
      vkDestroyPipeline(d, pipeline_, nullptr);
      vkDestroyShaderModule(d, module_, nullptr);
      vkDestroyPipelineLayout(d, layout_, nullptr);
      vkDestroyDescriptorPool(d, pool_, nullptr);
      vkDestroyDescriptorSetLayout(d, set_layout_, nullptr);
      vkDestroyQueryPool(d, queries_, nullptr);
      vkDestroySampler(d, sampler_, nullptr);
      for (const std::vector<Image>* images : {&inputs_, &outputs_}) {
        for (const Image& i : *images) {
          vkDestroyImageView(d, i.view, nullptr);
          vkDestroyImage(d, i.image, nullptr);
          vkFreeMemory(d, i.memory, nullptr);
        }
      }
      staging_.push_back(block_);
      for (const std::vector<Buffer>* buffers : {&staging_, &read_}) {
        for (const Buffer& b : *buffers) {
          vkDestroyBuffer(d, b.buffer, nullptr);
          vkFreeMemory(d, b.memory, nullptr);
        }
      }
    }

    std::vector<std::vector<float>> pictures(int times, double* milliseconds) {
      submit([&](VkCommandBuffer c) {
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
          turn(c, inputs_[i], VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
          const VkBufferImageCopy copy = whole(inputs_[i]);
          vkCmdCopyBufferToImage(c, staging_[i].buffer, inputs_[i].image,
                                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
          turn(c, inputs_[i], VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        }
        for (const Image& out : outputs_) {
          turn(c, out, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
        }
      });
      double least = HUGE_VAL;
      for (int i = 0; i < times; ++i) {
        submit([&](VkCommandBuffer c) {
          vkCmdResetQueryPool(c, queries_, 0, 2);
          vkCmdBindPipeline(c, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
          vkCmdBindDescriptorSets(c, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0,
                                  nullptr);
          vkCmdWriteTimestamp(c, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, queries_, 0);
          vkCmdDispatch(c, static_cast<std::uint32_t>((shader_.work().width() + 15) / 16),
                        static_cast<std::uint32_t>((shader_.work().height() + 7) / 8), 1);
          vkCmdWriteTimestamp(c, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries_, 1);
        });
        std::uint64_t stamps[2] = {};
        vkGetQueryPoolResults(h_.device_, queries_, 0, 2, sizeof stamps, stamps, 8,
                              VK_QUERY_RESULT_64_BIT);
        least = std::min(least, 1e-6 * h_.period_ * static_cast<double>(stamps[1] - stamps[0]));
      }
      if (milliseconds) *milliseconds = least;
      submit([&](VkCommandBuffer c) {
        for (std::size_t i = 0; i < outputs_.size(); ++i) {
          turn(c, outputs_[i], VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
          const VkBufferImageCopy copy = whole(outputs_[i]);
          vkCmdCopyImageToBuffer(c, outputs_[i].image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                 read_[i].buffer, 1, &copy);
        }
      });
      std::vector<std::vector<float>> all;
      for (const Buffer& b : read_) {
        const auto* from = static_cast<const float*>(b.mapped);
        all.emplace_back(from, from + 4 * shader_.work().area());
      }
      return all;
    }

   private:
    void add_texture(const ShaderTexture& texture, const Frame& frame) {
      const VkFormat format =
          texture.channels == 1 ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
      const int channels = texture.channels == 1 ? 1 : 4;
      const auto pixels = static_cast<std::size_t>(texture.width) * texture.height;
      inputs_.push_back(h_.image(texture.width, texture.height, format,
                                 VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT));
      staging_.push_back(h_.buffer(4 * channels * pixels, VK_BUFFER_USAGE_TRANSFER_SRC_BIT));
      auto* to = static_cast<float*>(staging_.back().mapped);
      std::memset(to, 0, 4 * channels * pixels);
      for (int k = 0; k < texture.channels; ++k) {
        if (texture.source != ShaderTexture::Source::kPlanes) {
          for (std::size_t i = 0; i < pixels; ++i) {
            to[channels * i + k] = texture.texels[texture.channels * i + k];
          }
          continue;
        }
        const View<const float>& v = frame.plane(plane_after(role_named(texture.role).first, k));
        for (int y = 0; y < texture.height; ++y) {
          for (int x = 0; x < texture.width; ++x) {
            const std::size_t at = static_cast<std::size_t>(y) * texture.width + x;
            to[channels * at + k] = v.at(v.window.x0 + x, v.window.y0 + y);
          }
        }
      }
    }

    void make_descriptors() {
      std::vector<VkDescriptorSetLayoutBinding> bindings;
      const auto declare = [&](int binding, VkDescriptorType type) {
        bindings.push_back(
            {static_cast<std::uint32_t>(binding), type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
      };
      declare(shader_.block_binding(), VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
      for (const ShaderTexture& t : shader_.textures()) {
        declare(t.binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
      }
      for (const ShaderOutput& o : shader_.outputs()) {
        declare(o.binding, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
      }
      auto layout = of_type<VkDescriptorSetLayoutCreateInfo>(
          VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
      layout.bindingCount = static_cast<std::uint32_t>(bindings.size());
      layout.pBindings = bindings.data();
      expect(vkCreateDescriptorSetLayout(h_.device_, &layout, nullptr, &set_layout_),
             "vkCreateDescriptorSetLayout");
      const VkDescriptorPoolSize sizes[] = {
          {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
           static_cast<std::uint32_t>(inputs_.size()) + 1},
          {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, static_cast<std::uint32_t>(outputs_.size())}};
      auto pool =
          of_type<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
      pool.maxSets = 1;
      pool.poolSizeCount = 3;
      pool.pPoolSizes = sizes;
      expect(vkCreateDescriptorPool(h_.device_, &pool, nullptr, &pool_), "vkCreateDescriptorPool");
      VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr,
                                           pool_, 1, &set_layout_};
      expect(vkAllocateDescriptorSets(h_.device_, &allocate, &set_), "vkAllocateDescriptorSets");
      const VkDescriptorBufferInfo block{block_.buffer, 0, VK_WHOLE_SIZE};
      write(shader_.block_binding(), VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, &block, nullptr);
      for (std::size_t i = 0; i < inputs_.size(); ++i) {
        const VkDescriptorImageInfo image{sampler_, inputs_[i].view,
                                          VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        write(shader_.textures()[i].binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, nullptr,
              &image);
      }
      for (std::size_t i = 0; i < outputs_.size(); ++i) {
        const VkDescriptorImageInfo image{VK_NULL_HANDLE, outputs_[i].view,
                                          VK_IMAGE_LAYOUT_GENERAL};
        write(shader_.outputs()[i].binding, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, nullptr, &image);
      }
    }
    void write(int binding, VkDescriptorType type, const VkDescriptorBufferInfo* buffer,
               const VkDescriptorImageInfo* image) {
      auto set = of_type<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
      set.dstSet = set_;
      set.dstBinding = static_cast<std::uint32_t>(binding);
      set.descriptorCount = 1;
      set.descriptorType = type;
      set.pBufferInfo = buffer;
      set.pImageInfo = image;
      vkUpdateDescriptorSets(h_.device_, 1, &set, 0, nullptr);
    }

    void make_pipeline() {
      auto layout =
          of_type<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
      layout.setLayoutCount = 1;
      layout.pSetLayouts = &set_layout_;
      expect(vkCreatePipelineLayout(h_.device_, &layout, nullptr, &layout_),
             "vkCreatePipelineLayout");
      const std::vector<std::uint32_t> spirv = spirv_of(shader_.text(), shader_.options().stage);
      auto module = of_type<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
      module.codeSize = 4 * spirv.size();
      module.pCode = spirv.data();
      expect(vkCreateShaderModule(h_.device_, &module, nullptr, &module_), "vkCreateShaderModule");
      auto pipeline =
          of_type<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
      pipeline.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
      pipeline.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
      pipeline.stage.module = module_;
      pipeline.stage.pName = "main";
      pipeline.layout = layout_;
      expect(
          vkCreateComputePipelines(h_.device_, VK_NULL_HANDLE, 1, &pipeline, nullptr, &pipeline_),
          "vkCreateComputePipelines");
    }

    static VkBufferImageCopy whole(const Image& image) {
      VkBufferImageCopy copy{};
      copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
      copy.imageExtent = {static_cast<std::uint32_t>(image.width),
                          static_cast<std::uint32_t>(image.height), 1};
      return copy;
    }
    static void turn(VkCommandBuffer c, const Image& image, VkImageLayout from, VkImageLayout to) {
      auto barrier = of_type<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
      barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
      barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
      barrier.oldLayout = from;
      barrier.newLayout = to;
      barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
      barrier.image = image.image;
      barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
      vkCmdPipelineBarrier(c, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                           VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1,
                           &barrier);
    }
    template <class Fn>
    void submit(Fn&& fn) {
      VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr,
                                           h_.commands_, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
      VkCommandBuffer commands;
      expect(vkAllocateCommandBuffers(h_.device_, &allocate, &commands),
             "vkAllocateCommandBuffers");
      auto begin = of_type<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
      begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
      vkBeginCommandBuffer(commands, &begin);
      fn(commands);
      expect(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
      auto info = of_type<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
      info.commandBufferCount = 1;
      info.pCommandBuffers = &commands;
      expect(vkQueueSubmit(h_.queue_, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit");
      expect(vkQueueWaitIdle(h_.queue_), "vkQueueWaitIdle");
      vkFreeCommandBuffers(h_.device_, h_.commands_, 1, &commands);
    }

    VulkanHost& h_;
    const ShaderText& shader_;
    Buffer block_;
    std::vector<Image> inputs_, outputs_;
    std::vector<Buffer> staging_, read_;
    VkSampler sampler_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkShaderModule module_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
  };

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool commands_ = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory_{};
  std::string name_;
  float period_ = 1;
  bool validates_ = false;
  std::vector<std::string> messages_;
};

}  // namespace limpid::test
