#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_file.h"

/// Files for the tests of reading, made with OpenEXR itself.
namespace limpid::exr_test {

/// The picture in those files: H half, F float, U uint, each exact in its type.
inline float expected(const std::string& channel, int x, int y) {
  if (channel == "H") return 0.25f * static_cast<float>(x - 3 * y);
  if (channel == "F") return 1e6f + 0.5f * static_cast<float>(7 * x + y);
  return static_cast<float>(1000 + 64 * y + x);
}

inline const Rect kData{-5, 3, 60, 147};
inline const Rect kDisplay{0, 0, 50, 100};

/// How a file keeps its pixels.
struct Storage {
  std::string name;
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  bool decreasing = false;
  int tile_width = 0, tile_height = 0;  ///< 0: scan lines
  bool mip = false;
  int part = 0;  ///< which of two parts holds the picture; 0: a file of one part
};

inline void PrintTo(const Storage& storage, std::ostream* out) { *out << storage.name; }

inline std::string temporary(const std::string& name) {
  const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
  std::string path = std::string(test.test_suite_name()) + "_" + test.name() + "_" + name;
  for (char& c : path) {
    if (c == '/') c = '_';
  }
  return ::testing::TempDir() + path;
}

void write_file(const std::string& path, const Storage& storage);
/// Luminance-chroma: A, and one color (0.5, 0.25, 0.125) everywhere.
void write_luminance_chroma(const std::string& path, bool tiled);
/// One deep part of 4x4 pixels with one sample each.
void write_deep(const std::string& path);

inline std::vector<char> bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void write_bytes(const std::filesystem::path& path, const std::vector<char>& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::ssize(bytes));
}

/// Opens a file and reads every channel of every part. Returns the error's text, or "".
inline std::string failure_of(const std::filesystem::path& path) {
  try {
    const ExrFile file = ExrFile::open(path);
    for (int part = 0; part < static_cast<int>(file.parts().size()); ++part) {
      const ExrPart& p = file.parts()[part];
      std::vector<std::string> names;
      for (const ExrChannel& channel : p.channels) names.push_back(channel.name);
      if (p.deep) {
        file.read_deep(part, names, [](const DeepBlock&) {});
        continue;
      }
      std::vector<Plane> planes;
      std::vector<ExrRequest> requests;
      for (const std::string& name : names) {
        planes.emplace_back(p.data);
        requests.push_back({part, name, planes.back().view()});
      }
      file.read(requests);
    }
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The text of the Error that `work` throws, or a sentence that no test expects.
template <class Work>
std::string error_of(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error was thrown";
}

}  // namespace limpid::exr_test
