#pragma once
#include <span>
#include <string>

#include <OpenEXR/ImfMultiPartInputFile.h>

#include "files/exr/exr_header.h"

namespace limpid {

/// Whether a part holds the luminance-chroma picture `layer` ("" or "left." and so on): Y at full
/// and RY, BY at half resolution, and no R G B beside them.
bool is_luminance_chroma(const ExrPart& stored, const std::string& layer);

/// The part for users: R G B instead of Y RY BY.
ExrPart shown_part(const ExrPart& stored);

/// "left." of "left.R"; "" of "R".
std::string layer_of(const std::string& channel);

/// Writes `missing` to the pixels of the requests that lie outside the data window.
void fill_outside(const Rect& data, std::span<const ExrRequest> requests);

/// Decodes channels of a part as they are stored. The requests are valid.
void read_stored(Imf::MultiPartInputFile& file, const ExrHeader& header,
                 std::span<const ExrRequest> requests);

/// The lines y0 <= y < y1.
struct LineRange {
  int y0, y1;
};

/// Decodes these lines of the part, over the whole width of its data window, with the stored bits:
/// rows of channel i consecutively from `into[i]` on. Names and lines are valid.
void read_lines(Imf::MultiPartInputFile& file, const ExrHeader& header, int part,
                std::span<const std::string> channels, LineRange lines,
                std::span<char* const> into);

/// The stored channel of that name, or null.
const ExrChannel* find_channel(const ExrPart& part, const std::string& name);

/// Decodes R G B of the luminance-chroma picture `layer` of a file's first part, from a stream at
/// the beginning of the file.
void read_luminance_chroma(FileStream& stream, const ExrHeader& header, const std::string& layer,
                           std::span<const ExrRequest> requests);

}  // namespace limpid
