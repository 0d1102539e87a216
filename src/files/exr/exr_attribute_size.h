#pragma once
#include <string>

#include "limpid/files/exr/exr_file.h"

namespace limpid {

/// Throws Error unless the attribute has as many bytes as its type has in OpenEXR, which for most
/// types reads their own number of bytes whatever the file says: it would take the rest of a longer
/// one for the next attribute, and then memory for sizes that nobody has checked. Types that are
/// not OpenEXR's may have any size.
void check_attribute_size(const std::string& name, const ExrFile::Attribute& attribute);

}  // namespace limpid
