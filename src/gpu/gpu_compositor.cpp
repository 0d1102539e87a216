#include "limpid/gpu/gpu_compositor.h"

#include <cstring>
#include <optional>
#include <utility>

#include "limpid/core/error.h"
#include "limpid/core/texture_levels.h"

#include "complete/completer.h"
#include "gpu/bindings.h"
#include "gpu/passage.h"
#include "plan/pass_of.h"

namespace limpid {
namespace {

constexpr int kMaxInFlight = 16;

static_assert(sizeof(VkImage) == sizeof(VkImage_T*), "handles are pointers on 64 bits");

/// A plane of the host's: a window, with one value that is never read.
View<const float> unseen(const Rect& window) {
  static constexpr float kNothing = 0;
  return {&kNothing, 0, 0, window};
}

/// Whether an image of this format holds halves; throws Error for other formats.
bool holds_halves(int format) {
  if (format == VK_FORMAT_R16G16B16A16_SFLOAT) return true;
  if (format == VK_FORMAT_R32G32B32A32_SFLOAT) return false;
  throw Error("picture: it has the Vulkan format " + std::to_string(format) +
              ", expected R16G16B16A16_SFLOAT (97) or R32G32B32A32_SFLOAT (109)");
}

/// The same frame in memory, with windows only.
Frame windows_of(const GpuFrame& host) {
  Frame frame;
  frame.display = host.display;
  for (const auto& [first, plane] : host.planes) {
    const Role* role = nullptr;
    for (const Role& known : roles()) {
      if (known.first == first) role = &known;
    }
    if (!role) throw Error("frame: an image is named by a plane that begins no role");
    const std::string name(role->name);
    if (!plane.view) throw Error("frame: " + name + " has no image view");
    const int least = first == PlaneId::kColorR ? 3 : role->count;
    if (plane.channels < least || plane.channels > role->count) {
      throw Error("frame: " + name + " has " + std::to_string(plane.channels) +
                  " channels, expected " + std::to_string(role->count));
    }
    for (int k = 0; k < plane.channels; ++k) {
      frame.planes[index_of(plane_after(first, k))] = unseen(plane.window);
    }
  }
  return frame;
}

/// Whether the texture changes only when the host sets it.
bool is_set_by_host(const std::string& texture) {
  return texture == "limpid_wave_map" || texture == "limpid_wave_levels" ||
         texture == "limpid_environment";
}

PFN_vkGetInstanceProcAddr loader_of(const GpuHost& host) {
  if (!host.instance || !host.physical_device || !host.device) {
    throw Error("GPU: the host has no instance, physical device or device");
  }
  return host.get_instance_proc_addr
             ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(host.get_instance_proc_addr)
             : vulkan_loader();
}

}  // namespace

struct __attribute__((visibility("hidden"))) GpuCompositor::State {
  /// The state of a frame until it has run.
  struct Slot {
    std::string id;  ///< of the bound program
    GpuBindings bindings;
    GpuBuffer block;
    std::map<std::string, Passage> inputs;  ///< textures that are not the host's
    std::map<std::string, bool> filled;     ///< textures that are up to date
  };

  State(const GpuHost& host, const Look& first, const GpuCompositorOptions& chosen)
      : options(chosen),
        device(std::make_shared<GpuDevice>(loader_of(host), host.instance, host.physical_device,
                                           host.device)),
        look(first),
        executor(make_executor(0)),
        slots(static_cast<std::size_t>(chosen.in_flight)) {}

  void forget_plan() {
    plan.reset();
    recorded = false;
    for (Slot& slot : slots) slot.filled.clear();
  }
  void make_plan(const Frame& windows, const Scene& scene);
  void fit(Slot& slot, const ShaderProgram& program, const GpuFrame& host);
  void fit_copy(const GpuImageView& color);
  void copy_color(VkCommandBuffer c, const GpuImageView& color);
  void expect_recorded() const {
    if (!recorded) throw Error("compositor: no frame has been recorded since its settings changed");
  }

