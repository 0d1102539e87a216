#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "limpid/core/rect.h"

namespace limpid {

inline constexpr int kLeastReportSide = 16, kMaxReportSide = 8192, kMaxRounds = 1000;

/// Inputs of `limpid report`: the looks, scenes and plates of a data folder.
struct ReportOptions {
  std::filesystem::path data;  ///< with looks, scenes, plates and maps
  /// Of rendered scenes. Of plates every n-th pixel is taken, with the largest n that divides their
  /// size and leaves at least twice this size; the truth plate is taken whole.
  Size size{480, 270};
  /// Timed runs visit all rows in turn; the best counts. The reference gets at most two.
  int rounds = 5;
  int threads = 0;  ///< of the rows that run on several; 0: one per core
  /// A GPU to be measured, too: a part of its name; "" for the first hardware GPU, if there is one.
  std::string gpu = {};
  /// Called with one line per measurement; may be empty.
  std::function<void(const std::string&)> progress = {};

  /// Throws Error of Fault::kUsage for an invalid size or number of rounds.
  void validate() const;
};

/// Error of a picture: |picture - judge| over all values of red, green and blue, scene-linear,
/// white = 1.
struct PixelError {
  double mean = 0, p99 = 0, p99_99 = 0, max = 0;
};

/// A plate or a scene to be composited with water.
struct ReportSubject {
  std::string name, kind, file;  ///< kind: "plate" or "scene"
  Size size;
  double wet_share = 0;  ///< share of all pixels that the look physical changes
};

/// A look by a runner; judged by the same look in double.
struct RunnerRow {
  /// simd: "" for the reference; for a GPU the device, with the time from memory to memory.
  std::string subject, look, runner, simd;
  int threads = 1, rounds = 1;
  double ns_per_pixel = 0;
  PixelError error;
};

/// A look; judged by the look `physical`, both fused. Values above 4 count as 4.
struct LookRow {
  std::string subject, look;
  double ns_per_pixel = 0;
  PixelError error;
  std::vector<std::string> differs;  ///< operators that it leaves out or runs with another model
};

/// A model of refraction; judged by a path-traced picture (lagoon.h).
struct TruthRow {
  std::string choice;
  double ns_per_pixel = 0;  ///< 0 for the dry picture
  double wet = 0, in_frame = 0;
};

/// A look on a scene, or the look `physical` there with one parameter changed; judged by
/// path-traced light (judge/trace/truth.h) through the scene with the water of `physical`, one
/// sample per pixel as in the chain. Values above 4 count as 4, except for HDR-FLIP.
struct ModelRow {
  std::string subject, look;
  std::string parameter, value;  ///< both "" for an unchanged look
  double ns_per_pixel = 0;
  PixelError error;
  double rmse = 0, rel_mse = 0, ssim = 0, flip = 0, hdr_flip = 0;
  double flicker = 0;  ///< mean error of the change to the next of 24 frames per second
  /// For lookups of wet pixels (judge/compare/offset.h).
  double offset_median = 0, offset_p95 = 0;  ///< pixels
  double wrongly_rejected = 0, wrongly_accepted = 0;
};

/// A plate or a scene with a true picture, waves included: path-traced, or traced through the scene
/// (judge/trace/truth.h) with kBroughtSamples squared samples per pixel. A wet pixel is near if its
/// footprint on the calm water is shorter than the waves.
struct BroughtSubject {
  std::string subject;
  double wave_length = 0;  ///< scene units: 2 pi sqrt(mean square slope / mean square curvature)
  double wet_share = 0;    ///< of all pixels
  double near_share = 0;   ///< of the wet pixels
};
inline constexpr int kBroughtSamples = 4;

/// A look with some of the buffers that a plate may have, and no surroundings; judged by that
/// picture. Errors are mean |picture - truth| over mean truth, values above 4 counted as 4; NaN if
/// there is no pixel to judge.
struct BroughtRow {
  std::string subject, look;
  std::string brought;  ///< added to the rows before: "color, depth", then "shadow" ...
  double ns_per_pixel = 0;
  double wet = 0, near = 0, far = 0;
  double flip = 0;  ///< mean over the wet pixels
};

/// The look `physical` with one parameter changed; judged by the unchanged look. Values above 4
/// count as 4.
struct ChoiceRow {
  std::string parameter, value;  ///< both "" for the unchanged look
  double ns_per_pixel = 0;
  PixelError error;
};

/// A look with an error budget (white = 1); judged by the same look without one. Values above 4
/// count as 4. Shares of cells (plan/survey.h) are in pixels.
struct BudgetRow {
  std::string subject, water;  ///< water: the look, and its changes
  double max_error = 0;        ///< the budget, for any channel of any pixel
  double ns_per_pixel = 0;
  PixelError error;
  double bound = 0;         ///< of the operators left out
  double dry_share = 0;     ///< in cells without water
  double opaque_share = 0;  ///< in cells whose bottom is not visible
  double full_share = 0;    ///< in cells that leave out nothing
};

/// A picture in the page.
struct Figure {
  std::string name, caption;
  Size size;
  std::string jpeg;  ///< the file's bytes
};

/// Origin of the numbers; "unknown" if the system does not tell.
struct ReportMachine {
  std::string processor, system, kernel;
  int cores = 0;
  std::vector<std::string> simd;  ///< the machine's instruction sets, best first
};

struct ReportBuild {
  std::string version, compiler, type, libraries;
};

/// All results. A value: writing it needs no pixels.
struct Report {
  std::string made;  ///< UTC, ISO 8601
  ReportMachine machine;
  ReportBuild build;
  Size size;  ///< these three as in ReportOptions; threads is never 0
  int rounds = 0, threads = 0;
  std::string simd;  ///< of the rows without their own
  std::vector<ReportSubject> subjects;
  std::vector<std::string> looks;
  std::vector<RunnerRow> runners;
  std::vector<LookRow> look_rows;
  std::vector<TruthRow> truth;
  double truth_in_frame_share = 0;
  Size truth_size;
  std::vector<ModelRow> models;
  std::vector<BroughtSubject> brought_subjects;
  std::vector<BroughtRow> brought;
  std::string choices_subject;  ///< the subject of the ChoiceRows
  std::vector<ChoiceRow> choices;
  std::vector<BudgetRow> budgets;
  /// The subjects with the look physical; every look on the first subject, and its difference from
  /// physical; the truth plate dry, path-traced and by the best look, and differences from truth;
  /// the scenes traced, and the difference of physical from that; the truth plate with waves,
  /// path-traced and by physical, with one more buffer each.
  std::vector<Figure> subject_figures, look_figures, look_errors, truth_figures, truth_errors,
      model_figures, model_errors, brought_figures;
};

/// The lists of figures, and their names in report.json and the page.
struct FigureGroup {
  const char* name;
  std::vector<Figure> Report::*figures;
};
inline constexpr FigureGroup kFigureGroups[] = {
    {"subjects", &Report::subject_figures},   {"looks", &Report::look_figures},
    {"look_errors", &Report::look_errors},    {"truth", &Report::truth_figures},
    {"truth_errors", &Report::truth_errors},  {"traced", &Report::model_figures},
    {"traced_errors", &Report::model_errors}, {"brought", &Report::brought_figures},
};
/// Heat maps among the figures are logarithmic, from 10^-kHeatDecades to 1.
inline constexpr int kHeatDecades = 3;

/// Measures. Throws Error for a folder without the required data, and for invalid options.
Report measure_report(const ReportOptions& options);

/// Creates the folder if it does not exist, before anything is measured. Throws Error if it cannot
/// be created or written to, or is no folder.
void make_report_folder(const std::filesystem::path& folder);

/// Writes report.json and index.html, a self-contained page, into such a folder. Each appears
/// complete or not at all.
void write_report(const std::filesystem::path& folder, const Report& report);

}  // namespace limpid
