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
/// limpid as a post-processing stage of a program that draws with Vulkan: on the program's device,
/// images and command buffers, without copies to CPU memory and back. This header does not need
/// vulkan.h: handles are pointers to the structs that vulkan.h declares, as on all 64-bit
/// platforms.
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

/// The host's Vulkan, 1.2 or newer. The device needs no extension and no feature.
struct GpuHost {
  VkInstance_T* instance = nullptr;
  VkPhysicalDevice_T* physical_device = nullptr;
  VkDevice_T* device = nullptr;
  /// vkGetInstanceProcAddr; null: the function of libvulkan.so.1.
  void (*(*get_instance_proc_addr)(VkInstance_T*, const char*))() = nullptr;
};

/// An image of the host, or some of its channels. Texel (0, 0) is the pixel at the corner of the
/// window.
struct GpuImageView {
  VkImageView_T* view = nullptr;  ///< 2D, with one mip level
  /// of the view; for color and picture only, to recognise in-place use
  VkImage_T* image = nullptr;
  int format = 0;    ///< VkFormat, for the same two
  int layout = 0;    ///< VkImageLayout of the image when the commands run
  int channels = 0;  ///< number of channels of the role, from r on: 3 or 4 of color, 1 of depth
  Rect window;
};

/// A frame of the host on its device: images by the first plane of their role (PlaneId::kColorR,
/// kDepth, kShadow, kReflectionR, kSurfaceNormalX ...), in the conventions of Frame: linear color,
/// eye depth with +inf where no surface was hit. Images may have any format that a shader reads as
/// floats (R32, RGBA16F ...), in a layout for sampling, with VK_IMAGE_USAGE_SAMPLED_BIT. Values are
/// not checked: a NaN spreads to the pixels whose lookups read it. The scene must have a camera and
/// water.
struct GpuFrame {
  Rect display;
  std::map<PlaneId, GpuImageView> planes;
  Scene scene;
};

struct GpuCompositorOptions {
  /// The number of frames that may be recorded before the first of them has finished, 1 ... 16.
  int in_flight = 2;
  /// Whether steps that need pixels in CPU memory are left out (left_out()); else a look that needs
  /// them is refused.
  bool leave_out = false;
  std::filesystem::path cache = {};  ///< as in GpuOptions
  std::string simd = {};             ///< instruction set of the work on the CPU
};

/// Puts water into the frames of a host on its device. For one thread at a time.
///
/// A shader reads the host's images and writes the picture; the numbers of the frame, its rows, a
/// surface displaced by waves, and textures are uploaded from the compositor's memory. Completers
/// that need pixels (mixed edges, the bottom behind objects and beyond the picture, mirrored
/// surfaces beyond the picture, reflection depths, albedo, caustics, the light of the visible sky
/// and of the surroundings in the water) do not run: the pixels are not in CPU memory. With the
/// same planes the water equals that of GpuRunner, to the bit.
class GpuCompositor {
 public:
  /// Throws Error for a device that does not meet the requirements of GpuRunner, and for options
  /// out of range. The host's objects must outlive this one.
  explicit GpuCompositor(const GpuHost& host, const Look& look = {},
                         const GpuCompositorOptions& options = {});
  ~GpuCompositor();
  GpuCompositor(GpuCompositor&&) noexcept;
  GpuCompositor& operator=(GpuCompositor&&) noexcept;

  /// As in Compositor. Textures are copied to the device with the next frames.
  void set_look(const Look& look);
  void set_wave_map(const Texture& map);
  void set_environment(const Texture& environment);

  /// Writes the commands of a frame into a command buffer that is being recorded, outside of any
  /// render pass, for a queue with compute. When the commands run, the frame's images must have
  /// been written and be visible to compute shaders. The commands write `picture` by a compute
  /// shader, in layout general; the host adds the barrier for its own use. `picture` is an image
  /// with VK_IMAGE_USAGE_STORAGE_BIT, in layout general, of format R16G16B16A16_SFLOAT or
  /// R32G32B32A32_SFLOAT, at least as large as the frame's work(). It may be the image of color, in
  /// place; this image then needs VK_IMAGE_USAGE_TRANSFER_SRC_BIT and is copied first. Alpha is 1
  /// where water is, else that of color, or 1 if color has three channels.
  ///
  /// From the second frame of a kind on record() creates no pipeline and allocates no device
  /// memory. Throws Error before it records anything: as Frame::validate(), Scene::validate() and
  /// make_plan() do, for a look that needs a step that cannot run here (unless leave_out is set),
  /// and for images that do not fit.
  void record(VkCommandBuffer_T* commands, const GpuFrame& frame, const GpuImageView& picture);

  /// The plan of the last frame, and the steps that were left out, a phrase each. Throws Error if
  /// no frame has been recorded since the look or a texture was set.
  const Plan& plan() const;
  const std::vector<std::string>& left_out() const;
  /// The name of the device, and its driver.
  const std::string& device() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limpid
