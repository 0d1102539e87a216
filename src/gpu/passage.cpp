#include "gpu/passage.h"

#include <atomic>
#include <vector>

#include "complete/rows.h"
#include "enter/half.h"

namespace limpid {
namespace {

VkBufferImageCopy whole(const GpuImage& image) {
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = {static_cast<std::uint32_t>(image.size().width),
                      static_cast<std::uint32_t>(image.size().height), 1};
  return copy;
}

std::size_t bytes_of(Passage::Storage storage) {
  constexpr std::size_t kBytes[] = {1, 2, 4, 4};
  return kBytes[static_cast<int>(storage)];
}

VkFormat format_of(Passage::Storage storage, int channels) {
  constexpr VkFormat kFormats[][2] = {{VK_FORMAT_R8_UNORM, VK_FORMAT_R8G8B8A8_UNORM},
                                      {VK_FORMAT_R16_SFLOAT, VK_FORMAT_R16G16B16A16_SFLOAT},
                                      {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT},
                                      {VK_FORMAT_R32_UINT, VK_FORMAT_UNDEFINED}};
  return kFormats[static_cast<int>(storage)][channels == 1 ? 0 : 1];
}

/// Devices round when they convert bytes to floats: so not for planes, whose dry pixels must stay
/// bit for bit.
Passage::Storage narrowest(const ProgramTexture& texture) {
  if (texture.pack) return Passage::Storage::kBits;
  switch (texture.source) {
    case ShaderTexture::Source::kPlanes:
      return Passage::Storage::kHalf;
    case ShaderTexture::Source::kRows:
      return Passage::Storage::kFloat;
    case ShaderTexture::Source::kMade:
      return texture.role.empty() ? Passage::Storage::kByte : Passage::Storage::kHalf;
  }
  return Passage::Storage::kFloat;
}

/// Multiples of 1/255. Returns whether all values are.
bool as_bytes(const std::vector<float>& floats, std::byte* bytes) {
  for (std::size_t i = 0; i < floats.size(); ++i) {
    const float scaled = 255 * floats[i];
    if (!(scaled >= 0 && scaled <= 255)) return false;
    const int byte = static_cast<int>(scaled + 0.5f);
    if (static_cast<float>(byte) / 255 != floats[i]) return false;
    bytes[i] = static_cast<std::byte>(byte);
  }
  return true;
}

}  // namespace

void Passage::fit(const std::shared_ptr<GpuDevice>& device, Size size, int channels, Storage chosen,
                  VkImageUsageFlags image_use, VkBufferUsageFlags buffer_use) {
  const int stored = channels == 1 ? 1 : 4;
  if (image.size() == size && step == stored && storage == chosen) return;
  *this = {};  // freed before new ones are made
  image = GpuImage(device, size, format_of(chosen, stored), image_use);
  const std::size_t texels = static_cast<std::size_t>(size.width) * size.height;
  buffer = GpuBuffer(device, texels * stored * bytes_of(chosen), buffer_use);
  step = stored;
  storage = chosen;
}

void Passage::fit_output(const std::shared_ptr<GpuDevice>& device, Size size) {
  fit(device, size, 4, Storage::kFloat,
      VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
      VK_BUFFER_USAGE_TRANSFER_DST_BIT);
}

void Passage::fill(const std::shared_ptr<GpuDevice>& device, const ProgramTexture& texture,
                   Executor& executor) {
  static const HalfTarget& halves = half_target("");
  const Size size{texture.width, texture.height};
  const bool known = image.size() == size && step == (texture.channels == 1 ? 1 : 4) &&
                     (storage == Storage::kBits) == static_cast<bool>(texture.pack);
  Storage tried = known ? storage : narrowest(texture);
  for (;; tried = static_cast<Storage>(static_cast<int>(tried) + 1)) {
    fit(device, size, texture.channels, tried,
        VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    const std::ptrdiff_t row = std::ptrdiff_t{step} * texture.width;
    const std::ptrdiff_t row_bytes = row * static_cast<std::ptrdiff_t>(bytes_of(tried));
    std::atomic<bool> exact = true;
    each_row(executor, {0, 0, texture.width, texture.height}, [&](int y) {
      std::byte* to = buffer.bytes() + row_bytes * y;
      if (tried == Storage::kBits) {
        texture.pack(y, reinterpret_cast<std::uint32_t*>(to));
      } else if (tried == Storage::kFloat) {
        texture.fill(y, reinterpret_cast<float*>(to), step);
      } else if (exact) {
        thread_local std::vector<float> floats;
        floats.assign(static_cast<std::size_t>(row), 0.0f);  // unused channels, too
        texture.fill(y, floats.data(), step);
        const bool fits = tried == Storage::kByte
                              ? as_bytes(floats, to)
                              : halves.narrow_exactly(floats.data(), to, static_cast<int>(row));
        if (!fits) exact = false;
      }
    });
    if (exact) return;
  }
}

void Passage::upload(const Vulkan& vk, VkCommandBuffer commands) const {
  turn(vk, commands, image.handle(), kUnused, kCopiedTo);
  const VkBufferImageCopy copy = whole(image);
  vk.vkCmdCopyBufferToImage(commands, buffer.handle(), image.handle(), kCopiedTo.layout, 1, &copy);
  turn(vk, commands, image.handle(), kCopiedTo, kRead);
}

void Passage::download(const Vulkan& vk, VkCommandBuffer commands) const {
  turn(vk, commands, image.handle(), kWritten, kCopiedFrom);
  const VkBufferImageCopy copy = whole(image);
  vk.vkCmdCopyImageToBuffer(commands, image.handle(), kCopiedFrom.layout, buffer.handle(), 1,
                            &copy);
  turn(vk, commands, image.handle(), kCopiedFrom, kWritten);
}

}  // namespace limpid
