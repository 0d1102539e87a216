#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "limpid/core/plane.h"
#include "limpid/files/exr/exr_heading.h"

namespace limpid {

struct ExrOutputChannel {
  std::string name;
  View<const float> from;  ///< must cover the output's data window
  bool half =
      true;  ///< stored as half; finite values beyond 65504 are clamped to it, inf stays inf
};

/// Channels that are written as they lie in a part of another file: by their names, as samples of
/// their types, bit by bit; 0 outside the data window that they come from. They are read when they
/// are written, some lines at a time.
struct ExrCopy {
  const ExrFile* from = nullptr;  ///< outlives the writing
  int part = 0;                   ///< of flat pixels
  std::vector<std::string> channels;
};

/// A file, or one of its parts.
struct ExrOutput : ExrHeading {
  std::string compression =
      "piz";  ///< none rle zips zip piz pxr24 b44 b44a dwaa dwab; "name:level" for dwa and zip
  std::vector<ExrOutputChannel> channels;
  std::vector<ExrCopy> copies = {};
  /// Of a part among several, each with a name of its own; a view is told by the attribute `view`.
  std::string name = {}, view = {};
};

/// Throws Error of Fault::kUsage, with the nearest name, for what is no ExrOutput::compression.
void validate_compression(const std::string& compression);

/// Writes the file under a temporary name in the same folder, flushes it to disk and renames it:
/// under `path` there is the old file or the whole new one, never a part. On failure the temporary
/// file is removed and an Error thrown that names path and cause (Fault::kRetry where the disk is
/// full). The file carries a hash of its bytes (ExrFile::is_as_written). The bytes depend on the
/// arguments alone, not on date, host or threads.
void write_exr(const std::filesystem::path& path, const ExrOutput& output);
/// The same of a file of several parts, in this order. The first one's display window, pixel
/// aspect ratio, time code and chromaticities are those of all parts.
void write_exr(const std::filesystem::path& path, std::span<const ExrOutput> parts);

}  // namespace limpid
