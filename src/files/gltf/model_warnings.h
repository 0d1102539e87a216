#pragma once
#include <string>
#include <vector>

namespace limpid {

/// Parts of a file that are not drawn as the file says, for Model::warnings: one line per sentence,
/// for any number of places.
class ModelWarnings {
 public:
  /// `place` is the place in the file, as in "meshes[2] 'rock'". The first few of many places are
  /// kept; consecutive repetitions count once.
  void add(const std::string& sentence, const std::string& place = "");

  /// As in "points are not drawn: meshes[2] 'rock', meshes[7] and 3 more"; at most kMost lines, the
  /// last of which gives the number of the others.
  std::vector<std::string> lines() const;

  static constexpr std::size_t kMost = 100;

 private:
  struct Line {
    std::string sentence, places, last;
    std::size_t count = 0;  // of places
  };
  std::vector<Line> lines_;
  std::size_t beyond_ = 0;
};

}  // namespace limpid
