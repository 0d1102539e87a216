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

/// Channels that are copied from a part of another file, with names, sample types and bits; 0
/// outside of their data window. They are read while they are written, some lines at a time.
struct ExrCopy {
  const ExrFile* from = nullptr;  ///< must outlive the writing
  int part = 0;                   ///< must be flat
  std::vector<std::string> channels;
};

/// A file, or one of its parts.
struct ExrOutput : ExrHeading {
  std::string compression =
      "piz";  ///< none rle zips zip piz pxr24 b44 b44a dwaa dwab; "name:level" for dwa and zip
  std::vector<ExrOutputChannel> channels;
  std::vector<ExrCopy> copies = {};
  /// The name and the view of a part of several; names must differ. `view` becomes the attribute
  /// `view`.
  std::string name = {}, view = {};
};

/// Throws Error of Fault::kUsage, with the nearest name, for an invalid ExrOutput::compression.
void validate_compression(const std::string& compression);

/// Writes the file under a temporary name in the same folder, flushes it to disk and renames it:
/// `path` names the old file or the whole new file, never a part. On failure removes the temporary
/// file and throws Error with path and cause (Fault::kRetry if the disk is full). The file has a
/// hash of its bytes (ExrFile::is_as_written). The bytes depend only on the arguments, not on date,
/// host or threads.
void write_exr(const std::filesystem::path& path, const ExrOutput& output);
/// The same for a file with several parts, in this order. Display window, pixel aspect ratio, time
/// code and chromaticities of the first part are those of all parts.
void write_exr(const std::filesystem::path& path, std::span<const ExrOutput> parts);

}  // namespace limpid
