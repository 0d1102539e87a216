#pragma once
#include <array>
#include <cstdint>

#include "limpid/files/picture/display.h"
#include "limpid/files/picture/image_file.h"
#include "limpid/files/picture/preview.h"

#include "files/atomic_file.h"

namespace limpid {

/// As without `files`, but the picture appears when those are committed.
void write_image8(AtomicFiles& files, const std::filesystem::path& path,
                  const std::vector<View<const float>>& planes,
                  const std::map<std::string, std::string>& texts);
/// The same for bytes, interleaved without padding, of 3 or 4 channels.
void write_image8(AtomicFiles& files, const std::filesystem::path& path, Size size, int channels,
                  const std::uint8_t* pixels, const std::map<std::string, std::string>& texts);
void write_preview(AtomicFiles& files, const std::filesystem::path& path,
                   const std::array<View<const float>, 3>& light, const DisplayTransform& display,
                   const std::map<std::string, std::string>& texts);

}  // namespace limpid
