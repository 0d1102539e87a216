#include "limpid/gpu/gpu_runner.h"

#include <array>
#include <cstring>
#include <map>
#include <utility>

#include "complete/completer.h"
#include "complete/rows.h"
#include "gpu/bindings.h"
#include "gpu/commands.h"
#include "gpu/gpu_load.h"
#include "gpu/passage.h"
#include "plan/pass_of.h"
#include "run/checks.h"
#include "run/put_edges.h"
#include "run/show_planes.h"

namespace limpid {
namespace {

/// The AOVs of the target.
std::vector<Aov> aovs_of(const Target& target) {
  std::vector<Aov> list;
  for (int i = 0; i < kAovCount; ++i) {
    if (target.aovs[static_cast<std::size_t>(i)][0]) list.push_back(static_cast<Aov>(i));
  }
  return list;
}

}  // namespace

struct __attribute__((visibility("hidden"))) GpuRunner::Kept {
  explicit Kept(const GpuOptions& chosen)
      : options(chosen), device(GpuDevice::open(chosen.device)), commands(device) {}

  void fit(const ShaderProgram& program);
  void fill(const ShaderProgram& program, Executor& executor);
  void compute(const ShaderProgram& program);
  void store(const ShaderProgram& program, const std::vector<Aov>& made, const Target& target,
             Executor& executor) const;

  GpuOptions options;
  std::shared_ptr<GpuDevice> device;
  GpuCommands commands;
  Completer completer;
  std::string id;  ///< of the bound program
  GpuBindings bindings;
  GpuBuffer block;
  std::map<std::string, Passage> inputs;  ///< by the names of the program's textures
  std::vector<Passage> outputs;
};

/// Makes pipeline and memory for the program.
void GpuRunner::Kept::fit(const ShaderProgram& program) {
  if (id != program.id) {
    id.clear();
    bindings = {};
    bindings = GpuBindings(device, device->pipeline(program, options.cache), program);
    std::erase_if(inputs, [&](const auto& input) {
      return std::none_of(program.textures.begin(), program.textures.end(),
                          [&](const auto& texture) { return texture.name == input.first; });
    });
    outputs.resize(program.outputs.size());
    if (block.size() < program.block.size()) {
      block = GpuBuffer(device, program.block.size(), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    }
    bindings.bind_block(program.block_binding, block.handle());
    id = program.id;
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    outputs[i].fit_output(device, program.work.size());
    bindings.bind_output(program.outputs[i].binding, outputs[i].image.view());
  }
}

void GpuRunner::Kept::fill(const ShaderProgram& program, Executor& executor) {
  std::memcpy(block.bytes(), program.block.data(), program.block.size());
  for (const ProgramTexture& texture : program.textures) {
    Passage& input = inputs[texture.name];
    input.fill(device, texture, executor);
    bindings.bind_texture(texture.binding, input.image.view(), kRead.layout);
  }
}

void GpuRunner::Kept::compute(const ShaderProgram& program) {
  const Vulkan& vk = device->vk();
  commands.run([&](VkCommandBuffer c) {
    for (const auto& [name, input] : inputs) input.upload(vk, c);
    for (const Passage& output : outputs) turn(vk, c, output.image.handle(), kUnused, kWritten);
    bindings.dispatch(c, program);
    for (const Passage& output : outputs) output.download(vk, c);
    auto seen = vulkan_struct<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    seen.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    seen.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vk.vkCmdPipelineBarrier(c, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                            &seen, 0, nullptr, 0, nullptr);
  });
}

void GpuRunner::Kept::store(const ShaderProgram& program, const std::vector<Aov>& made,
                            const Target& target, Executor& executor) const {
  const Rect work = program.work;
  const auto store_row = [&](const Passage& from, std::size_t channel, const View<float>& to,
                             int y) {
    if (!to) return;
    const float* four = from.buffer.floats() + 4 * std::ptrdiff_t{work.width()} * (y - work.y0) +
                        static_cast<std::ptrdiff_t>(channel);
    float* row = &to.at(work.x0, y);
    for (int x = 0; x < work.width(); ++x) row[x * to.x_stride] = four[4 * std::ptrdiff_t{x}];
  };
  each_row(executor, work, [&](int y) {
    for (std::size_t k = 0; k < 3; ++k) store_row(outputs[0], k, target.color[k], y);
    store_row(outputs[0], 3, target.alpha, y);
    for (std::size_t i = 0; i < made.size(); ++i) {
      const std::array<View<float>, 3>& views = target.of(made[i]);
      for (std::size_t k = 0; k < 3; ++k) store_row(outputs[i + 1], k, views[k], y);
    }
  });
}

GpuRunner::GpuRunner(const GpuOptions& options) : kept_(std::make_unique<Kept>(options)) {}
GpuRunner::GpuRunner(GpuRunner&&) noexcept = default;
GpuRunner& GpuRunner::operator=(GpuRunner&&) noexcept = default;
GpuRunner::~GpuRunner() = default;

const std::string& GpuRunner::device() const { return kept_->device->name(); }

void GpuRunner::run(const Plan& plan, const Frame& plate, const Scene& scene, const Target& target,
                    Executor& executor) {
  check_run(plan, plate, scene, target);
  Kept& k = *kept_;
  const Frame frame =
      k.completer.complete(plan, plate, pass_of(plan, scene, plate), executor, &k.options.simd);
  Pass pass = pass_of(plan, scene, frame);
  pass.plate_waves = k.completer.plate_waves();
  if (!plan.reads_environment) pass.environment = {};  // not checked
  ShaderOptions options = compute_shader(aovs_of(target));
  options.max_threads = k.device->max_threads();
  const ShaderProgram program = program_of(plan, plate, frame, pass, options, Gathered::kAll);
  k.fit(program);
  k.fill(program, executor);
  k.compute(program);
  k.store(program, options.aovs, target, executor);
  put_edges(frame, target, executor);
  show_planes(plan, frame, target, executor);
}

std::vector<GpuInfo> gpu_devices() { return GpuDevice::known(); }

}  // namespace limpid
