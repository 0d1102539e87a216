#include "gpu/vulkan.h"

#include <dlfcn.h>

#include "limpid/core/error.h"

namespace limpid {

void Vulkan::load_instance(PFN_vkGetInstanceProcAddr get, VkInstance instance) {
#define LIMPID_VULKAN(name)                                  \
  name = reinterpret_cast<PFN_##name>(get(instance, #name)); \
  if (!name) throw Error("Vulkan's loader has no function " #name);
  LIMPID_VULKAN_OF_INSTANCE(LIMPID_VULKAN)
#undef LIMPID_VULKAN
}

void Vulkan::load_device(VkDevice device) {
#define LIMPID_VULKAN(name)                                                \
  name = reinterpret_cast<PFN_##name>(vkGetDeviceProcAddr(device, #name)); \
  if (!name) throw Error("the device's driver has no function " #name);
  LIMPID_VULKAN_OF_DEVICE(LIMPID_VULKAN)
#undef LIMPID_VULKAN
}

PFN_vkGetInstanceProcAddr vulkan_loader() {
  static const auto get = [] {
    void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    return library ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(
                         dlsym(library, "vkGetInstanceProcAddr"))
                   : nullptr;
  }();
  if (!get) {
    throw Error(
        "libvulkan.so.1 not found: the GPU runner needs the Vulkan loader (libvulkan1 in Debian) "
        "and a driver");
  }
  return get;
}

void expect(VkResult result, const std::string& call) {
  switch (result) {
    case VK_SUCCESS:
      return;
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      throw std::bad_alloc();
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      throw Error(call + ": the device is out of memory");
    case VK_ERROR_DEVICE_LOST:
      throw Error(call + ": the device is lost, by a fault of its driver or because it was reset");
    default:
      throw Error(call + " failed with Vulkan's result " + std::to_string(result));
  }
}

}  // namespace limpid
