#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "files/file_handle.h"

namespace limpid {

/// A hash that tells contents apart, not a seal against forgery: XXH3 of 128 bits, the same on
/// every machine, far faster than bytes come from a disk.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(ContentHash&&) noexcept;
  ContentHash& operator=(ContentHash&&) noexcept;

  void add(const void* bytes, std::size_t count);
  /// Of all that was added: 32 hexadecimal digits, as `xxhsum -H2` prints them.
  std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::string hash_of(std::string_view bytes);
/// Of all bytes of a file. Throws Error that begins with the path.
std::string hash_of(const FileHandle& file);
std::string hash_of_file(const std::filesystem::path& path);

}  // namespace limpid
