#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/gpu/gpu_runner.h"
#include "limpid/ops/look.h"

#include "judge/compare/compare.h"
#include "judge/report/picture.h"
#include "judge/report/report.h"
#include "judge/report/subject.h"

/// The parts of measure_report(), one function a section of the report.

namespace limpid {

/// What all parts share.
struct Measuring {
  const ReportOptions& options;
  std::vector<Look> looks;
  Look physical;   ///< the judge of the others
  Executor& one;   ///< thread
  Executor& many;  ///< threads
  int threads;     ///< that `many` has
  std::string simd;
  Report& report;
  const GpuOptions* gpu = nullptr;  ///< of one that is there

  void say(const std::string& line) const {
    if (options.progress) options.progress(line);
  }
};

/// The same with light that water scatters once and waves do not focus, as a truth without noise
/// has it, in looks that scatter it more often.
Measuring scattered_once(Measuring measuring);

/// With `clip` larger values, as of glints, count as Lagoon::kBrightest.
PixelError error_of(const Picture& picture, const Picture& judge, bool clip);
/// "296 ns/pixel, error mean 5.9·10⁻⁷, max 0.125": the end of a line of progress.
std::string costs_text(double ns_per_pixel, const PixelError& error);

Figure figure_of(std::string name, std::string caption,
                 const std::array<View<const float>, 3>& linear);
/// On the scale that the page shows: logarithmic, kHeatDecades.
Figure heat_figure_of(std::string name, std::string caption,
                      const std::array<View<const float>, 3>& picture,
                      const std::array<View<const float>, 3>& judge);

/// Looks x runners, and looks beside physical; with `figures` the pictures of the looks, too.
void measure_looks(const Measuring& m, Subject& subject, bool figures);
/// Ways to refract against the path-traced lagoon.
void measure_truth(const Measuring& m);
/// The look physical with one choice changed.
void measure_choices(const Measuring& m, Subject& subject);

/// All looks on a scene beside its ray-traced truth, and with `choices` physical with one changed.
void measure_models(const Measuring& m, const std::filesystem::path& scene_file, bool choices);

/// The looks physical and fast by what one brings: on the path-traced lagoon with its waves, and on
/// a scene beside its ray-traced truth.
void measure_brought_lagoon(const Measuring& m);
void measure_brought_scene(const Measuring& m, const std::filesystem::path& scene_file);

/// Errors that are allowed, in clear water and in murky.
void measure_budgets(const Measuring& m, Subject& subject);

/// Of this machine and this build.
ReportMachine this_machine();
ReportBuild this_build();

}  // namespace limpid
