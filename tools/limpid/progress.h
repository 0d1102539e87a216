#pragma once
#include <string>
#include <vector>

#include "limpid/job/sequence.h"

#include "arguments.h"

namespace limpid::tool {

/// "12/240 frames, 1.92 a second, 1:59 left".
std::string progress_text(const SequenceProgress& progress);

/// How a sequence shows that it moves: on a terminal (stderr) a line that is kept up to date; else
/// a line a frame on stdout. Nothing where nothing is to be printed.
class Progress {
 public:
  explicit Progress(const CommonArguments& common);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Tells on stderr what has not been told of a frame before.
  void warn(const std::vector<std::string>& sentences);

  /// `line` tells of the frame alone; it is left out on a terminal unless it is `news`. `notes` are
  /// shown when they are not those of the frame before.
  void frame_done(const SequenceProgress& progress, const std::string& line,
                  const std::string& notes = {}, bool news = false);

 private:
  bool quiet_, live_, lines_;
  bool drawn_ = false;  ///< the line on the terminal is not ended yet
  std::string notes_;
  std::vector<std::string> warned_;  ///< sentences without their numbers
};

}  // namespace limpid::tool
