#include <algorithm>
#include <cstdio>

#include "limpid/composite.h"
#include "limpid/core/error.h"
#include "limpid/load/exr_file.h"
#include "limpid/load/image_file.h"
#include "limpid/load/look_file.h"
#include "limpid/run/fused.h"
#include "limpid/write/exr_writer.h"

#include "data_folder.h"
#include "verbs.h"

namespace limpid::tool {
namespace {

/// What is wrong with a word of the command line is wrong usage, whatever it is elsewhere.
template <class Work>
auto as_usage(Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(error.what(), Fault::kUsage);
  }
}

LayerOverrides layer_overrides(const std::vector<std::string>& texts) {
  LayerOverrides overrides;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Error("--layer " + text + ": expected ROLE=LAYER, as in depth=ViewLayer.Depth.Z",
                  Fault::kUsage);
    }
    as_usage([&] { role_named(text.substr(0, equals)); });
    overrides[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return overrides;
}

std::vector<Aov> aov_list(const std::vector<std::string>& names) {
  std::vector<Aov> list;
  for (const std::string& name : names) {
    if (name == "all") {
      list.clear();
      for (int i = 0; i < kAovCount; ++i) list.push_back(static_cast<Aov>(i));
      return list;
    }
    list.push_back(as_usage([&] { return aov_named(name); }));
  }
  return list;
}

Runner runner_named(const std::string& name) {
  if (name == "fused") return Runner::kFused;
  if (name == "reference") return Runner::kReference;
  throw Error("--runner " + name + ": expected fused or reference", Fault::kUsage);
}

/// "" for the best that the machine has.
std::string simd_named(const std::string& name, Runner runner) {
  if (name.empty()) return name;
  if (runner == Runner::kReference) {
    throw Error("--simd " + name + ": the reference runner has no instruction sets to choose from",
                Fault::kUsage);
  }
  const std::vector<std::string> known = simd_targets();
  if (std::find(known.begin(), known.end(), name) != known.end()) return name;
  throw Error("--simd " + name + ": expected one of " + join(known) + " on this machine" +
                  did_you_mean(name, known),
              Fault::kUsage);
}

std::string exr_named(const std::string& path) {
  if (path.empty() || is_exr(path)) return path;
  throw Error("-o " + path + ": expected a name that ends in .exr; --preview writes other formats",
              Fault::kUsage);
}

CompositeJob job_of(const CompositeArguments& a) {
  CompositeJob job;
  if (!a.scene.empty()) job.scene = load_scene(a.scene);
  job.plate.files.assign(a.plates.begin(), a.plates.end());
  job.plate.named = job.scene.plates;
  job.plate.layers = layer_overrides(a.layers);
  if (a.plates.empty() && job.plate.named.empty() && job.plate.layers.empty()) {
    throw Error("nothing to put water into: give plates, or a scene that names some",
                Fault::kUsage);
  }
  if (!a.depth_kind.empty()) job.depth_kind = depth_kind_named(a.depth_kind);
  job.look = look_for(a.look);
  for (const std::string& setting : a.settings) apply_setting(job.look, setting);
  job.time = a.time;
  job.output.aovs = aov_list(a.aovs);
  job.output.runner = runner_named(a.runner);
  job.output.simd = simd_named(a.simd, job.output.runner);
  job.output.picture = exr_named(a.output);
  job.output.preview = a.preview;
  validate_compression(a.compression);
  job.output.compression = a.compression;
  job.output.store_float = a.store_float;
  return job;
}

}  // namespace

int composite_verb(const CompositeArguments& a, const CommonArguments& common) {
  if (a.output.empty()) throw Error("no output: expected -o OUT.exr", Fault::kUsage);
  const CompositeJob job = job_of(a);
  set_file_threads(common.threads);
  const auto executor = make_executor(common.threads);
  if (common.verbose) std::printf("%s", Plate::inspect(job.plate).c_str());
  const CompositeReport report = composite(job, *executor);
  if (common.quiet) return 0;
  if (common.verbose) std::printf("%s", to_text(report.plan).c_str());
  std::printf("%s: %dx%d, look %s, read %.0f ms, run %.0f ms, write %.0f ms", a.output.c_str(),
              report.size.width, report.size.height, job.look.name.c_str(),
              1e3 * report.read_seconds, 1e3 * report.run_seconds, 1e3 * report.write_seconds);
  const std::string replaced = report.replaced.to_text();
  if (!replaced.empty()) std::printf("; NaN or inf replaced: %s", replaced.c_str());
  std::printf("\n");
  if (!a.preview.empty()) std::printf("%s\n", a.preview.c_str());
  for (const PlannedOperator& op : report.plan.operators) {
    if (op.verdict == Verdict::kAbsent) {
      std::printf("%s does not run: %s\n", std::string(op.name).c_str(), op.reason.c_str());
    }
  }
  return 0;
}

int plan_verb(const CompositeArguments& a) {
  std::printf("%s", to_text(plan_composite(job_of(a))).c_str());
  return 0;
}

int inspect_verb(const InspectArguments& a) {
  PlateRequest request;
  request.files.assign(a.plates.begin(), a.plates.end());
  request.layers = layer_overrides(a.layers);
  if (!a.scene.empty()) request.named = load_scene(a.scene).plates;
  if (request.files.empty() && request.named.empty() && request.layers.empty()) {
    throw Error("nothing to inspect: give plates, or a scene that names some", Fault::kUsage);
  }
  std::printf("%s", Plate::inspect(request).c_str());
  return 0;
}

}  // namespace limpid::tool
