#include "limpid/files/text/scene_file.h"

#include "fuzz/harness.h"

namespace limpid::fuzz {

void scene(Bytes bytes) {
  SceneFile file;
  if (!accepts([&] { file = scene_from_toml(text_of(bytes), "scene.toml"); })) return;
  for (const auto& [role, name] : file.plates) {
    expect(!split_plate(name).file.empty(), "a plate has a file");
  }
  if (file.camera) accepts([&] { file.scene.camera = camera_for(*file.camera, {16, 9}); });
  const std::string text = to_toml(file.scene);
  const bool again = accepts([&] {
    SceneFile copy = scene_from_toml(text, "copy.toml");
    if (copy.camera) copy.scene.camera = camera_for(*copy.camera, {16, 9});
    expect(to_toml(copy.scene) == text, "a scene that was written reads back the same");
  });
  expect(again, "a scene that was written can be read");
}

}  // namespace limpid::fuzz
