#include "files/gltf/gltf_files.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>

#include "limpid/core/error.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

std::string whole_file(const fs::path& path, std::int64_t limit) {
  std::error_code failed;
  if (!fs::exists(path, failed)) throw Error("no such file");
  if (!fs::is_regular_file(path, failed)) throw Error("expected a file");
  const std::uintmax_t size = fs::file_size(path, failed);
  if (failed) throw Error("cannot be read: " + failed.message());
  if (size > static_cast<std::uintmax_t>(limit)) {
    throw Error("has " + std::to_string(size) + " bytes: expected at most " +
                std::to_string(limit));
  }
  std::string bytes(size, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!in || static_cast<std::uintmax_t>(in.gcount()) != size) throw Error("cannot be read");
  return bytes;
}

// --- .glb: glTF 2.0 specification, section 4, "GLB File Format Specification" ---

constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

std::uint32_t little_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

// Removes a chunk from the front of `rest`.
std::string_view next_chunk(std::string_view& rest, std::uint32_t kind, const char* name) {
  if (rest.size() < 8) throw Error(std::string("ends before its chunk ") + name);
  const std::size_t length = little_endian(rest);
  if (little_endian(rest.substr(4)) != kind) {
    throw Error(std::string("expected a chunk ") + name + ", found another");
  }
  if (length > rest.size() - 8) {
    throw Error(std::string("its chunk ") + name + " has " + std::to_string(length) +
                " bytes: expected at most the " + std::to_string(rest.size() - 8) +
                " that are left of the file");
  }
  const std::string_view chunk = rest.substr(8, length);
  rest.remove_prefix(8 + length);
  return chunk;
}

GltfFile parsed(std::string_view text, const Limits& limits) {
  const std::int64_t memory = json_memory(text);
  if (memory > limits.max_memory) {
    throw Error("its JSON may need " + std::to_string(memory) +
                " bytes of memory: expected at most " + std::to_string(limits.max_memory));
  }
  return {parse_json(text), std::nullopt, memory};
}

GltfFile split_glb(std::string_view bytes, const Limits& limits) {
  if (bytes.size() < 12) throw Error("ends within the header of a .glb");
  if (const std::uint32_t version = little_endian(bytes.substr(4)); version != 2) {
    throw Error("is a .glb of version " + std::to_string(version) + ": expected 2");
  }
  if (const std::size_t length = little_endian(bytes.substr(8)); length != bytes.size()) {
    throw Error("has " + std::to_string(bytes.size()) + " bytes: its header says " +
                std::to_string(length));
  }
  std::string_view rest = bytes.substr(12);
  GltfFile file = parsed(next_chunk(rest, kJsonChunk, "JSON"), limits);
  if (!rest.empty()) file.binary = next_chunk(rest, kBinaryChunk, "BIN");
  return file;
}

// --- uris ---

// RFC 3986 "Uniform Resource Identifier", section 2.1.
std::string percent_decoded(const JsonPlace& uri) {
  const std::string& text = uri.text();
  const auto digit = [&](std::size_t i) {
    const bool good = i < text.size() && std::isxdigit(static_cast<unsigned char>(text[i])) != 0;
    if (!good) uri.refuse("two hexadecimal digits after every '%'");
    return std::stoi(text.substr(i, 1), nullptr, 16);
  };
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    decoded += static_cast<char>(16 * digit(i + 1) + digit(i + 2));
    i += 2;
  }
  return decoded;
}

int base64_value(char letter) {
  if (letter >= 'A' && letter <= 'Z') return letter - 'A';
  if (letter >= 'a' && letter <= 'z') return letter - 'a' + 26;
  if (letter >= '0' && letter <= '9') return letter - '0' + 52;
  return letter == '+' ? 62 : letter == '/' ? 63 : -1;
}

bool has_scheme(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon != std::string_view::npos && name.find('/') > colon;
}

}  // namespace

GltfFile read_gltf_file(const fs::path& path, const Limits& limits) {
  return split_gltf(whole_file(path, std::min<std::int64_t>(limits.max_memory, INT32_MAX)), limits);
}

GltfFile split_gltf(std::string_view bytes, const Limits& limits) {
  if (bytes.starts_with("glTF")) return split_glb(bytes, limits);
  return parsed(bytes, limits);
}

bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

std::string bytes_of_data_uri(const JsonPlace& uri) {
  std::string_view text = uri.text();
  text.remove_prefix(std::min(text.size(), text.find(',') + 1));
  for (int pads = 0; pads < 2 && text.ends_with('='); ++pads) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char letter : text) {
    const int value = base64_value(letter);
    if (value < 0) uri.refuse("letters of base64");
    bits = (bits << 6 | static_cast<std::uint32_t>(value)) & 0xFFFF;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

fs::path relative_path_of(const JsonPlace& uri) {
  const std::string name = percent_decoded(uri);
  const bool printable = std::none_of(name.begin(), name.end(), [](char letter) {
    return static_cast<unsigned char>(letter) < 32 || letter == '\x7F';
  });
  if (name.empty() || !printable || name.find('\\') != std::string::npos) {
    uri.refuse("the name of a file");
  }
  if (has_scheme(name)) uri.refuse("a data uri or a file beside the glTF file, not a scheme");
  const fs::path path(name);
  if (path.is_absolute() || path.has_root_path()) {
    uri.refuse("a path relative to the glTF file, not an absolute one");
  }
  if (std::find(path.begin(), path.end(), "..") != path.end()) {
    uri.refuse("a path inside the folder of the glTF file, without '..'");
  }
  return path;
}

std::string read_file_in(const fs::path& folder, const fs::path& relative, std::int64_t limit) {
  const fs::path path = folder / relative;
  try {
    std::error_code missing;
    const fs::path home = fs::canonical(folder, missing);
    const fs::path real = fs::canonical(path, missing);
    if (missing) throw Error("no such file");
    if (std::mismatch(home.begin(), home.end(), real.begin(), real.end()).first != home.end()) {
      throw Error("links lead to " + real.string() +
                  ": expected a file in the folder of the glTF file");
    }
    return whole_file(real, limit);
  } catch (const Error& error) {
    throw Error(path.string() + ": " + error.what(), error.fault());
  }
}

}  // namespace limpid
