#include "files/gltf/model_warnings.h"

#include <algorithm>

namespace limpid {
namespace {

constexpr std::size_t kPlaces = 4;  // per line

}  // namespace

void ModelWarnings::add(const std::string& sentence, const std::string& place) {
  auto line = std::find_if(lines_.begin(), lines_.end(),
                           [&](const Line& other) { return other.sentence == sentence; });
  if (line == lines_.end()) {
    if (lines_.size() == kMost - 1) {
      ++beyond_;
      return;
    }
    line = lines_.insert(lines_.end(), {sentence, "", "", 0});
  }
  if (place.empty() || place == line->last) return;
  line->last = place;
  if (++line->count <= kPlaces) line->places += (line->places.empty() ? "" : ", ") + place;
}

std::vector<std::string> ModelWarnings::lines() const {
  std::vector<std::string> lines;
  for (const Line& line : lines_) {
    std::string text = line.sentence;
    if (line.count > 0) text += ": " + line.places;
    if (line.count > kPlaces) text += " and " + std::to_string(line.count - kPlaces) + " more";
    lines.push_back(text);
  }
  if (beyond_ > 0) lines.push_back("and " + std::to_string(beyond_) + " more warnings");
  return lines;
}

}  // namespace limpid
