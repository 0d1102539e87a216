#include "limpid/files/text/frame_range.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>

#include "limpid/core/error.h"

namespace limpid {
namespace {

constexpr int kMaxNumber = std::numeric_limits<int>::max();
constexpr int kDigitsOfOne = 4;

[[noreturn]] void refuse(std::string_view range) {
  throw Error(
      "frames '" + std::string(range) + "': expected ranges like 1-5, 1-100x33, 10-1y3 or 1,3,7-9",
      Fault::kUsage);
}

/// Removes a number from the beginning of `text`.
int take_number(std::string_view& text, std::string_view range) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::result_out_of_range || number < -kMaxNumber) {
    throw Error("frames '" + std::string(range) + "': " + std::string(text.data(), end) +
                    ": expected numbers -" + std::to_string(kMaxNumber) + " ... " +
                    std::to_string(kMaxNumber),
                Fault::kUsage);
  }
  if (error != std::errc()) refuse(range);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

/// Frames from `first` towards `last`: each `step`-th, or all others.
struct Part {
  int first = 0, last = 0, step = 1;
  bool complement = false;

  std::int64_t span() const { return std::abs(std::int64_t{last} - first) + 1; }
  std::int64_t count() const {
    const std::int64_t stepped = (span() - 1) / step + 1;
    return complement ? span() - stepped : stepped;
  }
  void add_to(std::vector<int>& frames) const {
    for (std::int64_t i = 0; i < span(); i += complement ? 1 : step) {
      if (complement && i % step == 0) continue;
      frames.push_back(static_cast<int>(last >= first ? first + i : first - i));
    }
  }
};

Part part_of(std::string_view part, std::string_view range) {
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
  return {first, last, step, complement};
}

/// The place of a frame number in a pattern, and its least number of digits.
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
  std::vector<Part> parts;
  std::int64_t count = 0;
  for (std::string_view rest = range;;) {
    const std::size_t comma = rest.find(',');
    parts.push_back(part_of(rest.substr(0, comma), range));
    count += parts.back().count();
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (count == 0) refuse(range);
  if (count > kMaxFrames) {
    throw Error("frames '" + std::string(range) + "' are " + std::to_string(count) +
                    ": expected at most " + std::to_string(kMaxFrames),
                Fault::kUsage);
  }
  std::vector<int> frames;
  frames.reserve(static_cast<std::size_t>(count));
  for (const Part& part : parts) part.add_to(frames);
  return frames;
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
