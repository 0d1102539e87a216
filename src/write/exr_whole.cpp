#include "write/exr_whole.h"

#include <limits>
#include <memory>
#include <new>
#include <optional>

#include "load/exr_header.h"
#include "write/atomic_file.h"

namespace limpid {
namespace {

/// OpenEXR 3.1 leaves a chunk out without a word when its compressor fails.
void check_complete(const std::filesystem::path& path) {
  FileStream stream(std::make_shared<FileHandle>(path));
  const Limits unlimited{std::numeric_limits<std::int64_t>::max(), std::numeric_limits<int>::max(),
                         std::numeric_limits<int>::max(), 1,
                         std::numeric_limits<std::int64_t>::max()};
  const ExrHeader header = read_exr_headers(stream, unlimited)[0];
  if (!has_all_chunks(stream, header))
    throw Error("cannot be written (some lines could not be compressed)");
}

}  // namespace

void write_whole_exr(const std::filesystem::path& path, const std::function<void()>& check,
                     const std::function<void(OutputStream&)>& write) {
  const std::string name = path.string();
  try {
    check();
  } catch (const Error& error) {
    throw Error(name + ": " + error.what(), error.fault());
  }
  AtomicFile file(path);
  OutputStream stream(file.temporary());
  std::optional<Error> failure;
  try {
    write(stream);
    stream.close();
    if (stream.error() == 0) check_complete(file.temporary());
  } catch (const Error& error) {
    failure.emplace(name + ": " + error.what(), error.fault());
  } catch (const std::bad_alloc&) {
    failure.emplace(name + ": needs more memory than there is", Fault::kRetry);
  } catch (const std::exception& error) {
    failure.emplace(name + ": cannot be written (" + error.what() + ")");
  }
  if (stream.error() != 0) {
    failure.emplace(name + ": cannot be written (" + describe(stream.error()) + ")",
                    fault_of(stream.error()));
  }
  if (failure) throw *failure;
  file.commit();
}

}  // namespace limpid
