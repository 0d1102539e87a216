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

/// The parts of measure_report(), one function per section of the report.

namespace limpid {

/// Data shared by all parts.
struct Measuring {
  const ReportOptions& options;
  std::vector<Look> looks;
  Look physical;   ///< the standard for the other looks
  Executor& one;   ///< thread
  Executor& many;  ///< threads
  int threads;     ///< number of threads of `many`
  std::string simd;
  Report& report;
  const GpuOptions* gpu = nullptr;  ///< of an existing GPU

  void say(const std::string& line) const {
    if (options.progress) options.progress(line);
  }
};

/// The same with looks changed to single scattering and no caustics, like a truth without noise.
Measuring scattered_once(Measuring measuring);

/// With `clip`, larger values such as glints count as Lagoon::kBrightest.
PixelError error_of(const Picture& picture, const Picture& judge, bool clip);
/// "296 ns/pixel, error mean 5.9·10⁻⁷, max 0.125": the end of a progress line.
std::string costs_text(double ns_per_pixel, const PixelError& error);

Figure figure_of(std::string name, std::string caption,
                 const std::array<View<const float>, 3>& linear);
/// With the page's scale: logarithmic, kHeatDecades.
Figure heat_figure_of(std::string name, std::string caption,
                      const std::array<View<const float>, 3>& picture,
                      const std::array<View<const float>, 3>& judge);

/// Looks x runners, and looks against physical; with `figures` also the pictures of the looks.
void measure_looks(const Measuring& m, Subject& subject, bool figures);
/// Models of refraction against the path-traced lagoon.
void measure_truth(const Measuring& m);
/// The look physical with one parameter changed.
void measure_choices(const Measuring& m, Subject& subject);

/// All looks on a scene against its ray-traced truth, and with `choices` physical with one
/// parameter changed.
void measure_models(const Measuring& m, const std::filesystem::path& scene_file, bool choices);

/// The looks physical and fast by the buffers of a plate: on the path-traced lagoon with its waves,
/// and on a scene with its ray-traced truth.
void measure_brought_lagoon(const Measuring& m);
void measure_brought_scene(const Measuring& m, const std::filesystem::path& scene_file);

/// Error budgets, in clear and in murky water.
void measure_budgets(const Measuring& m, Subject& subject);

/// This machine and build.
ReportMachine this_machine();
ReportBuild this_build();

}  // namespace limpid
