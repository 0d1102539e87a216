#pragma once
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "limpid/core/error.h"

namespace limpid::test {

/// A folder of its own for the running test.
inline std::filesystem::path own_folder() {
  const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) /
                                       (std::string(info->test_suite_name()) + "." + info->name());
  std::filesystem::create_directories(folder);
  return folder;
}

/// A file in that folder with this text in it.
inline std::filesystem::path written(const std::string& name, const std::string& text) {
  const std::filesystem::path path = own_folder() / name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// The sentence of the Error that `work` throws, or "" when it throws none.
template <class Work>
std::string error_of(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace limpid::test
