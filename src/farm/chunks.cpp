#include "farm/chunks.h"

#include <algorithm>
#include <cmath>

#include "limpid/core/error.h"
#include "limpid/files/text/frame_range.h"

namespace limpid {

int frames_a_task(double seconds_a_frame, std::size_t frames, std::size_t most_tasks) {
  const double most = kMaxFramesATask;
  const double of_time = std::clamp(kTaskSeconds / std::max(seconds_a_frame, 1e-9), 1.0, most);
  const double count = static_cast<double>(frames);
  const double tasks =
      std::min(std::ceil(count / std::floor(of_time)), static_cast<double>(most_tasks));
  const double size = std::ceil(count / std::max(tasks, 1.0));
  if (size > most) {
    throw Error(std::to_string(frames) + " frames: expected at most " +
                    std::to_string(most_tasks * kMaxFramesATask) + ", in " +
                    std::to_string(most_tasks) + " tasks",
                Fault::kUsage);
  }
  return std::max(static_cast<int>(size), 1);
}

std::vector<Chunk> chunks_of(const std::vector<int>& frames, int size) {
  std::vector<Chunk> chunks;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i % static_cast<std::size_t>(size) == 0) chunks.emplace_back();
    chunks.back().push_back(frames[i]);
  }
  return chunks;
}

std::string frames_text(const std::vector<int>& frames) {
  std::string text;
  for (const int frame : frames) text += (text.empty() ? "" : ",") + std::to_string(frame);
  return text;
}

std::string chunks_text(const std::vector<Chunk>& chunks) {
  std::string text;
  for (const Chunk& chunk : chunks) text += frames_text(chunk) + "\n";
  return text;
}

std::vector<Chunk> chunks_in(std::string_view text) {
  std::vector<Chunk> chunks;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    try {
      chunks.push_back(frames_of(text.substr(0, end)));
    } catch (const Error& error) {
      throw Error("line " + std::to_string(chunks.size() + 1) + ": " + error.what());
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return chunks;
}

}  // namespace limpid
