#include "load/gltf_parse.h"

#include <algorithm>
#include <exception>
#include <map>

#include "limpid/core/error.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

using Bytes = std::vector<unsigned char>;
using Buffers = std::map<std::string, Bytes>;

// Gives every buffer without a data uri a name for its uri; returns their bytes under these names.
Buffers name_buffers(const GltfFile& file, nlohmann::json& json, const fs::path& folder,
                     const Limits& limits) {
  Buffers buffers;
  const JsonPlace root(file.json);
  const std::vector<JsonPlace> places = root.list("buffers");
  for (std::size_t i = 0; i < places.size(); ++i) {
    const JsonPlace& place = places[i];
    const auto uri = place.find("uri");
    if (uri && is_data_uri(uri->text())) continue;
    const auto length = static_cast<std::size_t>(place.at("byteLength").integer(1, INT32_MAX));
    const std::string bytes =
        uri ? read_file_in(folder, relative_path_of(*uri), limits.max_memory) : *file.binary;
    if (bytes.size() < length) {
      place.at("byteLength")
          .refuse("at most the " + std::to_string(bytes.size()) + " bytes of its file");
    }
    const std::string name = "buffer" + std::to_string(i);
    buffers[name].assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    json["buffers"][i]["uri"] = name;
  }
  return buffers;
}

bool exists(const std::string& name, void* buffers) {
  return static_cast<Buffers*>(buffers)->contains(name);
}

std::string same_name(const std::string& name, void*) { return name; }

bool take(Bytes* to, std::string*, const std::string& name, void* buffers) {
  *to = std::move(static_cast<Buffers*>(buffers)->at(name));
  return true;
}

bool keep_encoded(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void*) {
  image->image.assign(bytes, bytes + size);
  return true;
}

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

tinygltf::Model parse_gltf(const GltfFile& file, const fs::path& folder, const Limits& limits) {
  nlohmann::json json = file.json;
  Buffers buffers = name_buffers(file, json, folder, limits);
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks({exists, same_name, take, nullptr, &buffers});
  parser.SetImageLoader(keep_encoded, nullptr);
  const std::string text = json.dump();
  if (text.size() > INT32_MAX) throw Error("its JSON has more than 2 GiB");
  tinygltf::Model model;
  std::string error, warning;
  bool parsed = false;
  try {
    parsed = parser.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                        static_cast<unsigned>(text.size()), "");
  } catch (const std::exception& exception) {
    throw Error(std::string("not glTF: ") + exception.what());
  }
  // It goes on after many of its errors, without what it did not understand.
  if (!parsed || !error.empty()) throw Error("not glTF: " + one_line(error));
  return model;
}

}  // namespace limpid
