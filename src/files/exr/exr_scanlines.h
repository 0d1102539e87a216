#pragma once
#include <span>

#include <OpenEXR/ImfMultiPartInputFile.h>

#include "files/exr/exr_header.h"

namespace limpid {

/// Decodes channels of a part that ExrUnpacker supports, on up to `workers` of OpenEXR's threads
/// (0: on the calling thread). The requests are valid. Throws as ExrFile::read() does, without the
/// path.
void read_scanlines(Imf::MultiPartInputFile& file, const ExrHeader& header,
                    std::span<const ExrRequest> requests, int workers);

}  // namespace limpid
