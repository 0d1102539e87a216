#pragma once
#include <cstdint>
#include <vector>

#include "files/exr/exr_header.h"

namespace limpid {

/// Decompresses a chunk of a scan-line part into rows of each channel's samples as stored (half,
/// float or uint, little-endian). For the most common files: none, zip, zips and piz without
/// subsampled channels. Lossless, so the pixels equal OpenEXR's.
class ExrUnpacker {
 public:
  /// Whether the part is supported. Others are left to OpenEXR.
  static bool knows(const ExrHeader& header);

  /// `wanted`: indices in part.channels of the channels to be read.
  ExrUnpacker(const ExrHeader& header, std::vector<std::size_t> wanted);

  int lines_of_chunk() const { return chunk_lines_; }
  /// Buffer for the packed bytes of a chunk, of the largest possible size.
  char* packed() { return packed_.data(); }
  int capacity() const { return static_cast<int>(packed_.size()); }
  /// Throws Error (without the path) if the bytes do not unpack to this many lines.
  void unpack(int packed_bytes, int lines);

  /// The samples of a wanted channel in a line of the chunk, not aligned.
  const char* row(std::size_t channel, int line) const {
    return pixels_ + first_[channel] + row_stride_[channel] * line;
  }
  static int bytes_of(SampleType type) { return type == SampleType::kHalf ? 2 : 4; }

 private:
  void unzip(std::size_t packed_bytes, std::size_t bytes);
  void unpiz(std::size_t packed_bytes, std::size_t bytes, int lines);
  void place_line_by_line();
  void place_channel_by_channel(int lines);

  const ExrHeader& header_;
  std::vector<std::size_t> wanted_;
  int chunk_lines_;
  std::size_t line_bytes_ = 0;
  std::vector<char> packed_, halves_, unzipped_;
  std::vector<std::uint16_t> words_, values_;
  const char* pixels_ = nullptr;                    ///< unpacked, of the chunk
  std::vector<std::ptrdiff_t> first_, row_stride_;  ///< of each channel in them
};

}  // namespace limpid
