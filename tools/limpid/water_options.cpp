#include "water_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_file.h"
#include "limpid/files/exr/exr_writer.h"
#include "limpid/files/gltf/gltf.h"
#include "limpid/files/picture/image_file.h"
#include "limpid/files/text/look_file.h"
#include "limpid/run/fused.h"

#include "data_folder.h"
#include "frame_options.h"
#include "memory_limit.h"
#include "notes.h"

namespace limpid::tool {
namespace {

constexpr int kShownAcross = 1024;  ///< largest width of a picture in a terminal, in pixels

std::vector<Aov> aov_list(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const AovInfo& info : aovs()) known.emplace_back(info.name);
  std::vector<Aov> list;
  for (const std::string& name : aov_names(names, known)) list.push_back(aov_named(name));
  return list;
}

/// "" for the machine's best.
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

double max_error_of(const WaterOptions& a, Runner runner) {
  if (a.max_error > 0 && runner != Runner::kFused) {
    char text[96];
    std::snprintf(text, sizeof text, "--max-error %g: the %s runner leaves nothing out",
                  a.max_error, std::string(runner_name(runner)).c_str());
    throw Error(text, Fault::kUsage);
  }
  return a.max_error;
}

std::string exr_named(const std::string& option, const std::string& path) {
  if (path.empty() || is_exr(path)) return path;
  throw Error(
      option + " " + path + ": expected a name that ends in .exr; --preview writes other formats",
      Fault::kUsage);
}

}  // namespace

std::vector<std::string> aov_names(const std::vector<std::string>& names,
                                   const std::vector<std::string>& known) {
  const auto among = [](const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  std::vector<std::string> list;
  for (const std::string& name : names) {
    if (name != "all" && !among(known, name)) {
      throw Error("--aov: '" + name + "' is not an AOV: expected all or some of " + join(known) +
                      did_you_mean(name, known),
                  Fault::kUsage);
    }
    if (!among(list, name)) list.push_back(name);
  }
  return among(list, "all") ? known : list;
}

std::unique_ptr<Executor> executor_of(const CommonArguments& common) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  set_file_threads(common.threads == 0 ? cores : common.threads);
  return make_executor(common.threads);
}

Size size_named(const std::string& text, int least, int most) {
  Size size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool cross = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = cross ? std::from_chars(width.ptr + 1, end, size.height) : width;
  const auto within = [&](int side) { return side >= least && side <= most; };
  const bool numbers = cross && height.ec == std::errc() && height.ptr == end;
  if (!numbers || !within(size.width) || !within(size.height)) {
    throw Error("--size " + text + ": expected WxH, as in 1920x1080, with " +
                    std::to_string(least) + " ... " + std::to_string(most) + " pixels a side",
                Fault::kUsage);
  }
  return size;
}

Look look_of(const WaterOptions& a) {
  Look look = look_for(a.look);
  apply_settings(look, a.settings);
  return look;
}

SceneFile scene_to_render(const std::string& path) {
  SceneFile scene = load_scene(path);
  if (scene.geometry.empty()) {
    throw Error(path + ": expected a [geometry] with a glTF file to render");
  }
  return scene;
}

Model model_to_render(const SceneFile& scene, bool skip_unsupported,
                      const CommonArguments& common) {
  const Undrawable undrawable = skip_unsupported ? Undrawable::kLeaveOut : Undrawable::kRefuse;
  Model model = load_gltf(scene.geometry, limits_of(common), undrawable);
  if (model.skipped_triangles > 0 && !common.quiet) {
    std::printf("%s: %lld triangles without area are left out\n", scene.geometry.c_str(),
                static_cast<long long>(model.skipped_triangles));
  }
  tell_warnings(model, scene.geometry.string(), common);
  return model;
}

void expect_output(const std::string& path) {
  if (path.empty()) throw Error("no output: expected -o OUT.exr", Fault::kUsage);
  exr_named("-o", path);
}

