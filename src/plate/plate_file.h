#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "limpid/files/exr/exr_file.h"
#include "limpid/files/limits.h"
#include "limpid/files/picture/image_file.h"

namespace limpid {

/// A picture file of any format through one interface: parts, and channels that decode into views.
/// A picture other than EXR is read when it is opened, its color multiplied by straight alpha.
struct PlateFile {
  std::filesystem::path path;
  std::optional<ExrFile> exr;
  std::optional<ImageFile> image;
  std::vector<ExrPart> parts;

  static PlateFile open(const std::filesystem::path& path, const Limits& limits);
  void read(std::span<const ExrRequest> requests) const;
  /// limpid's record of how the file was made: texts whose names begin with "limpid/". Throws
  /// Error.
  std::map<std::string, std::string> made() const;
  /// The working space that its first part names, "" for none; or a sentence about an invalid one.
  std::string color_space() const;
  /// As ExrFile::content_hash().
  std::string content_hash() const;
};

}  // namespace limpid
