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
/// are as the file stores them.
struct ImageFile {
  Rect window;
  std::vector<std::string> channels;  ///< "R", "G", "B", "A", ...
  std::vector<Plane> planes;
  bool straight_alpha = false;  ///< color is not multiplied by "A", as in any PNG with alpha
};

/// PNG and JPEG, known by their first bytes, are read by libpng and libjpeg-turbo; all other
/// formats through OpenImageIO, which is loaded at the first of them (it takes 0.2 s and 135 MB).
/// Throws Error for a file that is missing, damaged or over a limit, and when the format module is
/// needed and is not installed or has no memory: it may be loaded where 112 MB (of which 32 MB are
/// stacks) and, under `ulimit -v`, 448 MiB of addresses are left.
ImageFile read_image(const std::filesystem::path& path, const Limits& limits = {});

/// Writes 8-bit RGB or RGBA (3 or 4 planes of one window, values 0 ... 1, already encoded for
/// display, alpha straight; clamped and rounded, NaN becomes 0) in the format of the path's
/// extension: .png, .jpg (no alpha), .tif. The file is written under a temporary name that is
/// renamed at the end; its bytes depend on the arguments alone. A PNG also carries the texts, by
/// their names, as iTXt chunks, 1 MiB at most; the other formats have no place for them and go
/// without.
void write_image8(const std::filesystem::path& path, const std::vector<View<const float>>& planes,
                  const std::map<std::string, std::string>& texts = {});

/// Throws the Error with which write_image8() would end whatever the pixels are: an extension that
/// it does not know, or for a TIFF no format module.
void expect_image8(const std::filesystem::path& path);

/// Whether the path's extension is that of a PNG (any case).
bool is_png(const std::filesystem::path& path);

/// The texts of a PNG that say how it was made: of what write_image8() put in, those whose name
/// begins with "limpid/". Throws Error for a file that cannot be read, ends too early, is damaged,
/// or has more than 1 MiB of them.
std::map<std::string, std::string> read_image_texts(const std::filesystem::path& path);

/// Whether the path's extension is .exr (any case).
bool is_exr(const std::filesystem::path& path);

/// Whether a file is read by ExrFile instead: it begins as an EXR, whatever its name, or it has the
/// name of one, whatever is in it. Opens a file of another name.
bool holds_exr(const std::filesystem::path& path);

}  // namespace limpid
