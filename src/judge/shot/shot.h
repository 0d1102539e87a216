#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limpid/complete/beyond.h"
#include "limpid/core/executor.h"
#include "limpid/job/composite.h"

#include "judge/report/report.h"

/// What `limpid report PLATE...` measures of one plate and one look, for people who judge the shot:
/// its pictures, what looks beyond the frame, and speed and error of its operators and of other
/// looks.

namespace limpid {

/// The picture with the water as it really is, path-traced or filmed.
struct ShotTruth {
  std::string name;            ///< of its file
  Size display;                ///< of its display window
  std::array<Plane, 3> color;  ///< scene-linear
};

struct ShotOptions {
  /// Plate, scene and look. Of its output the samples and the instruction set count, and `runner`
  /// must be the fused one.
  CompositeJob job;
  std::vector<Look> others;  ///< that the look is compared with; those that equal it are left out
  std::optional<ShotTruth> truth = {};
  int rounds = 5;   ///< timed runs, in turn; the best counts
  int threads = 0;  ///< that the executor was asked for; 0: one a core
  /// Told one line a measurement; may be empty.
  std::function<void(const std::string&)> progress = {};
};

/// Of a picture beside the one that judges it, red, green and blue, scene-linear, values above 4
/// counted as 4 but for FLIP. NaN where there is no pixel to judge.
struct ShotError {
  PixelError pixels;
  double rmse = 0;
  double relative_wet = 0;  ///< mean |picture - judge| over mean judge, of the wet pixels
  double ssim = std::numeric_limits<double>::quiet_NaN();  ///< NaN for pictures below 11x11
  double flip = 0;
};

/// A picture of the page, a file of its own beside it.
struct ShotPicture {
  std::string file, name, about;
  std::string group;  ///< "pictures", "aovs", "without" or "differences"
  /// What the ends of its color ramp stand for, or darkest and brightest; none for light, and for
  /// differences, whose ramp is that of all (kHeatDecades).
  std::optional<std::array<double, 2>> scale = {};
};

/// A look on the plate; the dry plate itself, whose time is NaN.
struct ShotLook {
  std::string name;
  std::string picture;               ///< its file
  double milliseconds = 0;           ///< by the clock, on all threads, reading apart
  ShotError error;                   ///< beside the shot's picture
  std::optional<ShotError> truth;    ///< beside the truth
  std::vector<std::string> differs;  ///< what it leaves out or does by another model
};

/// An operator of the chain.
struct ShotOperator {
  std::string name, planned;        ///< and what the planner says of it
  bool runs = false;                ///< what follows is of those that do
  double milliseconds = 0;          ///< in the whole chain, of all threads together
  double without_milliseconds = 0;  ///< of the chain without it, by the clock
  std::vector<std::string> falls;   ///< what else does not run without it
  std::string picture, difference;  ///< files: without it, and where that differs
  ShotError error;                  ///< of the picture without it, beside the shot's
  std::optional<ShotError> truth;   ///< and beside the truth
};

/// All that was measured. A value; its pictures were handed out as they were made.
struct Shot {
  std::string made;  ///< UTC, ISO 8601
  ReportMachine machine;
  ReportBuild build;
  std::vector<std::string> files;  ///< of the plate
  std::string scene, look, truth;  ///< names; "" where there is none
  Size size;
  double time = 0;  ///< s, of the scene
  int rounds = 0, threads = 0, samples = 1;
  std::string simd;
  double wet_share = 0;  ///< of all pixels
  /// Share of what was looked up that is real: its mean, and how many pixels have less than half,
  /// of the wet ones.
  double confidence_mean = 0, guessed_share = 0;
  Beyond beyond;
  std::vector<std::string> warnings;
  double rest_milliseconds = 0;  ///< of all threads: loading, starting and storing pixels
  ShotLook dry;
  std::vector<ShotLook> looks;  ///< the shot's own first
  /// The look fast beside the look physical, where both are there: its error, and the share of the
  /// time that it takes.
  std::optional<ShotError> fast_error;
  double fast_time_share = 0;
  /// Of the whole chain, in the same rounds as the chains without an operator.
  double chain_milliseconds = 0;
  std::vector<ShotOperator> operators;
  std::vector<ShotPicture> pictures;
};

/// Takes a file's bytes.
using PictureSink = std::function<void(const ShotPicture& picture, const std::string& png)>;

/// A shot whose plate is opened and whose truth fits, ready to be measured.
class ShotMeasurement {
 public:
  /// Throws Error for what is wrong with plate, scene or look, for a truth of another size than the
  /// plate, and for options that mean nothing. The executor must outlive it.
  ShotMeasurement(ShotOptions options, Executor& executor);
  ~ShotMeasurement();

  std::size_t others() const;  ///< looks that it is compared with, at most
  /// Measures; each picture goes to the sink when it is made.
  Shot measure(const PictureSink& sink);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Measures into the folder, which is made if need be: the pictures, report.json and index.html,
/// one page that needs nothing else than the pictures; all of them or none. Throws Error, before
/// anything is measured for a folder that cannot be written to. Returns Shot::warnings.
std::vector<std::string> write_shot(const std::filesystem::path& folder,
                                    ShotMeasurement& measurement);

/// All names that a file of such a page may have, where the look is compared with so many others.
std::vector<std::string> shot_file_names(std::size_t others);

}  // namespace limpid
