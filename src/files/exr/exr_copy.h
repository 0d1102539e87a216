#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <OpenEXR/ImfPixelType.h>

#include "limpid/files/exr/exr_writer.h"

namespace limpid {

Imf::PixelType pixel_type_of(SampleType type);

/// The rows of an ExrCopy for writing: in another window, bit by bit.
class CopiedRows {
 public:
  /// Throws Error for a missing part or channel.
  explicit CopiedRows(const ExrCopy& copy);

  const std::vector<std::string>& names() const { return copy_.channels; }
  SampleType type(std::size_t channel) const { return types_[channel]; }
  /// Sum over all channels.
  std::int64_t pixel_bytes() const { return pixel_bytes_; }
  /// Bytes that read() allocates per line besides `into`.
  std::int64_t line_bytes() const { return pixel_bytes_ * data_.width(); }
  std::int64_t max_memory() const { return copy_.from->limits().max_memory; }

  /// Fills the rows of the block, those of channel i consecutively from `into[i]` on; 0 outside the
  /// source's data window. Throws Error as ExrFile::read_stored().
  void read(const Rect& block, std::span<char* const> into);

 private:
  std::size_t bytes_of(std::size_t channel) const;

  const ExrCopy& copy_;
  Rect data_;
  std::vector<SampleType> types_;
  std::int64_t pixel_bytes_ = 0;
  std::vector<char> rows_;  ///< some lines of the whole data window
};

}  // namespace limpid
