#include "files/file_hash.h"

#include <algorithm>
#include <vector>

#include "files/content_hash.h"

namespace limpid {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 18;

/// The attribute in the header, up to its text: name, type, size.
std::string heading() {
  std::string bytes(kFileHashName);
  bytes += '\0';
  bytes += "string";
  bytes += '\0';
  bytes += static_cast<char>(kNoFileHash.size());
  return bytes + std::string(3, '\0');
}

void add(ContentHash& hash, const FileHandle& file, std::uint64_t from, std::uint64_t to) {
  std::vector<char> block(kBlockBytes);
  while (from < to) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), to - from));
    const std::size_t got = file.read(block.data(), wanted, from);
    if (got == 0) return;  // the file was truncated
    hash.add(block.data(), got);
    from += got;
  }
}

}  // namespace

std::optional<FileHash> file_hash(const FileHandle& file, std::uint64_t header_end) {
  std::string header(static_cast<std::size_t>(std::min(header_end, file.size())), '\0');
  header.resize(file.read(header.data(), header.size(), 0));
  const std::string before = heading();
  const std::size_t at = header.find(before);
  if (at == std::string::npos || at + before.size() + kNoFileHash.size() > header.size()) {
    return std::nullopt;
  }
  const std::size_t place = at + before.size();
  ContentHash hash;
  hash.add(header.data(), place);
  hash.add(kNoFileHash.data(), kNoFileHash.size());
  add(hash, file, place + kNoFileHash.size(), file.size());
  return FileHash{place, header.substr(place, kNoFileHash.size()), hash.text()};
}

}  // namespace limpid
