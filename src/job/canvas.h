#pragma once
#include <optional>
#include <vector>

#include "limpid/core/executor.h"
#include "limpid/files/exr/deep_writer.h"
#include "limpid/files/exr/exr_writer.h"
#include "limpid/gpu/gpu_runner.h"
#include "limpid/job/output.h"
#include "limpid/plan/plan.h"
#include "limpid/run/fused.h"
#include "limpid/run/target.h"

#include "job/deep_output.h"

namespace limpid {

/// The AOVs to compute: the requested AOVs, and those from which a deep file or a contact sheet is
/// made.
std::vector<Aov> computed_aovs(const OutputChoice& choice);

/// Throws the Error with which writing would end, before the work is done: for a folder that is
/// missing or not writable, AOVs that are named twice, impossible samples, and an unknown display.
void expect_writable(const OutputChoice& choice);
void expect_writable(const std::filesystem::path& file);
void expect_preview_writable(const std::filesystem::path& file);
void expect_display(const DisplayChoice& display);

/// The picture and the AOVs of an output in memory, with their names in the file.
class Canvas {
 public:
  Canvas(Rect window, const OutputChoice& choice);

  /// Whether a new canvas made from these would be equal.
  bool fits(Rect window, const OutputChoice& choice) const;

  /// Runs the plan on the frame, by the chosen runner. The plan must make what computed_aovs()
  /// show.
  /// `times` is filled by the fused runner, if it is there. Throws Stopped once a stop is
  /// requested: the fused runner asks between tiles, the others before each part of the pixels.
  void paint(const Plan& plan, const Frame& frame, const Scene& scene, const OutputChoice& choice,
             Executor& executor, RunTimes* times = nullptr, const std::stop_token& stop = {});

  /// Survey of the last frame that the fused runner has painted.
  const Survey& survey() const { return runner_.survey(); }

  /// The same picture with each n x n block of pixels reduced to a pixel: lights and shares to
  /// their mean, depths and normals to the sample nearest to the middle (the upper left of the
  /// four, for an even n). Without the AOVs of a deep file: its samples have no mean.
  Canvas filtered(int n, const OutputChoice& choice) const;

  /// write_frame() for this picture only; `described` has windows and attributes.
  void write(ExrOutput described, const OutputChoice& choice) const;

  const Target& target() const { return target_; }

  Rect window() const { return window_; }
  const std::vector<ExrOutputChannel>& channels() const { return channels_; }
  DeepWater deep_water(const ExrHeading& heading, const OutputChoice& choice) const;

 private:
  /// Adds the picture as the last of `count` samples, and shows their mean.
  void take_mean(int count, Executor& executor);
  View<float> add();
  View<float> add(const std::string& name, bool half);

  struct Made {
    std::vector<Aov> written, computed;
    AovNames names;
    bool store_float;
    bool operator==(const Made&) const = default;
  };

  Rect window_;
  Made made_;
  std::vector<Plane> planes_;
  std::vector<ExrOutputChannel> channels_;
  std::vector<Plane> means_;  ///< of the samples
  Target target_;
  FusedRunner runner_;
  std::optional<GpuRunner> gpu_;  ///< made for the first frame that it paints
  WaterExtent extent_;            ///< of the painted frame, for a deep file
};

/// One view of a file.
struct WrittenView {
  const Canvas* canvas;
  ExrOutput described;                 ///< windows, attributes, channels besides the canvas's
  std::vector<ExrOutput> others = {};  ///< parts beside the picture's
  std::string view = {};               ///< its name, if there are several
  Primaries primaries = kRec709;       ///< of its colors
};

/// Writes preview and deep file, of the first view, and the picture, of all views; the preview gets
/// the texts of `described`. The picture is written last: if anything fails, the former file of
/// that name remains.
void write_frame(std::vector<WrittenView> views, const OutputChoice& choice);

/// The canvas in `kept`, if it fits, or a new one in its place.
Canvas& canvas_for(std::optional<Canvas>& kept, Rect window, const OutputChoice& choice);

}  // namespace limpid
