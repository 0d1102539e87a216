#pragma once
#include <memory>
#include <string>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/job/composite.h"
#include "limpid/raster/model.h"
#include "limpid/raster/render_plate.h"

#include "arguments.h"
#include "progress.h"

/// Common to composite and water: look, output, report line.

namespace limpid::tool {

/// An error about a word of the command line is wrong usage here, for any Fault.
template <class Work>
auto as_usage(Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(error.what(), Fault::kUsage);
  }
}

/// The AOVs of --aov, each once; all known AOVs if `all` is among them. Throws the usage Error for
/// unknown ones.
std::vector<std::string> aov_names(const std::vector<std::string>& names,
                                   const std::vector<std::string>& known);

/// The threads of --threads: for compositing, and as many for decoding and encoding.
std::unique_ptr<Executor> executor_of(const CommonArguments& common);

/// WxH, each in least ... most. Throws the usage Error of an option --size.
Size size_named(const std::string& text, int least = 1, int most = kMaxRenderedSide);

Look look_of(const WaterOptions& options);

/// Throws the Error for a scene file without geometry.
SceneFile scene_to_render(const std::string& path);
/// Its geometry. Warns of triangles without area, and of parts that are not drawn.
Model model_to_render(const SceneFile& scene, bool skip_unsupported, const CommonArguments& common);

/// Throws the usage Error for a missing name, or one without an EXR extension.
void expect_output(const std::string& path);
OutputChoice output_of(const WaterOptions& options);
inline constexpr const char* kPlainDisplay = "sRGB";  ///< as --display: without a config
/// The display by the options, else by $OCIO. Throws the usage Error for an unknown view, and for
/// any of the options without an output that `shows` light.
DisplayChoice display_of(const WaterOptions& options, bool shows);

/// The report on a frame: with -v the plan, then the files written, sizes and times.
std::string report_text(const CompositeReport& report, const Look& look, const OutputChoice& output,
                        const CommonArguments& common);
/// The operators that do not run and would be missed, a line each.
std::string report_notes(const CompositeReport& report);
/// Prints both.
void print_report(const CompositeReport& report, const Look& look, const OutputChoice& output,
                  const CommonArguments& common);
/// Reports both for each frame. The arguments must outlive it.
OnFrame report_frames(Progress& progress, const Look& look, const OutputChoice& output,
                      const CommonArguments& common);

}  // namespace limpid::tool
