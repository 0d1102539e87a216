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

/// What the header of one part says.
struct ExrPart {
  std::string name;                ///< "" where the file has none
  std::string view;                ///< "left", "right", ... or ""
  std::vector<std::string> views;  ///< of the attribute multiView, the default one first
  Rect data, display;
  std::string compression;  ///< as in --compression: none rle zips zip piz pxr24 b44 b44a dwaa dwab
  bool tiled = false, deep = false;
  double pixel_aspect = 1;
  std::vector<ExrChannel> channels;  ///< in the file's order (alphabetical)
};

/// One channel to read, and where to: every pixel of `into.window` is written; those outside the
/// part's data window become `missing`.
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
  std::vector<std::vector<float>> values;  ///< of each channel asked for, in that order, by sample
};

/// An open EXR file: its headers are read and checked against the limits, but no pixels. Scan-line
/// and tiled (level 0), multi-part, mixed sample types; luminance-chroma (Y RY BY, subsampled)
/// reads as the channels R G B, in half precision. Deep parts have their own functions. One file
/// may be read from several threads; the reads follow one another.
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
  const Limits& limits() const;  ///< what it was opened with

  /// Decodes the requested channels, of any parts, each part in one pass; half and uint become
  /// float. Views that hold whole rows of the data window are decoded in place. Throws Error for an
  /// unknown channel and, before anything is allocated, if channels or the chunks of all parts read
  /// so far need more memory than the limits; also for truncated or damaged pixels (never silent
  /// black), after which the views have unspecified values.
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

  /// Whether all pixels of a file from this library (parts of scan lines) are there: the chunks
  /// that the headers promise, in their places, before the end of the file. False for files of
  /// another kind. Decodes nothing. Throws Error when the system cannot read.
  bool is_whole() const;

  /// Whether all bytes are unchanged since this library wrote them: their hash is in the text
  /// attribute "limpid_file_hash", which counts as 32 digits 0 itself. Empty without that
  /// attribute. Reads the whole file, decodes nothing. Throws Error when the system cannot read.
  std::optional<bool> is_as_written() const;

  /// A hash of all bytes of the open file, whatever file has its name now: XXH3, 128 bits, 32
  /// hexadecimal digits, as printed by `xxhsum -H2`. It identifies files; it is not a signature.
  std::string content_hash() const;

  /// A 4x4 matrix attribute by name, 16 floats in memory order, as in `worldToCamera`. These three
  /// are empty where the attribute is absent or of another type.
  std::optional<std::array<float, 16>> matrix_attribute(int part, const std::string& name) const;
  std::optional<double> number_attribute(int part, const std::string& name) const;
  std::optional<std::string> text_attribute(int part, const std::string& name) const;

  /// Serialised attributes of a part as they lie in the file, also of unknown types, for handing on
  /// to a writer: name -> (type name, bytes). Without the ones that describe the pixels' storage
  /// (channels, compression, windows, tiles, lineOrder, chunkCount, type, name ...) and without the
  /// preview and the hash, which would be of another picture.
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

/// Threads with which OpenEXR decodes and encodes, in the whole process; 0 and 1 (the default) mean
/// the calling thread alone; fewer if the system lets the process start no more. Files opened
/// before keep their number.
void set_file_threads(int count);

}  // namespace limpid
