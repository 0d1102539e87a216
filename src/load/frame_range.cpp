#include "limpid/load/frame_range.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "limpid/core/error.h"

namespace limpid {
namespace {

constexpr std::size_t kMostFrames = 1'000'000;
constexpr int kDigitsOfOne = 4;

[[noreturn]] void refuse(std::string_view range) {
  throw Error(
      "frames '" + std::string(range) + "': expected ranges like 1-5, 1-100x33, 10-1y3 or 1,3,7-9",
      Fault::kUsage);
}

/// A number at the beginning of `text`, taken off it.
int take_number(std::string_view& text, std::string_view range) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) refuse(range);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

void add_part(std::string_view part, std::string_view range, std::vector<int>& frames) {
  const int first = take_number(part, range);
  int last = first, step = 1;
  bool complement = false;
  if (part.starts_with('-')) {
    part.remove_prefix(1);
    last = take_number(part, range);
  }
  if (part.starts_with('x') || part.starts_with('y')) {
    complement = part.front() == 'y';
    part.remove_prefix(1);
    step = std::abs(take_number(part, range));
  }
  if (!part.empty() || step == 0) refuse(range);
  const std::int64_t count = std::abs(std::int64_t{last} - first) + 1;
  for (std::int64_t i = 0; i < count; ++i) {
    if ((i % step == 0) == complement) continue;
    if (frames.size() == kMostFrames) refuse(range);
    frames.push_back(static_cast<int>(last >= first ? first + i : first - i));
  }
}

/// A place for a number in a pattern: where it is, and how many digits it has at least.
struct Slot {
  std::size_t at, length;
  int digits;
};

std::optional<Slot> find_slot(std::string_view pattern) {
  const std::size_t at = pattern.find_first_of("#@%");
  if (at == std::string_view::npos) return std::nullopt;
  if (pattern[at] == '%') {
    const std::size_t end = pattern.find_first_not_of("0123456789", at + 1);
    if (end == std::string_view::npos || pattern[end] != 'd' || end - at > 4) {
      throw Error("'" + std::string(pattern) + "': expected %d or %04d for the frame number",
                  Fault::kUsage);
    }
    const int digits = std::atoi(std::string(pattern.substr(at + 1, end - at - 1)).c_str());
    return Slot{at, end + 1 - at, digits};
  }
  const std::size_t end = std::min(pattern.find_first_not_of("#@", at), pattern.size());
  const bool alone = pattern.substr(at, end - at) == "#";
  return Slot{at, end - at, alone ? kDigitsOfOne : static_cast<int>(end - at)};
}

}  // namespace

std::vector<int> frames_of(std::string_view range) {
  std::vector<int> frames;
  std::string_view rest = range;
  while (true) {
    const std::size_t comma = rest.find(',');
    add_part(rest.substr(0, comma), range, frames);
    if (comma == std::string_view::npos) return frames;
    rest.remove_prefix(comma + 1);
  }
}

std::string name_of_frame(std::string_view pattern, int frame) {
  const std::optional<Slot> slot = find_slot(pattern);
  if (!slot) return std::string(pattern);
  std::string number = std::to_string(std::abs(frame));
  while (static_cast<int>(number.size()) < slot->digits) number.insert(0, "0");
  if (frame < 0) number.insert(0, "-");
  return std::string(pattern.substr(0, slot->at)) + number +
         std::string(pattern.substr(slot->at + slot->length));
}

bool has_frame_number(std::string_view pattern) { return find_slot(pattern).has_value(); }

}  // namespace limpid
