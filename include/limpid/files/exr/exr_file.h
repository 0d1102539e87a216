#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "limpid/core/plane.h"
#include "limpid/files/limits.h"

namespace limpid {

enum class SampleType { kHalf, kFloat, kUint };

struct ExrChannel {
  std::string name;  ///< as in the file, e.g. "ViewLayer.Depth.Z"
  SampleType type;
  int x_sampling = 1, y_sampling = 1;
};

/// The header of one part.
struct ExrPart {
  std::string name;                ///< "" if the file has none
  std::string view;                ///< "left", "right", ... or ""
  std::vector<std::string> views;  ///< of the attribute multiView, the default view first
  Rect data, display;
  std::string compression;  ///< as in --compression: none rle zips zip piz pxr24 b44 b44a dwaa dwab
  bool tiled = false, deep = false;
  double pixel_aspect = 1;
  std::vector<ExrChannel> channels;  ///< in the file's order (alphabetical)
};

/// A channel to read and its destination: every pixel of `into.window` is written; pixels outside
/// the part's data window become `missing`.
struct ExrRequest {
  int part;
  std::string channel;
  View<float> into;
  float missing = 0;
};

/// Some whole pixels of a deep part, row by row, with all their samples as floats.
struct DeepBlock {
  Rect window;
  std::vector<std::size_t> first;          ///< pixel i has the samples first[i] <= s < first[i + 1]
  std::vector<std::vector<float>> values;  ///< of each requested channel, in that order, by sample
};

/// An open EXR file: its headers are read and checked against the limits, but no pixels. Scan-line
/// and tiled (level 0), multi-part, mixed sample types; luminance-chroma (Y RY BY, subsampled)
/// reads as the channels R G B, in half precision. Deep parts have their own functions. Several
/// threads may read one file; their reads run one after another.
class ExrFile {
 public:
  /// Throws Error (one sentence, begins with the path) for a file that is missing, not an EXR,
  /// damaged, or over a limit.
  static ExrFile open(const std::filesystem::path& path, const Limits& limits = {});
  ExrFile(ExrFile&&) noexcept;
  ExrFile& operator=(ExrFile&&) noexcept;
  ~ExrFile();

  const std::filesystem::path& path() const;
  const std::vector<ExrPart>& parts() const;
  const Limits& limits() const;  ///< as passed to open()

  /// Decodes the requested channels, of any parts, each part in one pass; half and uint become
  /// float. Views that hold whole rows of the data window are decoded in place. Throws Error for an
  /// unknown channel and, before anything is allocated, if channels or the chunks of all parts read
  /// so far need more memory than the limits; also for truncated or damaged pixels, which never
  /// silently read as black; the views then have unspecified values.
  void read(std::span<const ExrRequest> requests) const;

  /// Decodes lines y0 <= y < y1 of the data window of a flat part without changing a bit: the
  /// stored samples of `channels` (half, float or uint), those of channel i as whole rows from
  /// `into[i]` on. Throws Error as read() does, and for channels that are computed from luminance
  /// and chroma, which no file stores.
  void read_stored(int part, std::span<const std::string> channels, int y0, int y1,
                   std::span<char* const> into) const;

  /// Decodes channels of a deep part (scan-line, or tiled: level 0) and passes them to `sink`, some
  /// lines or one tile at a time, each pixel of the data window once; no more samples than these
  /// are in memory. Their number is checked against the limits and the size of the file before the
  /// allocation. Throws Error as read() does. `sink` must not read from this file.
  void read_deep(int part, std::span<const std::string> channels,
                 const std::function<void(const DeepBlock&)>& sink) const;

  /// Whether a file from this library (with scan-line parts) is complete: all chunks of its headers
  /// are in their places before the end of the file. False for files of another kind. Decodes
  /// nothing. Throws Error if the system cannot read the file.
  bool is_whole() const;

  /// Whether all bytes are unchanged since this library wrote them, by the hash in the text
  /// attribute "limpid_file_hash" (whose own bytes count as 32 digits 0). Empty without that
  /// attribute. Reads the whole file, decodes nothing. Throws Error if the system cannot read the
  /// file.
  std::optional<bool> is_as_written() const;

  /// A hash of all bytes of the open file, even if its name now belongs to another file: XXH3, 128
  /// bits, 32 hexadecimal digits, as printed by `xxhsum -H2`. It identifies files; it is no
  /// signature.
  std::string content_hash() const;

  /// A 4x4 matrix attribute by name, 16 floats in memory order, such as `worldToCamera`. These
  /// three functions return nothing if the attribute is absent or of another type.
  std::optional<std::array<float, 16>> matrix_attribute(int part, const std::string& name) const;
  std::optional<double> number_attribute(int part, const std::string& name) const;
  std::optional<std::string> text_attribute(int part, const std::string& name) const;

  /// Serialised attributes of a part, also of unknown types, for copying to another file: name ->
  /// (type name, bytes). Without those that describe the storage of the pixels (channels,
  /// compression, windows, tiles, lineOrder, chunkCount, type, name ...), and without the preview
  /// and the hash, which belong to this picture only.
  struct Attribute {
    std::string type;
    std::vector<char> bytes;
  };
  std::map<std::string, Attribute> attributes(int part) const;

 private:
  struct State;
  explicit ExrFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Sets the number of threads with which OpenEXR decodes and encodes, for the whole process. 0 and
/// 1 (the default) mean the calling thread only; there are fewer threads if the system does not let
/// the process start more. Files that are already open keep their number.
void set_file_threads(int count);

}  // namespace limpid
