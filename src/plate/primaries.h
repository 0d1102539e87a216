#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "limpid/core/color_space.h"
#include "limpid/files/exr/exr_file.h"

namespace limpid {

using Attributes = std::map<std::string, ExrFile::Attribute>;

/// The working space in a part's attributes: by `chromaticities`, else by a known name
/// (find_color_space()) in `colorInteropID` or `oiio:ColorSpace`. Nothing if there is neither.
/// Throws Error for invalid chromaticities (Primaries::validate()).
std::optional<Primaries> told_primaries(const Attributes& attributes);

/// The same of the first part of a file; nothing of one that is no EXR. Throws Error that begins
/// with the path.
std::optional<Primaries> told_primaries(const std::filesystem::path& path);

/// Makes the attributes of a picture in that space tell so: those of a plate that tell the same
/// stay as they are.
void tell_primaries(Attributes& attributes, const Primaries& primaries);

}  // namespace limpid
