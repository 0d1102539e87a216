#pragma once
#include <filesystem>
#include <string>

#include <gmock/gmock.h>

#include "limpid/files/gltf/gltf.h"

#include "files/exr/written.h"

namespace limpid::test {

/// Why a file of this text is refused, "" if it is not; the sentence begins with its path.
inline std::string error_of_text(const std::string& text, const Limits& limits = {}) {
  const std::filesystem::path path = written("scene.gltf", text);
  const std::string sentence = error_of([&] { load_gltf(path, limits); });
  EXPECT_THAT(sentence, testing::AnyOf("", testing::StartsWith(path.string() + ": ")));
  return sentence;
}

}  // namespace limpid::test
