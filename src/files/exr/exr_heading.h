#pragma once
#include <optional>
#include <string>

#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfHeader.h>

#include "limpid/files/exr/exr_heading.h"

namespace limpid {

struct Compression {
  Imf::Compression method;
  std::optional<double> level;
};

/// Parses "zip", "dwaa:45" and so on. Throws Error of Fault::kUsage, with the nearest name.
Compression compression_named(const std::string& text);

/// Throws Error (without the path) for windows, aspect ratios and attribute names that cannot be
/// written.
void check_heading(const ExrHeading& heading);

/// The header without channels and file hash. Throws Error (without the path) for an inherited
/// attribute whose type differs from OpenEXR's type for its name.
Imf::Header header_of(const ExrHeading& heading, const Compression& compression);

/// Reserves the hash of the file (files/file_hash.h): in one header of each file.
void add_file_hash(Imf::Header& header);

}  // namespace limpid