  GpuCompositorOptions options;
  std::shared_ptr<GpuDevice> device;
  Look look;
  std::unique_ptr<Executor> executor;
  Frame textures;  ///< wave map and environment only
  std::vector<std::uint32_t> wave_map_bytes;
  LevelMaker wave_map_levels;
  Completer completer;
  std::optional<Plan> plan;
  PlaneSet planned_for;
  bool planned_sun = false, planned_sky = false, planned_waves = false;
  Primaries planned_primaries = kRec709;
  std::vector<std::string> left_out;
  bool recorded = false;  ///< a frame was recorded with this plan
  std::vector<Slot> slots;
  std::size_t next = 0;
  GpuImage in_place;  ///< a copy of color
};

void GpuCompositor::State::make_plan(const Frame& windows, const Scene& scene) {
  const bool sun = scene.sun.has_value(), sky = scene.sky.has_value(), waves = scene.has_waves();
  const bool same = planned_for == windows.present() && planned_sun == sun && planned_sky == sky &&
                    planned_waves == waves && planned_primaries == scene.primaries;
  if (plan && same) return;
  plan.reset();
  Plan made = limpid::make_plan(look, {.planes = windows.present(),
                                       .wave_map = static_cast<bool>(textures.wave_map),
                                       .sun = sun,
                                       .environment = static_cast<bool>(textures.environment),
                                       .waves = waves,
                                       .primaries = scene.primaries});
  left_out = Completer::made_of_pixels(made, sky);
  if (!left_out.empty() && !options.leave_out) {
    throw Error("the look " + look.name + " needs steps with pixels in CPU memory, which " +
                "a GPU frame does not have: " + join(left_out) +
                "; expected a look without them, or leave_out");
  }
  plan = std::move(made);
  planned_for = windows.present(), planned_sun = sun, planned_sky = sky, planned_waves = waves;
  planned_primaries = scene.primaries;
}

/// Makes pipeline, textures and bindings for the program.
void GpuCompositor::State::fit(Slot& slot, const ShaderProgram& program, const GpuFrame& host) {
  if (slot.id != program.id) {
    slot.id.clear();
    slot.filled.clear();
    slot.bindings = {};
    slot.bindings = GpuBindings(device, device->pipeline(program, options.cache), program);
    if (slot.block.size() < program.block.size()) {
      slot.block = GpuBuffer(device, program.block.size(), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    }
    slot.bindings.bind_block(program.block_binding, slot.block.handle());
    slot.id = program.id;
  }
  std::memcpy(slot.block.bytes(), program.block.data(), program.block.size());
  for (const ProgramTexture& texture : program.textures) {
    if (texture.source == ShaderTexture::Source::kPlanes) {
      const GpuImageView& plane = host.planes.at(role_named(texture.role).first);
      slot.bindings.bind_texture(texture.binding, plane.view,
                                 static_cast<VkImageLayout>(plane.layout));
      continue;
    }
    Passage& input = slot.inputs[texture.name];
    if (!slot.filled[texture.name]) input.fill(device, texture, *executor);
    slot.bindings.bind_texture(texture.binding, input.image.view(), kRead.layout);
  }
}

void GpuCompositor::State::fit_copy(const GpuImageView& color) {
  const auto format = static_cast<VkFormat>(color.format);
  if (in_place.size() == color.window.size() && in_place.format() == format) return;
  in_place = {};
  in_place = GpuImage(device, color.window.size(), format,
                      VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
}

/// Copies the color, so that lookups do not read pixels just written.
void GpuCompositor::State::copy_color(VkCommandBuffer c, const GpuImageView& color) {
  const Vulkan& vk = device->vk();
  const ImageUse read_and_written{VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                  VK_ACCESS_MEMORY_WRITE_BIT};
  const ImageUse copied{VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                        VK_ACCESS_TRANSFER_READ_BIT};
  turn(vk, c, color.image, read_and_written, copied);
  // Another frame's shader may still read the copy.
  turn(vk, c, in_place.handle(),
       {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0}, kCopiedTo);
  VkImageCopy whole{};
  whole.srcSubresource = whole.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  whole.extent = {static_cast<std::uint32_t>(color.window.width()),
                  static_cast<std::uint32_t>(color.window.height()), 1};
  vk.vkCmdCopyImage(c, color.image, VK_IMAGE_LAYOUT_GENERAL, in_place.handle(), kCopiedTo.layout, 1,
                    &whole);
  turn(vk, c, in_place.handle(), kCopiedTo, kRead);
  turn(vk, c, color.image, copied, kWritten);
}

GpuCompositor::GpuCompositor(const GpuHost& host, const Look& look,
                             const GpuCompositorOptions& options) {
  look.validate();
  if (options.in_flight < 1 || options.in_flight > kMaxInFlight) {
    throw Error("frames in flight = " + std::to_string(options.in_flight) + ": expected 1 ... " +
                std::to_string(kMaxInFlight));
  }
  state_ = std::make_unique<State>(host, look, options);
}

GpuCompositor::~GpuCompositor() = default;
GpuCompositor::GpuCompositor(GpuCompositor&&) noexcept = default;
GpuCompositor& GpuCompositor::operator=(GpuCompositor&&) noexcept = default;

void GpuCompositor::set_look(const Look& look) {
  look.validate();
  state_->look = look;
  state_->forget_plan();
}

void GpuCompositor::set_wave_map(const Texture& map) {
  if (map) map.validate("wave map");
  State& s = *state_;
  s.wave_map_bytes = map ? pack_bytes(map) : std::vector<std::uint32_t>{};
  s.textures.wave_map = map;
  s.textures.wave_map.bytes = s.wave_map_bytes.empty() ? nullptr : s.wave_map_bytes.data();
  if (map) s.wave_map_levels.make(s.textures.wave_map);
  s.textures.wave_map.levels = map ? &s.wave_map_levels.levels() : nullptr;
  s.forget_plan();
}

void GpuCompositor::set_environment(const Texture& environment) {
  if (environment) environment.validate("environment");
  state_->textures.environment = environment;
  state_->forget_plan();
}

void GpuCompositor::record(VkCommandBuffer_T* commands, const GpuFrame& host,
                           const GpuImageView& picture) {
  State& s = *state_;
  s.recorded = false;
  Frame windows = windows_of(host);
  windows.wave_map = s.textures.wave_map;
  windows.environment = s.textures.environment;
  windows.validate();
  host.scene.validate();
  s.make_plan(windows, host.scene);
  const Frame frame = s.completer.complete_windows(
      *s.plan, windows, pass_of(*s.plan, host.scene, windows), *s.executor, s.options.simd);
  Pass pass = pass_of(*s.plan, host.scene, frame);
  pass.plate_waves = s.completer.plate_waves();
  if (!s.plan->reads_environment) pass.environment = {};
  ShaderOptions options;
  options.stage = ShaderOptions::Stage::kCompute;
  options.max_threads = s.device->max_threads();
  options.half = holds_halves(picture.format);
  const Rect work = frame.work();
  const bool begins = picture.window.x0 == work.x0 && picture.window.y0 == work.y0;
  if (!picture.view || !begins || !picture.window.contains(work)) {
    throw Error("picture: expected an image that begins with the first pixel of the frame, (" +
                std::to_string(work.x0) + ", " + std::to_string(work.y0) + "), and has all " +
                std::to_string(work.width()) + "x" + std::to_string(work.height()));
  }
  const ShaderProgram program = program_of(*s.plan, windows, frame, pass, options, Gathered::kMade);
  const GpuImageView& color = host.planes.at(PlaneId::kColorR);
  const bool in_place = color.view == picture.view || (color.image && color.image == picture.image);
  GpuFrame seen = host;
  if (in_place) {
    const bool known = color.image && color.format == picture.format;
    if (!known || color.layout != VK_IMAGE_LAYOUT_GENERAL) {
      throw Error("picture: in place color is expected with its image, its format and in layout " +
                  std::string("general"));
    }
    s.fit_copy(color);
    GpuImageView& copy = seen.planes.at(PlaneId::kColorR);
    copy.view = s.in_place.view();
    copy.layout = kRead.layout;
  }
  State::Slot& slot = s.slots[s.next++ % s.slots.size()];
  s.fit(slot, program, seen);
  slot.bindings.bind_output(program.outputs[0].binding, picture.view);
  const VkCommandBuffer c = commands;
  for (const ProgramTexture& texture : program.textures) {
    if (texture.source == ShaderTexture::Source::kPlanes) continue;
    bool& filled = slot.filled[texture.name];
    if (!filled) slot.inputs.at(texture.name).upload(s.device->vk(), c);
    filled = is_set_by_host(texture.name);
  }
  if (in_place) s.copy_color(c, color);
  slot.bindings.dispatch(c, program);
  s.recorded = true;
}

const Plan& GpuCompositor::plan() const {
  state_->expect_recorded();
  return *state_->plan;
}

const std::vector<std::string>& GpuCompositor::left_out() const {
  state_->expect_recorded();
  return state_->left_out;
}

const std::string& GpuCompositor::device() const { return state_->device->name(); }

}  // namespace limpid