DisplayChoice display_of(const WaterOptions& a, bool shows) {
  const auto refuse = [](const std::string& given, const std::string& expected) {
    throw Error(given + ": expected " + expected, Fault::kUsage);
  };
  if (!shows) {
    const std::string beside = "--preview, --contact-sheet or --show beside it";
    if (a.exposure) refuse("--exposure", beside);
    if (!a.display.empty()) refuse("--display " + a.display, beside);
    if (!a.ocio.empty()) refuse("--ocio " + a.ocio, beside);
    return {};
  }
  DisplayChoice display{.exposure = a.exposure.value_or(0), .config = {}};
  if (a.display == kPlainDisplay) {
    if (!a.ocio.empty()) refuse("--ocio " + a.ocio, "a view of it, not --display sRGB, beside it");
    return display;
  }
  const char* const environment = std::getenv("OCIO");
  display.config = !a.ocio.empty() ? a.ocio : environment ? environment : "";
  if (display.config.empty() && !a.display.empty()) {
    refuse("--display " + a.display, "sRGB, or an OpenColorIO config by --ocio or $OCIO");
  }
  // Its full name, for records and pages.
  if (!display.config.empty()) display.view = display_view(display.config, a.display);
  return display;
}

OutputChoice output_of(const WaterOptions& a) {
  OutputChoice output;
  output.aovs = aov_list(a.aovs);
  output.aov_names = as_usage([&] { return aov_names_named(a.aov_names); });
  output.runner = runner_named(a.runner);
  output.simd = simd_named(a.simd, output.runner);
  if (!a.gpu.empty() && output.runner != Runner::kGpu) {
    throw Error("--gpu " + a.gpu + ": expected --runner gpu beside it", Fault::kUsage);
  }
  output.gpu = a.gpu;
  output.gpu_cache = cache_folder();
  output.max_error = max_error_of(a, output.runner);
  output.strict = a.strict;
  output.picture = exr_named("-o", a.output);
  output.preview = a.preview;
  output.contact_sheet = a.contact_sheet;
  if (!a.show.empty()) output.preview_across = kShownAcross;
  output.display = display_of(a, output.shows());
  output.deep = exr_named("--deep", a.deep);
  validate_compression(a.compression);
  output.compression = a.compression;
  output.store_float = a.store_float;
  return output;
}

std::string report_text(const CompositeReport& report, const Look& look, const OutputChoice& output,
                        const CommonArguments& common) {
  char times[96];
  std::snprintf(times, sizeof times, "read %.0f ms, run %.0f ms, write %.0f ms",
                1e3 * report.read_seconds, 1e3 * report.run_seconds, 1e3 * report.write_seconds);
  std::string text = common.verbose ? to_text(report.plan) : "";
  text += output.picture.string() + ": " + std::to_string(report.size.width) + "x" +
          std::to_string(report.size.height) + ", look " + look.name + ", " + times;
  const std::string replaced = report.replaced.to_text();
  if (!replaced.empty()) text += "; replaced: " + replaced;
  text += "\n";
  for (const auto& also : {output.preview, output.contact_sheet, output.deep}) {
    if (!also.empty()) text += also.string() + "\n";
  }
  return text;
}

std::string report_notes(const CompositeReport& report) {
  std::string notes;
  for (const PlannedOperator& op : report.plan.operators) {
    if (op.verdict == Verdict::kAbsent) {
      notes += std::string(op.name) + " does not run: " + op.reason + "\n";
    }
  }
  if (!report.left_out.empty()) {
    notes += "not passed through: " + join(report.left_out) + " (--pass-through all, or names)\n";
  }
  return notes;
}

void print_report(const CompositeReport& report, const Look& look, const OutputChoice& output,
                  const CommonArguments& common) {
  tell_warnings(report.warnings, common.quiet);
  if (common.quiet) return;
  std::printf("%s%s", report_text(report, look, output, common).c_str(),
              report_notes(report).c_str());
}

OnFrame report_frames(Progress& progress, const Look& look, const OutputChoice& output,
                      const CommonArguments& common) {
  return [&](const SequenceProgress& at, const CompositeReport& report) {
    const OutputChoice written = output_of_frame(output, at.frame);
    progress.warn(report.warnings);
    progress.frame_done(at, report_text(report, look, written, common), report_notes(report),
                        report.replaced.total() > 0);
  };
}

}  // namespace limpid::tool
