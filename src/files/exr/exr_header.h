#pragma once
#include <array>
#include <set>
#include <string_view>
#include <vector>

#include "limpid/files/exr/exr_file.h"

#include "files/exr/exr_input_stream.h"

namespace limpid {

/// limpid's names for the compressions, in the order of OpenEXR's enum.
inline constexpr std::array<std::string_view, 10> kCompressions{
    "none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};

/// Flag in the version field after the magic number: chunks begin with the number of their part.
inline constexpr std::uint32_t kMultiPartFlag = 0x1000;

/// Whether an attribute describes the storage of pixels, shows them (the preview), or is a hash of
/// the file: such attributes belong to one file and are not passed on.
bool is_structural(std::string_view attribute);

/// Whether an attribute describes channels, parts or pixels of its file, and would be false in a
/// file with others made from it: manifests of cryptomattes, lists of views, a host's notes on its
/// layers, sums over pixels, the projection of a whole panorama.
bool describes_content(std::string_view attribute);

/// One part's header, parsed and checked by limpid before OpenEXR reads the file.
struct ExrHeader {
  ExrPart part;                                          ///< channels as stored, also Y RY BY
  std::map<std::string, ExrFile::Attribute> attributes;  ///< all
  int compression = 0;                                   ///< index in kCompressions
  std::int64_t tile_width = 0, tile_height = 0;
  std::int64_t chunk_count = -1;  ///< as in the header, -1 if it has none
};

/// Parses all headers from the beginning of the file and leaves the stream after them. Allocates no
/// more than the bytes that are there. Throws Error without the path, or Iex::InputExc at the end
/// of the file.
std::vector<ExrHeader> read_exr_headers(FileStream& stream, const Limits& limits);

/// Throws Error (without the path) if a header exceeds the limits, or the content that a file of
/// this size can have: both before OpenEXR allocates anything from it. `header_end` is the end of
/// the headers in the file.
void check_exr_headers(const std::vector<ExrHeader>& headers, const Limits& limits,
                       std::uint64_t header_end, std::uint64_t file_size);

/// Number of threads for decoding a file that passed the check: OpenEXR's number (0: only the
/// calling thread), or fewer if the limits are too small for the chunks of all threads and all
/// parts together: OpenEXR keeps the chunks of each part that it has read.
int threads_for(const std::vector<ExrHeader>& headers, const Limits& limits);

/// Throws Error (without the path) if one thread's chunks of these parts together exceed the limit.
void check_decoded_parts(const std::vector<ExrHeader>& headers, const std::set<int>& parts,
                         const Limits& limits);

/// Number of chunks of a part's pixels (tiled: of level 0), which come first in its table.
std::int64_t chunks_of(const ExrHeader& header);

/// The largest decompressed size of this many bytes of the part's pixels.
std::int64_t most_unpacked(const ExrHeader& header, std::int64_t packed);

/// Whether the tables of chunks, at the stream's position, are complete for the parts, which have
/// scan lines, and each chunk is in its place and ends within the file. Throws Iex::InputExc for a
/// chunk that begins beyond the end.
bool has_all_chunks(FileStream& stream, const std::vector<ExrHeader>& headers);

}  // namespace limpid
