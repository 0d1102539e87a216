#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "limpid/files/text/look_file.h"

#include "judge/report/subject.h"
#include "paths.h"

namespace limpid::test {

constexpr const char* kShippedLooks[] = {"physical", "fast", "realistic", "monogame", "rito"};

/// The look as it is shipped, but with hard edges: mixed edges are mixed after the pixels are made.
inline Look shipped_look(const std::string& name) {
  Look look = load_look(std::string(LIMPID_DATA) + "/looks/" + name + ".toml");
  look.water.edges = Water::Edges::kHard;
  return look;
}

/// Calls fn(name, subject) for each rendered bundled scene, and for the lagoon's plates.
template <class Fn>
void for_each_bundled(Size size, Fn&& fn) {
  const std::filesystem::path data = LIMPID_DATA;
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(data / "scenes")) {
    if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
  }
  std::sort(scenes.begin(), scenes.end());
  const auto executor = make_executor(1);
  for (const std::filesystem::path& scene : scenes) {
    Subject subject = Subject::of_scene(scene, size, data / "maps/sky.exr", *executor);
    fn(scene.stem().string(), subject);
  }
  Subject lagoon = Subject::of_plate(data / "plates/lagoon/lagoon.toml", size);
  fn("lagoon", lagoon);
}

}  // namespace limpid::test
