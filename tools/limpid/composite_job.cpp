#include "composite_job.h"

#include <cmath>

#include "limpid/core/error.h"
#include "limpid/files/text/frame_range.h"

#include "frame_options.h"
#include "memory_limit.h"
#include "water_options.h"

namespace limpid::tool {
namespace {

double finite_nothing(double depth) {
  if (std::isfinite(depth)) return depth;
  throw Error("--depth-nothing " + std::to_string(depth) +
                  ": expected a finite number, for inf is nothing always",
              Fault::kUsage);
}

}  // namespace

LayerOverrides layer_overrides(const std::vector<std::string>& texts) {
  LayerOverrides overrides;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const bool whole = equals != std::string::npos && equals > 0 && equals + 1 < text.size();
    if (!whole || text.ends_with(':') || text[equals + 1] == ':') {
      throw Error("--layer " + text +
                      ": expected ROLE=LAYER, as in depth=ViewLayer.Depth.Z, depth=plate.exr:Z or "
                      "depth=none",
                  Fault::kUsage);
    }
    as_usage([&] { role_named(text.substr(0, equals)); });
    overrides[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return overrides;
}

CompositeJob common_job(const CompositeArguments& a, const Sequence& sequence,
                        const CommonArguments& common) {
  CompositeJob job;
  job.plate.limits = limits_of(common);
  const bool alone = sequence.frames.empty();
  if (!a.scene.empty()) {
    job.scene = load_scene(alone ? a.scene : name_of_frame(a.scene, sequence.frames.front()));
  }
  job.plate.files.assign(a.plates.begin(), a.plates.end());
  job.plate.named = job.scene.plates;
  job.plate.layers = layer_overrides(a.layers);
  job.plate.view = a.view;
  if (a.plates.empty() && job.plate.named.empty() && job.plate.layers.empty()) {
    throw Error("nothing to put water into: give plates, or a scene that names some",
                Fault::kUsage);
  }
  if (!a.depth_kind.empty()) job.depth_kind = depth_kind_named(a.depth_kind);
  if (a.depth_nothing) job.depth_nothing = finite_nothing(*a.depth_nothing);
  job.look = look_of(a.water);
  job.time.asked = a.water.time;
  job.output = output_of(a.water);
  job.output.wave_samples = a.samples;
  job.output.overscan = a.overscan;
  return job;
}

CompositeJob job_of_frame(CompositeJob job, const CompositeArguments& a, int frame) {
  if (has_frame_number(a.scene)) {
    job.scene = load_scene(name_of_frame(a.scene, frame));
    job.plate.named = job.scene.plates;
  }
  for (auto& file : job.plate.files) file = name_of_frame(file.string(), frame);
  for (auto& [role, name] : job.plate.named) name = name_of_frame(name, frame);
  for (auto& [role, name] : job.plate.layers) name = name_of_frame(name, frame);
  job.time = time_of_frame(a.frames, a.water, job.scene, has_frame_number(a.scene), frame);
  job.output = output_of_frame(job.output, frame);
  return job;
}

}  // namespace limpid::tool
