#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// How the frames of a farm are cut into tasks.

namespace limpid {

/// The frames of one task, in the order in which they are made.
using Chunk = std::vector<int>;

/// What a task should take: long beside what a scheduler needs to start it, short beside what is
/// lost when its node is.
inline constexpr double kTaskSeconds = 120;
/// So that a chunk fits into one word of a command line.
inline constexpr int kMaxFramesATask = 10'000;

/// How many frames a task of about kTaskSeconds has, 1 ... kMaxFramesATask, for at most so many
/// tasks, all of them about as long. Throws Error where not even kMaxFramesATask is enough.
int frames_a_task(double seconds_a_frame, std::size_t frames, std::size_t most_tasks);

/// Chunks of that size; the last may be shorter.
std::vector<Chunk> chunks_of(const std::vector<int>& frames, int size);

/// "3,5,7", as --frames takes it.
std::string frames_text(const std::vector<int>& frames);

/// A file of chunks: task N makes the frames on line N, each line as --frames takes it.
std::string chunks_text(const std::vector<Chunk>& chunks);
/// Throws Error, which names the line, for what frames_of() (files/text/frame_range.h) does not
/// read.
std::vector<Chunk> chunks_in(std::string_view text);

}  // namespace limpid
