#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// How the frames of a farm are split into tasks.

namespace limpid {

/// The frames of one task, in their order.
using Chunk = std::vector<int>;

/// Planned seconds of a task: long compared to a scheduler's overhead, short compared to the loss
/// if its node fails.
inline constexpr double kTaskSeconds = 120;
/// Keeps a chunk within one word of a command line.
inline constexpr int kMaxFramesATask = 10'000;

/// Frames per task of about kTaskSeconds, 1 ... kMaxFramesATask, for at most `most_tasks` tasks of
/// about equal length. Throws Error if even kMaxFramesATask is too few.
int frames_a_task(double seconds_a_frame, std::size_t frames, std::size_t most_tasks);

/// Chunks of that size; the last may be shorter.
std::vector<Chunk> chunks_of(const std::vector<int>& frames, int size);

/// "3,5,7", the syntax of --frames.
std::string frames_text(const std::vector<int>& frames);

/// A file of chunks: line N has the frames of task N, in the syntax of --frames.
std::string chunks_text(const std::vector<Chunk>& chunks);
/// Throws Error, which names the line, for a line that frames_of() (files/text/frame_range.h)
/// refuses.
std::vector<Chunk> chunks_in(std::string_view text);

}  // namespace limpid
