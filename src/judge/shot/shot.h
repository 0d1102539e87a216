#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limpid/complete/off_frame.h"
#include "limpid/core/executor.h"
#include "limpid/job/composite.h"

#include "judge/report/report.h"

/// Measurements of `limpid report PLATE...` for one plate and one look, to judge a shot: its
/// pictures, lookups beyond the frame, and speed and error of its operators and of other looks.

namespace limpid {

/// The true picture with water, path-traced or filmed.
struct ShotTruth {
  std::string name;            ///< of its file
  Size display;                ///< of its display window
  std::array<Plane, 3> color;  ///< scene-linear
};

struct ShotOptions {
  /// Plate, scene and look. From its output only the samples and the instruction set are used;
  /// `runner` must be the fused one.
  CompositeJob job;
  std::vector<Look> others;  ///< for comparison; those equal to the shot's look are left out
  std::optional<ShotTruth> truth = {};
  int rounds = 5;   ///< timed runs, in turn; the best counts
  int threads = 0;  ///< of the executor; 0: one per core
  /// Called with one line per measurement; may be empty.
  std::function<void(const std::string&)> progress = {};
};

/// Error of a picture, red, green and blue, scene-linear, values above 4 counted as 4 except for
/// FLIP. NaN if there is no pixel to judge.
struct ShotError {
  PixelError pixels;
  double rmse = 0;
  double relative_wet = 0;  ///< mean |picture - judge| over mean judge, of the wet pixels
  double ssim = std::numeric_limits<double>::quiet_NaN();  ///< NaN for pictures below 11x11
  double flip = 0;
};

/// A picture of the page, a separate file beside it.
struct ShotPicture {
  std::string file, name, about;
  std::string group;  ///< "pictures", "aovs", "without" or "differences"
  /// The values at the ends of its color ramp, or of darkest and brightest; none for light, and for
  /// differences, which share a ramp (kHeatDecades).
  std::optional<std::array<double, 2>> scale = {};
};

/// A look on the plate; or the dry plate itself, whose time is NaN.
struct ShotLook {
  std::string name;
  std::string picture;               ///< file name
  double milliseconds = 0;           ///< wall-clock time, on all threads, without reading
  ShotError error;                   ///< against the shot's picture
  std::optional<ShotError> truth;    ///< against the truth
  std::vector<std::string> differs;  ///< operators that it leaves out or runs with another model
};

/// An operator of the chain.
struct ShotOperator {
  std::string name, planned;        ///< planned: the planner's reason
  bool runs = false;                ///< the other members are for operators that run
  double milliseconds = 0;          ///< in the whole chain, sum over all threads
  double without_milliseconds = 0;  ///< of the chain without it, wall-clock time
  std::vector<std::string> falls;   ///< operators that do not run without it
  std::string picture, difference;  ///< files: without it, and the difference
  ShotError error;                  ///< of the picture without it, against the shot's
  std::optional<ShotError> truth;   ///< against the truth
};

/// All results. A value; its pictures were passed on when they were made.
struct Shot {
  std::string made;  ///< UTC, ISO 8601
  ReportMachine machine;
  ReportBuild build;
  std::vector<std::string> files;  ///< of the plate
  std::string scene, look, truth;  ///< names; "" for none
  Size size;
  double time = 0;  ///< s, of the scene
  int rounds = 0, threads = 0, samples = 1;
  std::string simd;
  double wet_share = 0;  ///< of all pixels
  /// Confirmed share of the lookups of wet pixels: its mean, and the share of pixels with less than
  /// half.
  double confidence_mean = 0, guessed_share = 0;
  OffFrameLookups off_frame;
  std::vector<std::string> warnings;
  double rest_milliseconds = 0;  ///< sum over all threads: loading, starting and storing pixels
  ShotLook dry;
  std::vector<ShotLook> looks;  ///< the shot's own first
  /// The look fast against the look physical, if both exist: its error, and its share of the time.
  std::optional<ShotError> fast_error;
  double fast_time_share = 0;
  /// Time of the whole chain, in the same rounds as the chains without an operator.
  double chain_milliseconds = 0;
  std::vector<ShotOperator> operators;
  std::vector<ShotPicture> pictures;
};

/// Receives a file's bytes.
using PictureSink = std::function<void(const ShotPicture& picture, const std::string& png)>;

/// A shot with open plate and a matching truth, ready to be measured.
class ShotMeasurement {
 public:
  /// Throws Error for errors in plate, scene or look, for a truth of another size than the plate,
  /// and for invalid options. The executor must outlive it.
  ShotMeasurement(ShotOptions options, Executor& executor);
  ~ShotMeasurement();

  std::size_t others() const;  ///< looks for comparison, at most
  /// Measures; passes each picture to the sink when it is made.
  Shot measure(const PictureSink& sink);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Measures and writes into the folder, which is created if it does not exist: the pictures,
/// report.json and index.html, a page that needs only the pictures; all files or none. Throws
/// Error, before measuring, for a folder that cannot be written to. Returns Shot::warnings.
std::vector<std::string> write_shot(const std::filesystem::path& folder,
                                    ShotMeasurement& measurement);

/// All possible file names of such a page, for this number of other looks.
std::vector<std::string> shot_file_names(std::size_t others);

}  // namespace limpid
