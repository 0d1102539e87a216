#include "gpu/device.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "limpid/core/error.h"

#include "gpu/pipeline.h"

namespace limpid {
namespace {

constexpr std::uint32_t kVersion = VK_API_VERSION_1_2;
/// Enough for frames whose transfers and shaders overlap; more queues gain nothing.
constexpr std::uint32_t kMaxQueues = 4;

/// Properties of a device before it is opened.
struct Candidate {
  VkPhysicalDevice handle;
  VkPhysicalDeviceProperties properties;
  std::string driver, uuid;
  bool keeps_infinity = false;
  int family = -1;  ///< of compute queues, or -1
  std::uint32_t queues = 0;

  /// Discrete devices first, software last.
  int rank() const {
    switch (properties.deviceType) {
      case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 0;
      case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 1;
      case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
      default:
        return 3;
    }
  }
  std::string name() const { return properties.deviceName; }
  /// Why the device cannot be used, or "".
  std::string fault() const {
    if (properties.apiVersion < kVersion) return "supports only Vulkan before 1.2";
    if (family < 0) return "has no compute queue";
    if (!keeps_infinity) return "does not preserve infinity in 32-bit floats";
    return "";
  }
};

Candidate candidate_of(const Vulkan& vk, VkPhysicalDevice handle) {
  Candidate made{handle, {}, "", ""};
  auto controls = vulkan_struct<VkPhysicalDeviceFloatControlsProperties>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES);
  auto driver = vulkan_struct<VkPhysicalDeviceDriverProperties>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
  auto all =
      vulkan_struct<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
  all.pNext = &driver;
  driver.pNext = &controls;
  vk.vkGetPhysicalDeviceProperties2(handle, &all);
  made.properties = all.properties;
  made.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  made.keeps_infinity = controls.shaderSignedZeroInfNanPreserveFloat32 == VK_TRUE;
  for (const std::uint8_t byte : made.properties.pipelineCacheUUID) {
    constexpr char kDigits[] = "0123456789abcdef";
    made.uuid += {kDigits[byte >> 4], kDigits[byte & 15]};
  }
  std::uint32_t count = 0;
  vk.vkGetPhysicalDeviceQueueFamilyProperties(handle, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vk.vkGetPhysicalDeviceQueueFamilyProperties(handle, &count, families.data());
  for (std::uint32_t i = 0; i < count && made.family < 0; ++i) {
    if ((families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) continue;
    made.family = static_cast<int>(i);
    made.queues = std::min(families[i].queueCount, kMaxQueues);
  }
  return made;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// An own instance, and the devices visible through it.
struct Instance {
  VkInstance handle = VK_NULL_HANDLE;
  Vulkan vk;

  Instance() {
    const PFN_vkGetInstanceProcAddr get = vulkan_loader();
    const auto create =
        reinterpret_cast<PFN_vkCreateInstance>(get(VK_NULL_HANDLE, "vkCreateInstance"));
    if (!create) throw Error("Vulkan's loader has no function vkCreateInstance");
    auto application = vulkan_struct<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.pEngineName = "limpid";
    application.apiVersion = kVersion;
    auto info = vulkan_struct<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &application;
    const VkResult result = create(&info, nullptr, &handle);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) throw Error("no Vulkan driver is installed");
    expect(result, "vkCreateInstance");
    vk.load_instance(get, handle);
  }
  ~Instance() {
    if (handle) vk.vkDestroyInstance(handle, nullptr);
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  /// Fastest kinds first, otherwise in the loader's order.
  std::vector<Candidate> candidates() const {
    std::uint32_t count = 0;
    expect(vk.vkEnumeratePhysicalDevices(handle, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> handles(count);
    expect(vk.vkEnumeratePhysicalDevices(handle, &count, handles.data()),
           "vkEnumeratePhysicalDevices");
    std::vector<Candidate> list;
    for (const VkPhysicalDevice device : handles) list.push_back(candidate_of(vk, device));
    std::stable_sort(list.begin(), list.end(),
                     [](const Candidate& a, const Candidate& b) { return a.rank() < b.rank(); });
    return list;
  }
};

const Candidate& chosen(const std::vector<Candidate>& all, const std::string& name) {
  std::vector<std::string> faults;
  for (const Candidate& candidate : all) {
    if (lower(candidate.name()).find(lower(name)) == std::string::npos) continue;
    if (candidate.fault().empty()) return candidate;
    faults.push_back(candidate.name() + " " + candidate.fault());
  }
  if (!faults.empty()) throw Error("no GPU can be used: " + join(faults));
  if (all.empty()) throw Error("no GPU found: expected one with a driver for Vulkan 1.2");
  std::vector<std::string> known;
  for (const Candidate& candidate : all) known.push_back(candidate.name());
  throw Error("no GPU has '" + name + "' in its name: expected a part of one of " + join(known));
}

}  // namespace

GpuDevice::GpuDevice(PFN_vkGetInstanceProcAddr get, VkInstance instance, VkPhysicalDevice physical,
                     VkDevice device)
    : instance_(instance), device_(device) {
  vk_.load_instance(get, instance);
  vk_.load_device(device);
  take(physical);
}

GpuDevice::~GpuDevice() {
  pipelines_.clear();
  if (!own_) return;
  if (vk_.vkDestroyDevice) vk_.vkDestroyDevice(device_, nullptr);
  vk_.vkDestroyInstance(instance_, nullptr);
}

void GpuDevice::take(VkPhysicalDevice physical) {
  const Candidate candidate = candidate_of(vk_, physical);
  if (const std::string fault = candidate.fault(); !fault.empty()) {
    throw Error("the GPU cannot be used: " + candidate.name() + " " + fault);
  }
  physical_ = physical;
  limits_ = candidate.properties.limits;
  name_ = candidate.name() + " (" + candidate.driver + ")";
  uuid_ = candidate.uuid;
  family_ = static_cast<std::uint32_t>(candidate.family);
  vk_.vkGetPhysicalDeviceMemoryProperties(physical, &memory_);
}

std::vector<GpuInfo> GpuDevice::known() {
  std::vector<GpuInfo> list;
  for (const Candidate& candidate : Instance().candidates()) {
    if (!candidate.fault().empty()) continue;
    const bool software = candidate.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    list.push_back({candidate.name(), software});
  }
  return list;
}

std::shared_ptr<GpuDevice> GpuDevice::open(const std::string& name) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<GpuDevice>> opened;
  const std::lock_guard lock(mutex);
  if (auto device = opened[name].lock()) return device;
  Instance instance;
  const std::vector<Candidate> candidates = instance.candidates();
  const Candidate& candidate = chosen(candidates, name);
  std::shared_ptr<GpuDevice> made(new GpuDevice);
  const std::array<float, kMaxQueues> priorities{1, 1, 1, 1};
  auto queues = vulkan_struct<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queues.queueFamilyIndex = static_cast<std::uint32_t>(candidate.family);
  queues.queueCount = candidate.queues;
  queues.pQueuePriorities = priorities.data();
  auto info = vulkan_struct<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queues;
  expect(instance.vk.vkCreateDevice(candidate.handle, &info, nullptr, &made->device_),
         "vkCreateDevice");
  made->vk_ = instance.vk;
  made->instance_ = std::exchange(instance.handle, VK_NULL_HANDLE);
  made->own_ = true;
  made->vk_.load_device(made->device_);
  made->take(candidate.handle);
  for (std::uint32_t i = 0; i < candidate.queues; ++i) {
    auto queue = std::make_unique<Queue>();
    made->vk_.vkGetDeviceQueue(made->device_, made->family_, i, &queue->handle);
    made->queues_.push_back(std::move(queue));
  }
  opened[name] = made;
  return made;
}

void GpuDevice::submit(VkCommandBuffer commands, VkFence fence) {
  Queue* queue = nullptr;
  {
    const std::lock_guard lock(mutex_);
    queue = queues_[next_queue_++ % queues_.size()].get();
  }
  auto info = vulkan_struct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  info.commandBufferCount = 1;
  info.pCommandBuffers = &commands;
  {
    const std::lock_guard lock(queue->busy);
    expect(vk_.vkQueueSubmit(queue->handle, 1, &info, fence), "vkQueueSubmit");
  }
  expect(vk_.vkWaitForFences(device_, 1, &fence, VK_TRUE, ~std::uint64_t{0}), "vkWaitForFences");
  expect(vk_.vkResetFences(device_, 1, &fence), "vkResetFences");
}

VkDeviceMemory GpuDevice::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags must,
                                   VkMemoryPropertyFlags may) const {
  for (const VkMemoryPropertyFlags wanted : {must | may, must}) {
    for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
      const bool fits = (needs.memoryTypeBits >> i & 1) != 0;
      if (!fits || (memory_.memoryTypes[i].propertyFlags & wanted) != wanted) continue;
      auto info = vulkan_struct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
      info.allocationSize = needs.size;
      info.memoryTypeIndex = i;
      VkDeviceMemory memory = VK_NULL_HANDLE;
      expect(vk_.vkAllocateMemory(device_, &info, nullptr, &memory),
             "vkAllocateMemory of " + std::to_string(needs.size) + " bytes");
      return memory;
    }
  }
  throw Error(name_ + " has no memory type for its own images");
}

std::shared_ptr<const GpuPipeline> GpuDevice::pipeline(const ShaderProgram& program,
                                                       const std::filesystem::path& cache) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const GpuPipeline>& kept = pipelines_[program.id];
  if (!kept) kept = std::make_shared<const GpuPipeline>(*this, program, cache, uuid_);
  return kept;
}

}  // namespace limpid
