#include "files/content_hash.h"

#include <cstdio>
#include <new>
#include <vector>

#define XXH_INLINE_ALL  // so that hosts in memory need no library for it
#include <xxhash.h>

namespace limpid {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 18;  ///< fits in the cache while it is hashed

std::string text_of(XXH128_hash_t hash) {
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, hash);
  std::string text;
  for (const unsigned char byte : bytes.digest) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", static_cast<unsigned>(byte));
    text += digits;
  }
  return text;
}

}  // namespace

struct ContentHash::State {
  State() : hash(XXH3_createState()) {
    if (hash == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(hash);
  }
  ~State() { XXH3_freeState(hash); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  XXH3_state_t* hash;
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {}
ContentHash::~ContentHash() = default;
ContentHash::ContentHash(ContentHash&&) noexcept = default;
ContentHash& ContentHash::operator=(ContentHash&&) noexcept = default;

void ContentHash::add(const void* bytes, std::size_t count) {
  XXH3_128bits_update(state_->hash, bytes, count);
}

std::string ContentHash::text() const { return text_of(XXH3_128bits_digest(state_->hash)); }

std::string hash_of(std::string_view bytes) {
  return text_of(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string hash_of(const FileHandle& file) {
  ContentHash hash;
  std::vector<char> block(kBlockBytes);
  for (std::uint64_t offset = 0; offset < file.size();) {
    const std::size_t got = file.read(block.data(), block.size(), offset);
    if (got == 0) break;  // the file was truncated
    hash.add(block.data(), got);
    offset += got;
  }
  return hash.text();
}

std::string hash_of_file(const std::filesystem::path& path) { return hash_of(FileHandle(path)); }

}  // namespace limpid
