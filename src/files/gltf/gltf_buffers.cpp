#include "files/gltf/gltf_buffers.h"

#include "limpid/core/error.h"

#include "files/gltf/gltf_extensions.h"

namespace limpid {
namespace {

std::string read_buffer(const JsonPlace& uri, const std::filesystem::path& folder,
                        std::int64_t limit) {
  if (is_data_uri(uri.text())) return bytes_of_data_uri(uri);
  return read_file_in(folder, relative_path_of(uri), limit);
}

}  // namespace

GltfBuffers::GltfBuffers(const GltfFile& file, const std::filesystem::path& folder,
                         MemoryBudget& budget) {
  const JsonPlace root(file.json);
  for (const JsonPlace& buffer : root.list("buffers")) {
    const JsonPlace length = buffer.at("byteLength");
    const auto uri = buffer.find("uri");
    std::string_view bytes;
    if (uri) {
      owned_.push_back(read_buffer(*uri, folder, budget.left));
      bytes = owned_.back();
      budget.take(bytes.size(), 1, buffer.path());
    } else if (!is_packed_buffer(buffer)) {
      bytes = *file.binary;
    } else {
      buffers_.emplace_back();
      continue;
    }
    const auto needed = static_cast<std::size_t>(length.integer(1, INT32_MAX));
    if (bytes.size() < needed) {
      length.refuse("at most the " + std::to_string(bytes.size()) + " bytes that it has");
    }
    buffers_.push_back(bytes.substr(0, needed));
  }
  for (const JsonPlace& view : root.list("bufferViews")) {
    const auto offset = view.find("byteOffset");
    views_.push_back({view.at("buffer").index(buffers_.size()),
                      static_cast<std::size_t>(offset ? offset->integer(0, INT32_MAX) : 0),
                      static_cast<std::size_t>(view.at("byteLength").integer(1, INT32_MAX))});
  }
}

std::string_view GltfBuffers::view(int index) const {
  const View& view = views_.at(index);
  const std::string_view buffer = buffers_.at(view.buffer);
  if (buffer.empty()) {
    throw Error("bufferViews[" + std::to_string(index) +
                "]: is packed by meshopt, which is not read, expected a buffer of its bytes, too");
  }
  return buffer.substr(view.offset, view.length);
}

}  // namespace limpid
