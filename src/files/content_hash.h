#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "files/file_handle.h"

namespace limpid {

/// A hash to compare contents, not a protection against forgery: XXH3 of 128 bits, the same on
/// every machine, far faster than a disk.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(ContentHash&&) noexcept;
  ContentHash& operator=(ContentHash&&) noexcept;

  void add(const void* bytes, std::size_t count);
  /// The hash of all bytes added: 32 hexadecimal digits, as `xxhsum -H2` prints them.
  std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::string hash_of(std::string_view bytes);
/// The hash of all bytes of a file. Throws Error that begins with the path.
std::string hash_of(const FileHandle& file);
std::string hash_of_file(const std::filesystem::path& path);

}  // namespace limpid
