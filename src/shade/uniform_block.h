#pragma once
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec4.hpp>

namespace limpid {

/// The uniform block of a shader: its declaration, member by member, and its bytes in the std140
/// layout: scalars at their own size, vectors of four at 16 bytes. Vectors come before scalars.
class UniformBlock {
 public:
  void add(const std::string& name, const glm::ivec4& value) {
    declare("ivec4 " + name, &value, sizeof value);
  }
  void add(const std::string& name, const std::vector<glm::ivec4>& values) {
    declare("ivec4 " + name + "[" + std::to_string(values.size()) + "]", values.data(),
            values.size() * sizeof(glm::ivec4));
  }
  void add(const std::string& name, const glm::vec4& value) {
    declare("vec4 " + name, &value, sizeof value);
  }
  void add(const std::string& name, const std::vector<glm::vec4>& values) {
    declare("vec4 " + name + "[" + std::to_string(values.size()) + "]", values.data(),
            values.size() * sizeof(glm::vec4));
  }
  /// Appends a member; returns its offset.
  std::size_t add(const std::string& name, float value) {
    const std::size_t offset = bytes_.size();
    declare("float " + name, &value, sizeof value);
    return offset;
  }
  const std::string& text() const { return text_; }
  std::vector<std::byte> take() {
    bytes_.resize((bytes_.size() + 15) / 16 * 16);
    return std::move(bytes_);
  }

 private:
  void declare(const std::string& member, const void* data, std::size_t size) {
    text_ += "  " + member + ";\n";
    const auto* from = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), from, from + size);
  }
  std::string text_;
  std::vector<std::byte> bytes_;
};

}  // namespace limpid
