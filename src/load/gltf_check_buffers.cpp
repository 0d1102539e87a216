#include <algorithm>

#include "limpid/core/error.h"

#include "load/gltf_check.h"
#include "load/gltf_files.h"

namespace limpid {
namespace {

// Sizes up to this can be multiplied by a stride without leaving 64 bits.
constexpr std::int64_t kLargest = std::int64_t{1} << 40;

// Components of SCALAR, VEC2 ...
constexpr std::string_view kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
constexpr std::int64_t kComponents[] = {1, 2, 3, 4, 4, 9, 16};

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
    total += length.integer(1, INT32_MAX);
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
                  "BIN goes without");
    }
    if (length.integer(1, INT32_MAX) > *binary_bytes) {
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

std::int64_t component_size(const JsonPlace& type) {
  switch (type.integer(0, INT32_MAX)) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
  }
  type.refuse("one of 5120, 5121, 5122, 5123, 5125, 5126");
}

void check_accessors(const JsonPlace& root) {
  const std::vector<JsonPlace> views = root.list("bufferViews");
  for (const JsonPlace& accessor : root.list("accessors")) {
    const std::int64_t element = component_size(accessor.at("componentType")) *
                                 kComponents[accessor.at("type").choice(kTypes)];
    const std::int64_t count = accessor.at("count").integer(1, INT32_MAX);
    const std::int64_t offset = size_or(accessor, "byteOffset", 0);
    if (const std::optional<JsonPlace> normalized = accessor.find("normalized")) {
      normalized->boolean();
    }
    const std::optional<JsonPlace> index = accessor.find("bufferView");
    if (!index) continue;
    const JsonPlace& view = views[index->index(views.size())];
    const std::int64_t stride = size_or(view, "byteStride", element);
    if (stride < element) {
      throw Error(accessor.path() + ": elements of " + std::to_string(element) +
                  " bytes in a buffer view of byteStride " + std::to_string(stride));
    }
    const std::int64_t end = offset + (count - 1) * stride + element;
    const std::int64_t length = view.at("byteLength").integer(1, kLargest);
    if (end > length) {
      throw Error(accessor.path() + ": needs " + std::to_string(end) +
                  " bytes of a buffer view of " + std::to_string(length));
    }
  }
}

void check_images(const JsonPlace& root) {
  const std::size_t views = root.count("bufferViews");
  for (const JsonPlace& image : root.list("images")) {
    const std::optional<JsonPlace> uri = image.find("uri"), view = image.find("bufferView");
    if (uri.has_value() == view.has_value()) {
      throw Error(image.path() + ": expected either a uri or a bufferView");
    }
    if (uri) check_uri(*uri, {"image/png", "image/jpeg"});
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
