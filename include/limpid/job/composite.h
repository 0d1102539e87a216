#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limpid/complete/off_frame.h"
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

/// The job of `limpid composite`, from files to files.
struct CompositeJob {
  PlateRequest plate;
  SceneFile scene;
  std::optional<DepthKind> depth_kind;  ///< instead of the scene's
  std::optional<double> depth_nothing;  ///< instead of the scene's
  /// The working space, instead of that of the scene, else of the plate, else Rec.709. The output
  /// file records it.
  std::optional<Primaries> primaries = {};
  JobTime time;
  Look look;

  /// The next or the previous frame. Its camera, water plane and waves give the vectors of
  /// OutputChoice::motion and motion_reflected, as for a static scene, instead of the vectors of
  /// the plate. Its plate has the display window of this frame's plate, and may be missing if
  /// `scene` has the camera and the water. Both cameras must be above the calm water.
  struct SecondFrame {
    PlateRequest plate;
    SceneFile scene;
    JobTime time = {};
    bool is_previous = false;
  };
  std::optional<SecondFrame> second = {};

  /// The views of stereo plates besides that of `plate`, each with its own camera. All views are
  /// written into one file, each as a part with the name of the view; the view of `plate` is the
  /// first.
  struct View {
    std::string name;
    PlateRequest plate;
    SceneFile scene;
    std::optional<SecondFrame> second = {};
  };
  std::string view_name = {};  ///< of `plate`, if there are other views
  std::vector<View> other_views = {};

  OutputChoice output;
};

/// The pixels of a preview, in memory.
struct PreviewPixels {
  Size size;
  std::vector<std::uint8_t> rgb;  ///< rows from the top
};

/// The results of a job, for the line that the tool prints.
struct CompositeReport {
  Plan plan;  ///< of the first view
  Size size;
  /// Layers of the plates that feed no role and, since OutputChoice::pass_through is empty, are not
  /// in the output file.
  std::vector<std::string> left_out = {};
  SanitiseCounts replaced;
  /// Sentences on requests without an effect on the picture: Plan::warnings, primaries that the
  /// plate contradicts, layers that are named but not read, and a picture without a wet pixel or
  /// without a dry one.
  std::vector<std::string> warnings;
  /// `read_seconds` is the time to read the planes from files, or to render them.
  double read_seconds = 0, run_seconds = 0, write_seconds = 0;
  /// The preview for OutputChoice::preview_across: with the bytes of the preview file if the
  /// picture is not wider, else reduced by a whole factor.
  PreviewPixels preview = {};
};

/// Plans without reading pixels: the operators that would run, and the reasons. This function and
/// the next two plan the first view only.
Plan plan_composite(const CompositeJob& job);

/// Plans and surveys the pixels: the operators that would run in each cell. Computes no picture.
struct SurveyedPlan {
  Plan plan;
  Survey survey;
  OffFrameLookups off_frame;
  std::vector<std::string> warnings;  ///< as CompositeReport's
  /// For Runner::kGpu, lines on the work of the GPU and of the CPU. No GPU is opened.
  std::string gpu = {};
};
SurveyedPlan survey_composite(const CompositeJob& job, Executor& executor);

/// The same, and then runs the plan twice, by the fused runner. Writes nothing.
struct MeasuredPlan {
  SurveyedPlan surveyed;
  RunTimes times;  ///< of the second run, whose buffers are warm
};
MeasuredPlan measure_composite(const CompositeJob& job, Executor& executor);

/// Loads, plans, runs, writes. Throws Error as the steps do; for two views with the same camera,
/// the same name or different display windows; and for an output that is also an input or another
/// output (job/job_files.h). After an Error the files under the names of the outputs are unchanged.
CompositeReport composite(const CompositeJob& job, Executor& executor);

}  // namespace limpid
