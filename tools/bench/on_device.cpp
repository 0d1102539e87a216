#include "on_device.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "rows.h"

namespace limpid::bench {
namespace {

VkSampler linear_sampler(const GpuDevice& device, VkSamplerAddressMode mode) {
  auto info = vulkan_struct<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
  info.magFilter = info.minFilter = VK_FILTER_LINEAR;
  info.addressModeU = info.addressModeV = info.addressModeW = mode;
  VkSampler sampler = VK_NULL_HANDLE;
  expect(device.vk().vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
  return sampler;
}

}  // namespace

OnDevice::OnDevice(std::shared_ptr<GpuDevice> device, const ShaderProgram& program,
                   Executor& executor, bool filter, const std::string& tiled)
    : device_(std::move(device)),
      program_(program),
      commands_(device_),
      bindings_(device_, device_->pipeline(program, {}), program),
      block_(device_, program.block.size(), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT) {
  if (filter) {
    clamped_ = linear_sampler(*device_, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
    tiled_ = linear_sampler(*device_, VK_SAMPLER_ADDRESS_MODE_REPEAT);
  }
  std::memcpy(block_.bytes(), program.block.data(), program.block.size());
  bindings_.bind_block(program.block_binding, block_.handle());
  for (const ProgramTexture& texture : program.textures) {
    Passage& input = inputs_.emplace_back();
    input.fill(device_, texture, executor);
    bindings_.bind_texture(texture.binding, input.image.view(), kRead.layout,
                           texture.name == tiled ? tiled_ : clamped_);
  }
  for (const ShaderOutput& output : program.outputs) {
    Passage& picture = outputs_.emplace_back();
    picture.fit_output(device_, program.work.size());
    bindings_.bind_output(output.binding, picture.image.view());
  }
  commands_.run([&](VkCommandBuffer c) {
    upload(c);
    for (const Passage& output : outputs_) {
      turn(device_->vk(), c, output.image.handle(), kUnused, kWritten);
    }
    bindings_.dispatch(c, program_);
  });
}

OnDevice::~OnDevice() {
  for (const VkSampler sampler : {clamped_, tiled_}) {
    device_->vk().vkDestroySampler(device_->handle(), sampler, nullptr);
  }
}

void OnDevice::upload(VkCommandBuffer c) const {
  for (const Passage& input : inputs_) input.upload(device_->vk(), c);
}

void OnDevice::download(VkCommandBuffer c) const {
  for (const Passage& output : outputs_) output.download(device_->vk(), c);
}

double OnDevice::seconds_of_run(const std::function<void(VkCommandBuffer)>& write) {
  return seconds_of([&] { commands_.run(write); });
}

void OnDevice::time_shader() {
  const auto run = [&](int count) {
    return seconds_of_run([&](VkCommandBuffer c) {
      for (int i = 0; i < count; ++i) {
        turn(device_->vk(), c, outputs_[0].image.handle(), kWritten, kWritten);
        bindings_.dispatch(c, program_);
      }
    });
  };
  many_ = std::min(many_, run(1 + kTimes));
  one_ = std::min(one_, run(1));
}

double OnDevice::bus_seconds() {
  return seconds_of_run([&](VkCommandBuffer c) {
    upload(c);
    download(c);
  });
}

void OnDevice::run_frame() {
  commands_.run([&](VkCommandBuffer c) {
    upload(c);
    turn(device_->vk(), c, outputs_[0].image.handle(), kWritten, kWritten);
    bindings_.dispatch(c, program_);
    download(c);
  });
}

std::size_t OnDevice::bytes() const {
  std::size_t sum = 0;
  for (const Passage& input : inputs_) sum += input.buffer.size();
  for (const Passage& output : outputs_) sum += output.buffer.size();
  return sum;
}

std::vector<float> OnDevice::picture() {
  commands_.run([&](VkCommandBuffer c) { download(c); });
  const GpuBuffer& buffer = outputs_[0].buffer;
  return {buffer.floats(), buffer.floats() + buffer.size() / sizeof(float)};
}

}  // namespace limpid::bench
