#include "files/exr/exr_whole.h"

#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>

#include "files/exr/exr_header.h"
#include "files/file_hash.h"
#include "files/want_of_memory.h"

namespace limpid {
namespace {

/// Writes the text into its reserved place in the file.
void put_hash(const std::filesystem::path& path, const FileHash& hash) {
  OutputStream stream(path, OutputStream::kChange);
  stream.seekp(hash.place);
  stream.write(hash.found.data(), static_cast<int>(hash.found.size()));
  stream.close();
  if (stream.error() != 0) {
    throw Error("cannot be written (" + describe(stream.error()) + ")", fault_of(stream.error()));
  }
}

/// OpenEXR 3.1 silently leaves out a chunk if its compressor fails. A complete file gets its hash.
void finish(const std::filesystem::path& path) {
  const auto file = std::make_shared<FileHandle>(path);
  FileStream stream(file);
  const Limits unlimited{std::numeric_limits<std::int64_t>::max(), std::numeric_limits<int>::max(),
                         std::numeric_limits<int>::max(), std::numeric_limits<int>::max(),
                         std::numeric_limits<std::int64_t>::max()};
  const std::vector<ExrHeader> headers = read_exr_headers(stream, unlimited);
  const std::uint64_t header_end = stream.tellg();
  if (!has_all_chunks(stream, headers))
    throw std::runtime_error("some lines could not be compressed");
  if (const auto hash = file_hash(*file, header_end)) put_hash(path, *hash);
}

}  // namespace

void write_whole_exr(AtomicFiles& files, const std::filesystem::path& path,
                     const std::function<void()>& check,
                     const std::function<void(OutputStream&)>& write) {
  const std::string name = path.string();
  try {
    check();
  } catch (const Error& error) {
    throw Error(name + ": " + error.what(), error.fault());
  }
  const std::filesystem::path temporary = files.add(path).temporary();
  OutputStream stream(temporary);
  std::optional<Error> failure;
  try {
    write(stream);
    stream.close();
    if (stream.error() == 0) finish(temporary);
  } catch (const Error& error) {
    failure.emplace(name + ": " + error.what(), error.fault());
  } catch (const std::bad_alloc&) {
    failure = no_memory(name);
  } catch (const std::exception& error) {
    failure = is_for_want_of_memory(error)
                  ? no_memory(name)
                  : Error(name + ": cannot be written (" + error.what() + ")");
  }
  if (stream.error() != 0) {
    failure.emplace(name + ": cannot be written (" + describe(stream.error()) + ")",
                    fault_of(stream.error()));
  }
  if (failure) throw *failure;
}

}  // namespace limpid
