#pragma once
#include <filesystem>
#include <functional>

#include "files/exr/exr_streams.h"

namespace limpid {

/// An EXR file of one part that appears whole or not at all: `check` runs first, then `write` gets
/// the stream of a temporary file, which is looked at, given its hash, flushed and renamed.
/// Whatever either throws leaves as an Error that begins with the path.
void write_whole_exr(const std::filesystem::path& path, const std::function<void()>& check,
                     const std::function<void(OutputStream&)>& write);

}  // namespace limpid
