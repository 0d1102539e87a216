#pragma once
#include <functional>
#include <span>
#include <string>

#include <OpenEXR/ImfMultiPartInputFile.h>

#include "files/exr/exr_header.h"

namespace limpid {

/// A request for one deep part. The channels are valid.
struct DeepRequest {
  const std::vector<ExrHeader>& headers;
  int part;
  std::span<const std::string> channels;
  const Limits& limits;
};

/// Decodes a deep part block by block. `stream` is a separate stream on the file, at the tables of
/// chunks. Throws Error (without the path) or OpenEXR's exceptions.
void read_deep_stored(Imf::MultiPartInputFile& file, FileStream& stream, const DeepRequest& request,
                      const std::function<void(const DeepBlock&)>& sink);

}  // namespace limpid
