#pragma once
#include <string>
#include <vector>

namespace limpid {

/// What of a file is not drawn as the file says, for Model::warnings: one line a sentence, however
/// often it is said.
class ModelWarnings {
 public:
  /// `place` is where in the file, as in "meshes[2] 'rock'". Of many places the first few are kept,
  /// and one said again at once counts once.
  void add(const std::string& sentence, const std::string& place = "");

  /// As in "points are not drawn: meshes[2] 'rock', meshes[7] and 3 more"; kMost lines at most,
  /// the last of which says how many there were beyond.
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
