#include "gpu/pipeline_file.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "limpid/core/error.h"

#include "files/atomic_file.h"
#include "files/content_hash.h"

namespace limpid {
namespace {

/// The file: this line, the hash of the rest, the number of SPIR-V's words, the words, and device
/// code.
constexpr std::string_view kMagic = "limpid pipeline 1\n";
constexpr std::size_t kHash = 32;

}  // namespace

std::optional<CompiledPipeline> read_pipeline(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  const std::string_view text(all);
  std::uint64_t words = 0;
  if (text.size() < kMagic.size() + kHash + sizeof words || !text.starts_with(kMagic)) return {};
  const std::string_view hash = text.substr(kMagic.size(), kHash);
  std::string_view rest = text.substr(kMagic.size() + kHash);
  if (hash_of(rest) != hash) return {};
  std::memcpy(&words, rest.data(), sizeof words);
  rest.remove_prefix(sizeof words);
  if (words > rest.size() / sizeof(std::uint32_t)) return {};
  CompiledPipeline compiled;
  compiled.spirv.resize(words);
  const std::size_t size = words * sizeof(std::uint32_t);
  std::memcpy(compiled.spirv.data(), rest.data(), size);
  const auto* code = reinterpret_cast<const std::byte*>(rest.data()) + size;
  compiled.device_code.assign(code, code + (rest.size() - size));
  return compiled;
}

void write_pipeline(const std::filesystem::path& path, const CompiledPipeline& compiled) {
  const std::uint64_t words = compiled.spirv.size();
  std::string rest(sizeof words, '\0');
  std::memcpy(rest.data(), &words, sizeof words);
  rest.append(reinterpret_cast<const char*>(compiled.spirv.data()), words * sizeof(std::uint32_t));
  rest.append(reinterpret_cast<const char*>(compiled.device_code.data()),
              compiled.device_code.size());
  std::error_code failed;
  std::filesystem::create_directories(path.parent_path(), failed);
  if (failed) throw Error(path.parent_path().string() + ": " + failed.message());
  AtomicFile file(path);
  file.write(std::string(kMagic) + hash_of(rest) + rest);
  file.commit();
}

}  // namespace limpid
