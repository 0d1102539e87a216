#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/ops/look.h"
#include "limpid/plan/plan.h"

/// @file
/// limpid as a post-processing stage of a program that draws with Vulkan: its device, its images,
/// its command buffers, without copies to memory and back. Including this does not need vulkan.h:
/// handles are pointers to the structs that it names, as on all 64-bit platforms.
///
///     GpuCompositor water({instance, physical, device, vkGetInstanceProcAddr}, look);
///     ...
///     water.record(commands, frame, picture);  // each frame, into the host's command buffer

struct VkInstance_T;
struct VkPhysicalDevice_T;
struct VkDevice_T;
struct VkCommandBuffer_T;
struct VkImage_T;
struct VkImageView_T;

namespace limpid {

/// A host's Vulkan 1.2 or newer. The device needs no extension and no feature.
struct GpuHost {
  VkInstance_T* instance = nullptr;
  VkPhysicalDevice_T* physical_device = nullptr;
  VkDevice_T* device = nullptr;
  /// vkGetInstanceProcAddr; null: that of libvulkan.so.1.
  void (*(*get_instance_proc_addr)(VkInstance_T*, const char*))() = nullptr;
};

/// An image of the host, or some of its channels: texel (0, 0) is the pixel at the corner of the
/// window.
struct GpuImageView {
  VkImageView_T* view = nullptr;  ///< of two dimensions, one level
  VkImage_T* image = nullptr;     ///< behind it; of color and picture alone, to see that it is one
  int format = 0;                 ///< VkFormat, of the same two
  int layout = 0;                 ///< VkImageLayout in which it is when the commands run
  int channels = 0;               ///< of the role, from r on: 3 or 4 of color, 1 of depth
  Rect window;
};

/// A frame of the host on its device: images by the first plane of their role (PlaneId::kColorR,
/// kDepth, kShadow, kReflectionR, kSurfaceNormalX ...), in the conventions of Frame: linear color,
/// eye depth with +inf where no surface was hit. Any format that a shader reads as floats (R32,
/// RGBA16F ...), in a layout for that, with VK_IMAGE_USAGE_SAMPLED_BIT. Nothing is checked: NaN
/// gives NaN around it. The scene must have camera and water.
struct GpuFrame {
  Rect display;
  std::map<PlaneId, GpuImageView> planes;
  Scene scene;
};

struct GpuCompositorOptions {
  /// Frames that may be recorded before the first of them has been run, 1 ... 16.
  int in_flight = 2;
  /// Whether steps that need pixels in CPU memory are left out (left_out()); else a look that needs
  /// them is refused.
  bool leave_out = false;
  std::filesystem::path cache = {};  ///< as in GpuOptions
  std::string simd = {};             ///< of the work on the CPU
};

/// Puts water into the frames of a host on its device. For one thread at a time.
///
/// A shader reads the host's images and writes the picture; the numbers of the frame, its rows, a
/// surface displaced by waves, and textures are uploaded from the compositor's memory. Completers
/// that need pixels (mixed edges, the bottom behind objects and beyond the picture, reflection
/// depths, albedo, caustics) do not run: the pixels are not in CPU memory. With the same planes the
/// water equals that of GpuRunner, to the bit.
class GpuCompositor {
 public:
  /// Throws Error for a device that does not meet the needs of GpuRunner, and for options out of
  /// range. The host's objects must outlive this one.
  explicit GpuCompositor(const GpuHost& host, const Look& look = {},
                         const GpuCompositorOptions& options = {});
  ~GpuCompositor();
  GpuCompositor(GpuCompositor&&) noexcept;
  GpuCompositor& operator=(GpuCompositor&&) noexcept;

  /// As those of a Compositor. Textures are copied to the device with the next frames.
  void set_look(const Look& look);
  void set_wave_map(const Texture& map);
  void set_environment(const Texture& environment);

  /// Writes the commands of a frame: into a command buffer that is being recorded, outside of any
  /// render pass, for a queue that computes. When they run, the frame's images must have been
  /// written and be visible to compute shaders; after them `picture` has been written by a compute
  /// shader, in layout general, for the host to wait for. It is an image with
  /// VK_IMAGE_USAGE_STORAGE_BIT, in layout general, of format R16G16B16A16_SFLOAT or
  /// R32G32B32A32_SFLOAT, at least as large as the frame's work(); it may be the image of color, in
  /// place, which then needs VK_IMAGE_USAGE_TRANSFER_SRC_BIT and is copied first. Alpha is 1 where
  /// water is, else that of color, or 1 where that has three channels.
  ///
  /// From the second frame of a kind on no pipeline and no memory of the device is made. Throws
  /// Error, before anything is recorded: for what Frame::validate, camera, water and the planner
  /// refuse, a look that needs what is left out, and images that do not fit.
  void record(VkCommandBuffer_T* commands, const GpuFrame& frame, const GpuImageView& picture);

  /// Of the last frame: what ran and why; and the steps that were left out, a phrase each. Throws
  /// Error if no frame has been recorded since the look or a texture was set.
  const Plan& plan() const;
  const std::vector<std::string>& left_out() const;
  /// The device, and its driver.
  const std::string& device() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limpid
