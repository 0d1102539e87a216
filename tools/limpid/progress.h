#pragma once
#include <string>
#include <vector>

#include "limpid/job/sequence.h"

#include "arguments.h"

namespace limpid::tool {

/// "12/240 frames, 1.92 a second, 1:59 left".
std::string progress_text(const SequenceProgress& progress);

/// Progress of a sequence: on a terminal (stderr) a line that is updated; else a line per frame on
/// stdout. Nothing with quiet output.
class Progress {
 public:
  explicit Progress(const CommonArguments& common);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Prints warnings on stderr that no frame before has had.
  void warn(const std::vector<std::string>& sentences);

  /// `line` is about this frame; a terminal omits it unless it is `news`. `notes` are printed if
  /// they differ from those of the frame before.
  void frame_done(const SequenceProgress& progress, const std::string& line,
                  const std::string& notes = {}, bool news = false);

 private:
  bool quiet_, live_, lines_;
  bool drawn_ = false;  ///< the line on the terminal has no line end yet
  std::string notes_;
  std::vector<std::string> warned_;  ///< sentences without their numbers
};

}  // namespace limpid::tool
