#pragma once
#include <vector>

#include "files/exr/exr_header.h"

namespace limpid {

/// Number of samples that each chunk of a deep part claims to hold, in the order of its table
/// (tiled: of level 0). `stream` is at the tables of chunks, that of the first part. Reads only the
/// chunks' own headers. Throws Error (without the path) if a chunk is missing, extends beyond the
/// file's end or claims more than its bytes can hold, and for more samples than the limit.
std::vector<std::int64_t> deep_chunk_samples(FileStream& stream,
                                             const std::vector<ExrHeader>& headers, int part,
                                             const Limits& limits);

/// The pixels of a chunk.
Rect deep_chunk_window(const ExrHeader& header, std::int64_t chunk);

}  // namespace limpid
