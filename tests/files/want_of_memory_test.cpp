#include <cstdlib>
#include <new>

#include "limpid/core/plane.h"

#include "files/exr/exr_files.h"
#include "memory_end.h"
#include "sanitized.h"

/// A valid file is never called damaged because memory ends while the library reads the file.

namespace limpid::exr_test {
namespace {

/// Ends the process: code 0 if the error of read() has the fault kMemory.
[[noreturn]] void read_without_memory(const std::string& path) {
  const ExrFile file = ExrFile::open(path);
  Plane plane(kData);
  const ExrRequest request{0, "H", plane.view()};
  test::exhaust_memory();
  int code = 1;
  try {
    file.read({&request, 1});
  } catch (const Error& error) {
    code = error.fault() == Fault::kMemory ? 0 : 2;
    std::fputs(error.what(), stderr);
  } catch (const std::bad_alloc&) {
    code = 3;
  }
  std::_Exit(code);
}

/// Ends the process: code 0 if read() returns the written values without threads.
[[noreturn]] void read_without_threads(const std::string& path) {
  test::make_threads_impossible();
  set_file_threads(4);
  Plane plane(kData);
  const ExrRequest request{0, "H", plane.view()};
  ExrFile::open(path).read({&request, 1});
  std::_Exit(plane.view().at(7, 70) == expected("H", 7, 70) ? 0 : 1);
}

class WantOfMemory : public ::testing::TestWithParam<Storage> {
 protected:
  void SetUp() override {
    if (test::kSanitized) GTEST_SKIP() << "a sanitizer has memory of its own";
    path_ = temporary("picture.exr");
    write_file(path_, GetParam());
  }

  std::string path_;
};

TEST_P(WantOfMemory, IsNoDamage) {
  EXPECT_EXIT(read_without_memory(path_), ::testing::ExitedWithCode(0),
              "picture.exr: needs more memory than there is");
}

TEST_P(WantOfMemory, IsReadWithFewerThreads) {
  EXPECT_EXIT(read_without_threads(path_), ::testing::ExitedWithCode(0), "");
}

INSTANTIATE_TEST_SUITE_P(
    , WantOfMemory,
    ::testing::Values(Storage{"Zip", Imf::ZIP_COMPRESSION}, Storage{"Piz", Imf::PIZ_COMPRESSION},
                      Storage{"Pxr24", Imf::PXR24_COMPRESSION},
                      Storage{"ZipTiles", Imf::ZIP_COMPRESSION, false, 16, 16}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace limpid::exr_test
