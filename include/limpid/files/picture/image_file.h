#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "limpid/core/plane.h"
#include "limpid/files/limits.h"

namespace limpid {

/// A picture of another format than EXR (PNG, TIFF, DPX, HDR, JPEG ...), as float planes: integers
/// of n bits are divided by 2^n - 1, no transfer curve is applied or removed, and color and alpha
/// stay as stored.
struct ImageFile {
  Rect window;
  std::vector<std::string> channels;  ///< "R", "G", "B", "A", ...
  std::vector<Plane> planes;
  bool straight_alpha = false;  ///< color is not multiplied by "A", as in all PNGs with alpha
};

/// PNG and JPEG, recognised by their first bytes, are read by libpng and libjpeg-turbo; all other
/// formats through OpenImageIO, which is loaded at the first of them (in 0.2 s, with 135 MB).
/// Throws Error for a file that is missing, damaged or over a limit, and if the format module is
/// needed and is not installed or lacks memory: loading it needs 112 MB (32 MB of them for stacks)
/// and, under `ulimit -v`, 448 MiB of address space.
ImageFile read_image(const std::filesystem::path& path, const Limits& limits = {});

/// Writes 8-bit RGB or RGBA (3 or 4 planes of one window, values 0 ... 1, already encoded for
/// display, alpha straight; clamped and rounded, NaN becomes 0) in the format of the path's
/// extension: .png, .jpg (no alpha), .tif. The file is written under a temporary name and renamed
/// at the end; its bytes depend only on the arguments. A PNG also has the texts, by their names, as
/// iTXt chunks, at most 1 MiB; other formats ignore them.
void write_image8(const std::filesystem::path& path, const std::vector<View<const float>>& planes,
                  const std::map<std::string, std::string>& texts = {});

/// Throws the Error that write_image8() would throw for any pixels: for an unknown extension, or
/// for a TIFF without the format module.
void expect_image8(const std::filesystem::path& path);

/// Whether the path's extension is that of a PNG (any case).
bool is_png(const std::filesystem::path& path);

/// The records of a PNG on how it was made: the texts of write_image8() whose names begin with
/// "limpid/". Throws Error for a file that cannot be read, is truncated or damaged, or has more
/// than 1 MiB of texts.
std::map<std::string, std::string> read_image_texts(const std::filesystem::path& path);

/// Whether the path's extension is .exr (any case).
bool is_exr(const std::filesystem::path& path);

/// Whether ExrFile reads the file instead: its first bytes are those of an EXR, or its extension is
/// .exr. Opens the file if it has another extension.
bool holds_exr(const std::filesystem::path& path);

}  // namespace limpid
