#include "files/picture/png_text.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string_view>

#include <IexBaseExc.h>
#include <zlib.h>

#include "limpid/core/error.h"

#include "files/file_stream.h"

namespace limpid {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n"sv;
constexpr std::size_t kHeaderEnd = 8 + 4 + 4 + 13 + 4;  ///< signature and the chunk IHDR
constexpr std::size_t kMaxKey = 79;
constexpr std::string_view kPrefix = "limpid/";  ///< of keys that are read
constexpr auto kPrefixSize = static_cast<std::uint32_t>(kPrefix.size());
constexpr const char* kTooMuch = "texts of how it was made: expected at most 1 MiB of them";
/// Behind the keyword: its end, not compressed, no method, no language, no translation.
constexpr std::string_view kBetween = "\0\0\0\0\0"sv;

std::string big_endian(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 255);
  return bytes;
}

std::uint32_t number_of(std::string_view bytes) {
  std::uint32_t number = 0;
  for (const char byte : bytes) number = number << 8 | static_cast<unsigned char>(byte);
  return number;
}

std::string chunk_of(const std::string& key, const std::string& text) {
  const bool ascii =
      std::all_of(key.begin(), key.end(), [](char c) { return c > ' ' && c < '\x7f'; });
  if (key.empty() || key.size() > kMaxKey || !ascii) {
    throw Error("text '" + key + "': expected a name of 1 ... 79 letters of ASCII");
  }
  const std::string checked = "iTXt" + key + std::string(kBetween) + text;
  const auto* bytes = reinterpret_cast<const Bytef*>(checked.data());
  const auto crc = static_cast<std::uint32_t>(crc32_z(0, bytes, checked.size()));
  return big_endian(static_cast<std::uint32_t>(checked.size() - 4)) + checked + big_endian(crc);
}

/// The next bytes of the file, fewer where it ends.
std::string bytes_of(FileStream& file, std::uint64_t count) {
  const std::uint64_t place = file.tellg(), end = file.file().size();
  std::string bytes(place < end ? std::min(count, end - place) : 0, '\0');
  try {
    if (!bytes.empty()) file.read(bytes.data(), static_cast<int>(bytes.size()));
  } catch (const Iex::InputExc&) {
    bytes.clear();  // it was cut off just now
  }
  return bytes;
}

}  // namespace

void add_png_texts(std::vector<char>& png, const std::map<std::string, std::string>& texts) {
  const std::string_view bytes(png.data(), png.size());
  if (!bytes.starts_with(kSignature) || bytes.size() < kHeaderEnd) {
    throw Error("is no PNG: expected one to put texts into");
  }
  std::string chunks;
  for (const auto& [key, text] : texts) chunks += chunk_of(key, text);
  if (chunks.size() > kMaxTexts) throw Error(kTooMuch);
  png.insert(png.begin() + kHeaderEnd, chunks.begin(), chunks.end());
}

std::map<std::string, std::string> png_texts(const std::filesystem::path& path) {
  FileStream file(std::make_shared<FileHandle>(path));
  std::map<std::string, std::string> texts;
  if (bytes_of(file, kSignature.size()) != kSignature) return texts;
  std::size_t all = 0;
  for (;;) {
    const std::string head = bytes_of(file, 8);
    if (head.size() < 8 || head.ends_with("IEND")) return texts;
    const std::uint32_t size = number_of(head.substr(0, 4));
    const std::uint64_t next = file.tellg() + size + 4;
    if (head.ends_with("iTXt") && bytes_of(file, std::min(size, kPrefixSize)) == kPrefix) {
      all += size;
      if (all > kMaxTexts) throw Error(path.string() + ": " + kTooMuch);
      const std::string data = std::string(kPrefix) + bytes_of(file, size - kPrefixSize);
      const std::size_t end = data.find(kBetween);
      if (end != std::string::npos) {
        texts[data.substr(0, end)] = data.substr(end + kBetween.size());
      }
    }
    file.seekg(next);
  }
}

}  // namespace limpid
