#include <algorithm>

#include "limpid/core/error.h"

#include "files/gltf/gltf_check.h"
#include "files/gltf/gltf_extensions.h"
#include "files/gltf/gltf_files.h"
#include "files/gltf/gltf_types.h"

namespace limpid {
namespace {

// Sizes up to this can be multiplied by a stride without leaving 64 bits.
constexpr std::int64_t kLargest = std::int64_t{1} << 40;

std::int64_t size_or(const JsonPlace& object, std::string_view key, std::int64_t otherwise) {
  const std::optional<JsonPlace> size = object.find(key);
  return size ? size->integer(0, kLargest) : otherwise;
}

void check_data_uri(const JsonPlace& uri, const std::vector<std::string>& types) {
  const std::string& text = uri.text();
  const bool known = std::any_of(types.begin(), types.end(), [&](const std::string& type) {
    return text.starts_with("data:" + type + ";base64,");
  });
  if (!known) uri.refuse("a data uri of base64 and of type " + join(types, " or "));
}

void check_uri(const JsonPlace& uri, const std::vector<std::string>& types) {
  if (is_data_uri(uri.text())) return check_data_uri(uri, types);
  relative_path_of(uri);
}

void check_buffers(const JsonPlace& root, std::optional<std::int64_t> binary_bytes,
                   const Limits& limits) {
  std::int64_t total = 0;
  const std::vector<JsonPlace> buffers = root.list("buffers");
  for (const JsonPlace& buffer : buffers) {
    const JsonPlace length = buffer.at("byteLength");
    const std::int64_t bytes = length.integer(1, INT32_MAX);
    if (is_packed_buffer(buffer)) continue;
    total += bytes;
    if (total > limits.max_memory) {
      throw Error("its buffers have " + std::to_string(total) + " bytes: expected at most " +
                  std::to_string(limits.max_memory));
    }
    if (const std::optional<JsonPlace> uri = buffer.find("uri")) {
      check_uri(*uri, {"application/octet-stream", "application/gltf-buffer"});
      continue;
    }
    if (!(buffer == buffers.front()) || !binary_bytes) {
      throw Error(buffer.path() +
                  ": expected a uri; only the first buffer of a .glb with a chunk "
                  "BIN needs none");
    }
    if (bytes > *binary_bytes) {
      length.refuse("at most the " + std::to_string(*binary_bytes) + " bytes of the chunk BIN");
    }
  }
}

void check_views(const JsonPlace& root) {
  const std::vector<JsonPlace> buffers = root.list("buffers");
  for (const JsonPlace& view : root.list("bufferViews")) {
    const std::int64_t size =
        buffers[view.at("buffer").index(buffers.size())].at("byteLength").integer(1, INT32_MAX);
    const std::int64_t offset = size_or(view, "byteOffset", 0);
    const std::int64_t length = view.at("byteLength").integer(1, kLargest);
    if (offset + length > size) {
      throw Error(view.path() + ": bytes " + std::to_string(offset) + " to " +
                  std::to_string(offset + length) + " of a buffer of " + std::to_string(size));
    }
    if (const std::optional<JsonPlace> stride = view.find("byteStride")) {
      if (stride->integer(4, 252) % 4 != 0) stride->refuse("a multiple of 4");
    }
  }
}

// Throws Error unless the bytes from `offset` lie in a buffer view.
void check_room(const JsonPlace& user, const JsonPlace& view, std::int64_t offset,
                std::int64_t bytes) {
  const std::int64_t length = view.at("byteLength").integer(1, kLargest);
  if (offset + bytes > length) {
    throw Error(user.path() + ": needs " + std::to_string(offset + bytes) +
                " bytes of a buffer view of " + std::to_string(length));
  }
}

// The sparse elements of an accessor: as many indices as values, both tightly packed. The values of
// the indices are checked when they are read.
void check_sparse(const JsonPlace& sparse, const std::vector<JsonPlace>& views,
                  std::int64_t element, std::int64_t elements) {
  const std::int64_t count = sparse.at("count").integer(1, elements);
  const auto check_part = [&](const JsonPlace& part, std::int64_t size) {
    const JsonPlace& view = views[part.at("bufferView").index(views.size())];
    check_room(part, view, size_or(part, "byteOffset", 0), count * size);
  };
  const JsonPlace indices = sparse.at("indices");
  const JsonPlace component = indices.at("componentType");
  const std::int64_t type = component.integer(0, INT32_MAX);
  if (type != kGltfUbyte && type != kGltfUshort && type != kGltfUint) {
    component.refuse("one of 5121, 5123, 5125");
  }
  check_part(indices, gltf_component_size(type));
  check_part(sparse.at("values"), element);
}

void check_accessors(const JsonPlace& root) {
  const std::vector<JsonPlace> views = root.list("bufferViews");
  for (const JsonPlace& accessor : root.list("accessors")) {
    const std::int64_t element = gltf_element_size(accessor);
    const std::int64_t count = accessor.at("count").integer(1, INT32_MAX);
    const std::int64_t offset = size_or(accessor, "byteOffset", 0);
    is_normalized(accessor);
    if (const std::optional<JsonPlace> sparse = accessor.find("sparse")) {
      check_sparse(*sparse, views, element, count);
    }
    const std::optional<JsonPlace> index = accessor.find("bufferView");
    if (!index) continue;
    const JsonPlace& view = views[index->index(views.size())];
    const std::int64_t stride = size_or(view, "byteStride", element);
    if (stride < element) {
      throw Error(accessor.path() + ": elements of " + std::to_string(element) +
                  " bytes in a buffer view of byteStride " + std::to_string(stride));
    }
    check_room(accessor, view, offset, (count - 1) * stride + element);
  }
}

void check_images(const JsonPlace& root) {
  const std::size_t views = root.count("bufferViews");
  for (const JsonPlace& image : root.list("images")) {
    const std::optional<JsonPlace> uri = image.find("uri"), view = image.find("bufferView");
    if (uri.has_value() == view.has_value()) {
      throw Error(image.path() + ": expected either a uri or a bufferView");
    }
    // Images of other types are allowed if no texture uses them.
    if (uri) {
      check_uri(*uri, {"image/png", "image/jpeg", "image/webp", "image/ktx2", "image/avif",
                       "image/vnd-ms.dds"});
    }
    if (view) view->index(views);
  }
}

}  // namespace

void check_gltf_buffers(const JsonPlace& root, std::optional<std::int64_t> binary_bytes,
                        const Limits& limits) {
  check_buffers(root, binary_bytes, limits);
  check_views(root);
  check_accessors(root);
  check_images(root);
}

}  // namespace limpid
