#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limpid/complete/beyond.h"
#include "limpid/core/color_space.h"
#include "limpid/core/executor.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/job/job_time.h"
#include "limpid/job/output.h"
#include "limpid/ops/look.h"
#include "limpid/plan/plan.h"
#include "limpid/plan/survey.h"
#include "limpid/plate/plate.h"
#include "limpid/run/fused.h"

namespace limpid {

/// From files to files: what `limpid composite` does.
struct CompositeJob {
  PlateRequest plate;
  SceneFile scene;
  std::optional<DepthKind> depth_kind;  ///< instead of the scene's
  std::optional<double> depth_nothing;  ///< instead of the scene's
  /// The working space, instead of what the scene says, else the plate, else Rec.709. The picture's
  /// file says so, too.
  std::optional<Primaries> primaries = {};
  JobTime time;
  Look look;

  /// The next frame or the previous one: the vectors of OutputChoice::motion and motion_reflected
  /// are computed by its camera, its water plane and its waves, as of a scene that stands still,
  /// instead of by vectors of the plate. Its plate has the display window of this frame's, and may
  /// be missing if `scene` has the camera and the water. In both frames the camera is above the
  /// water.
  struct SecondFrame {
    PlateRequest plate;
    SceneFile scene;
    JobTime time = {};
    bool is_previous = false;
  };
  std::optional<SecondFrame> second = {};

  /// Of stereo: the views besides that of `plate`, each with its own camera. All are put into one
  /// file, a part each that is called after its view, `plate`'s the first.
  struct View {
    std::string name;
    PlateRequest plate;
    SceneFile scene;
    std::optional<SecondFrame> second = {};
  };
  std::string view_name = {};  ///< of `plate`; where there are others
  std::vector<View> other_views = {};

  OutputChoice output;
};

/// What a preview shows, in memory.
struct PreviewPixels {
  Size size;
  std::vector<std::uint8_t> rgb;  ///< rows from the top
};

/// What was done, for the report line.
struct CompositeReport {
  Plan plan;  ///< of the first view
  Size size;
  /// Layers of the plates that feed no role, where OutputChoice::pass_through is empty: they are
  /// not in the picture's file.
  std::vector<std::string> left_out = {};
  SanitiseCounts replaced;
  /// What the picture does not show though it was asked for, a sentence each: Plan::warnings,
  /// primaries that the plate contradicts, layers that are named and not read, and a picture
  /// without a wet pixel or a dry one.
  std::vector<std::string> warnings;
  /// `read` is what it took to get the planes: from files, or by drawing them.
  double read_seconds = 0, run_seconds = 0, write_seconds = 0;
  /// Of OutputChoice::preview_across: the preview's very bytes where that is no wider, else it is
  /// made smaller by a whole factor.
  PreviewPixels preview = {};
};

/// Plans without reading a pixel: what would run, and why. This and the next two look at the first
/// view alone.
Plan plan_composite(const CompositeJob& job);

/// Plans and looks at the pixels: what would run where. Nothing is computed.
struct SurveyedPlan {
  Plan plan;
  Survey survey;
  Beyond beyond;
  std::vector<std::string> warnings;  ///< as CompositeReport's
  /// Of Runner::kGpu, lines: what is asked of the GPU, and of the CPU beside it. No GPU is opened.
  std::string gpu = {};
};
SurveyedPlan survey_composite(const CompositeJob& job, Executor& executor);

/// The same, and then runs it twice, by the fused runner. Nothing is written.
struct MeasuredPlan {
  SurveyedPlan surveyed;
  RunTimes times;  ///< of the second run, whose buffers are warm
};
MeasuredPlan measure_composite(const CompositeJob& job, Executor& executor);

/// Loads, plans, runs, writes. Throws Error, of several views for two that have one camera, one
/// name or other display windows, also for an output that is one of the inputs or another output
/// (job/job_files.h); nothing is left under the output's name then but what was there before.
CompositeReport composite(const CompositeJob& job, Executor& executor);

}  // namespace limpid
