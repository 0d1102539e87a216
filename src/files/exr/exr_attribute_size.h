#pragma once
#include <string>

#include "limpid/files/exr/exr_file.h"

namespace limpid {

/// Throws Error unless the attribute has the size of its type in OpenEXR. For most types OpenEXR
/// reads a fixed number of bytes and ignores the stored size: it would read the rest of a longer
/// attribute as the next attribute, and then allocate unchecked sizes. Types unknown to OpenEXR may
/// have any size.
void check_attribute_size(const std::string& name, const ExrFile::Attribute& attribute);

}  // namespace limpid
