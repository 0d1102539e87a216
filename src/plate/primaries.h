#pragma once
#include <map>
#include <string>

#include "limpid/files/exr/exr_file.h"

namespace limpid {

/// What the attribute `chromaticities` says that red, green and blue are, where that is not
/// Rec.709: the name of a known space, as "ACEScg (AP1)", else the numbers. "" for Rec.709, which
/// goes unsaid, too. Known is what agrees to within 0.001.
std::string other_primaries(const std::map<std::string, ExrFile::Attribute>& attributes);

}  // namespace limpid
