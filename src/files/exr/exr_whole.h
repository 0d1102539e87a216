#pragma once
#include <filesystem>
#include <functional>
#include <span>

#include "limpid/files/exr/deep_writer.h"
#include "limpid/files/exr/exr_writer.h"

#include "files/atomic_file.h"
#include "files/exr/exr_streams.h"

namespace limpid {

/// Adds an EXR file of scan lines: `check` runs first, then `write` gets the stream of a temporary
/// file, which is checked and given its hash. Any exception is rethrown as an Error that begins
/// with the path.
void write_whole_exr(AtomicFiles& files, const std::filesystem::path& path,
                     const std::function<void()>& check,
                     const std::function<void(OutputStream&)>& write);

/// As without `files`, but the file appears when those are committed.
void write_exr(AtomicFiles& files, const std::filesystem::path& path,
               std::span<const ExrOutput> parts);
inline void write_exr(AtomicFiles& files, const std::filesystem::path& path,
                      const ExrOutput& output) {
  write_exr(files, path, {&output, 1});
}
void write_deep_water(AtomicFiles& files, const std::filesystem::path& path,
                      const DeepWater& water);

}  // namespace limpid
