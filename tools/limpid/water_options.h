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

/// What composite and water have in common: look, output, report line.

namespace limpid::tool {

/// What is wrong with a word of the command line is wrong usage, whatever it is elsewhere.
template <class Work>
auto as_usage(Work&& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(error.what(), Fault::kUsage);
  }
}

/// What --aov names, each once; all that is known where `all` is among it. Throws the usage Error
/// for what is not known.
std::vector<std::string> aov_names(const std::vector<std::string>& names,
                                   const std::vector<std::string>& known);

/// The threads that --threads asks for: for compositing, and as many for decoding and encoding.
std::unique_ptr<Executor> executor_of(const CommonArguments& common);

/// WxH, each in least ... most. Throws the usage Error of an option --size.
Size size_named(const std::string& text, int least = 1, int most = kMaxRenderedSide);

Look look_of(const WaterOptions& options);

/// Throws the Error for a scene file without geometry.
SceneFile scene_to_render(const std::string& path);
/// Its geometry. Says so where it had triangles of no area, and what is not drawn.
Model model_to_render(const SceneFile& scene, bool draw_what_you_can,
                      const CommonArguments& common);

/// Throws the usage Error for no name, or one that is not an EXR's.
void expect_output(const std::string& path);
OutputChoice output_of(const WaterOptions& options);
inline constexpr const char* kPlainDisplay = "sRGB";  ///< as --display: without a config
/// How light is shown, by the options, else $OCIO. Throws the usage Error for a view that is not
/// there, and for any of the options where nothing `shows` it.
DisplayChoice display_of(const WaterOptions& options, bool shows);

/// What there is to say of a frame: with -v the plan, then the files written, sizes and times.
std::string report_text(const CompositeReport& report, const Look& look, const OutputChoice& output,
                        const CommonArguments& common);
/// What of the chain does not run and would be missed, a line each.
std::string report_notes(const CompositeReport& report);
/// Prints both.
void print_report(const CompositeReport& report, const Look& look, const OutputChoice& output,
                  const CommonArguments& common);
/// Tells both of frame after frame. The arguments must outlive it.
OnFrame report_frames(Progress& progress, const Look& look, const OutputChoice& output,
                      const CommonArguments& common);

}  // namespace limpid::tool
