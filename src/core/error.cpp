#include "limpid/core/error.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace limpid {
namespace {

std::size_t difference(std::size_t a, std::size_t b) { return a > b ? a - b : b - a; }

/// Number of deletions, insertions, replacements and swaps of neighbouring letters.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), row(before), next(before);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    next[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      next[j + 1] = std::min({row[j + 1] + 1, next[j] + 1, row[j] + (a[i] != b[j])});
      const bool swapped = i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j];
      if (swapped) next[j + 1] = std::min(next[j + 1], before[j - 1] + 1);
    }
    std::swap(before, row);
    std::swap(row, next);
  }
  return row.back();
}

}  // namespace

Error no_memory(const std::string& name) {
  return Error((name.empty() ? "" : name + ": ") + std::string(kNeedsMemory), Fault::kMemory);
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = word.size();
  for (const std::string& name : known) {
    const std::size_t tolerated = std::max<std::size_t>(1, std::max(word.size(), name.size()) / 3);
    if (difference(word.size(), name.size()) > tolerated) continue;
    const std::size_t distance = edit_distance(word, name);
    if (distance <= tolerated && distance < best_distance) {
      best = name;
      best_distance = distance;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::string name = nearest_name(word, known);
  return name.empty() ? "" : "; did you mean '" + name + "'?";
}

std::string join(const std::vector<std::string>& words, std::string_view separator) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += separator;
    text += word;
  }
  return text;
}

}  // namespace limpid
