#include "progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <unistd.h>

#include "notes.h"

namespace limpid::tool {
namespace {

/// "1:05", "2:00:03".
std::string clock_text(double seconds) {
  const auto whole = std::llround(seconds);
  char text[48];
  if (whole < 3600) {
    std::snprintf(text, sizeof text, "%lld:%02lld", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60,
                  whole % 60);
  }
  return text;
}

/// The sentence without its numbers and its advice (after ";"), which differ from frame to frame.
std::string kind_of(std::string sentence) {
  sentence.resize(std::min(sentence.find(';'), sentence.size()));
  std::erase_if(sentence, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
  return sentence;
}

}  // namespace

std::string progress_text(const SequenceProgress& progress) {
  char rate[48];
  std::snprintf(rate, sizeof rate, "%.3g", progress.frames_per_second());
  std::string text = std::to_string(progress.done) + "/" + std::to_string(progress.total) +
                     " frames, " + rate + " a second, ";
  return text + (progress.done < progress.total ? clock_text(progress.seconds_left()) + " left"
                                                : clock_text(progress.seconds) + " in all");
}

Progress::Progress(const CommonArguments& common)
    : quiet_(common.quiet),
      live_(!quiet_ && ::isatty(STDERR_FILENO) == 1),
      lines_(!quiet_ && (common.verbose || !live_ || ::isatty(STDOUT_FILENO) == 0)) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\n", stderr);
}

void Progress::warn(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) {
    const std::string kind = kind_of(sentence);
    if (std::find(warned_.begin(), warned_.end(), kind) != warned_.end()) continue;
    warned_.push_back(kind);
    if (drawn_) std::fputs("\r\033[K", stderr);
    drawn_ = false;
    tell_warnings({sentence}, quiet_);
  }
}

void Progress::frame_done(const SequenceProgress& progress, const std::string& line,
                          const std::string& notes, bool news) {
  if (quiet_) return;
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
  if (lines_ || news) std::fputs(line.c_str(), stdout);
  if (notes != notes_) std::fputs(notes.c_str(), stdout);
  std::fflush(stdout);
  notes_ = notes;
  if (!live_) return;
  std::fputs(progress_text(progress).c_str(), stderr);
  drawn_ = true;
}

}  // namespace limpid::tool
