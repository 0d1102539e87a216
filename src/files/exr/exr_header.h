#pragma once
#include <array>
#include <set>
#include <string_view>
#include <vector>

#include "limpid/files/exr/exr_file.h"

#include "files/exr/exr_input_stream.h"

namespace limpid {

/// What the tool and files call the compressions, in the order of OpenEXR's enum.
inline constexpr std::array<std::string_view, 10> kCompressions{
    "none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};

/// Of the version field behind the magic number: chunks begin with the number of their part.
inline constexpr std::uint32_t kMultiPartFlag = 0x1000;

/// Whether an attribute describes how pixels are stored, shows them (the preview), or is a hash of
/// the file: such ones belong to one file and are not handed on to another.
bool is_structural(std::string_view attribute);

/// Whether an attribute tells of channels, parts or pixels of the file that it lies in, and would
/// be false in a file with others made from it: manifests of cryptomattes, lists of views, what a
/// host notes of its own layers, sums over pixels, the projection of a whole panorama.
bool describes_content(std::string_view attribute);

/// One part's header, read and checked by ourselves before OpenEXR sees the file.
struct ExrHeader {
  ExrPart part;                                          ///< channels as stored, also Y RY BY
  std::map<std::string, ExrFile::Attribute> attributes;  ///< all
  int compression = 0;                                   ///< index in kCompressions
  std::int64_t tile_width = 0, tile_height = 0;
  std::int64_t chunk_count = -1;  ///< as the header states it, -1 where it does not
};

/// Reads all headers from the beginning of the file and leaves the stream behind them. Nothing is
/// allocated that is larger than the bytes that are there. Throws Error without the path, or
/// Iex::InputExc at the end of the file.
std::vector<ExrHeader> read_exr_headers(FileStream& stream, const Limits& limits);

/// Throws Error (without the path) when a header asks for more than the limits, or for more than a
/// file of this size can hold: both before OpenEXR allocates anything from it. `header_end` is
/// where the headers end in the file.
void check_exr_headers(const std::vector<ExrHeader>& headers, const Limits& limits,
                       std::uint64_t header_end, std::uint64_t file_size);

/// How many threads to decode a file with that passed the check: as many as OpenEXR has (0: the
/// calling one alone), or fewer where the limits have no memory for the chunks of all, of all parts
/// together: OpenEXR keeps those of each part that it has read.
int threads_for(const std::vector<ExrHeader>& headers, const Limits& limits);

/// Throws Error (without the path) where one thread's chunks of these parts together need more
/// memory than the limit.
void check_decoded_parts(const std::vector<ExrHeader>& headers, const std::set<int>& parts,
                         const Limits& limits);

/// How many chunks the pixels of a part make (tiled: of level 0), which come first in its table.
std::int64_t chunks_of(const ExrHeader& header);

/// The most that so many bytes of the part's pixels can become when they are decompressed.
std::int64_t most_unpacked(const ExrHeader& header, std::int64_t packed);

/// Whether the tables of chunks, where the stream stands, have a place for each chunk of the parts,
/// which are of scan lines, and each is where it belongs and ends within the file. Throws
/// Iex::InputExc for one that begins behind the end.
bool has_all_chunks(FileStream& stream, const std::vector<ExrHeader>& headers);

}  // namespace limpid
