#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

/// Tiny glTF files made in memory.

namespace limpid::test {

inline std::string base64(const std::string& bytes) {
  static const char* const kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

inline std::string data_uri(const std::string& bytes) {
  return "data:application/octet-stream;base64," + base64(bytes);
}

/// A unit square in the plane z = 0 that faces +Z.
struct Square {
  std::vector<float> positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  std::vector<float> normals = {0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2};
  std::vector<float> uvs = {0, 1, 1, 1, 1, 0, 0, 0};
  std::vector<std::uint16_t> indices = {0, 1, 2, 0, 2, 3};

  std::string bytes() const {
    return bytes_of(positions) + bytes_of(normals) + bytes_of(uvs) + bytes_of(indices);
  }
};

/// One node with the square on it; accessors 0 positions, 1 normals, 2 uvs, 3 indices.
inline nlohmann::json square_gltf(const Square& square = {}) {
  nlohmann::json gltf = nlohmann::json::parse(R"({
    "asset": {"version": "2.0"},
    "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"name": "thing", "mesh": 0}],
    "meshes": [{"name": "square", "primitives": [
      {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3}]}],
    "buffers": [{"byteLength": 140}],
    "bufferViews": [{"buffer": 0, "byteLength": 96, "byteStride": 12},
                    {"buffer": 0, "byteOffset": 96, "byteLength": 32},
                    {"buffer": 0, "byteOffset": 128, "byteLength": 12}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4},
      {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "type": "VEC3", "count": 4},
      {"bufferView": 1, "componentType": 5126, "type": "VEC2", "count": 4},
      {"bufferView": 2, "componentType": 5123, "type": "SCALAR", "count": 6}]
  })");
  gltf["buffers"][0]["uri"] = data_uri(square.bytes());
  return gltf;
}

/// A .glb of these two chunks, padded as they must be.
inline std::string glb(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto word = [](std::size_t value) {
    return bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)});
  };
  const std::string chunks =
      word(json.size()) + "JSON" + json + word(binary.size()) + std::string("BIN\0", 4) + binary;
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

}  // namespace limpid::test
