#include "job/shared_textures.h"

#include "limpid/core/error.h"

#include "files/content_hash.h"

namespace limpid {

bool has_environment(const SceneFile& scene) {
  if (scene.environment.empty()) return false;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(scene.environment, ignored)) {
    throw Error("plates.environment: " + scene.environment.string() + ": no such file");
  }
  return true;
}

SharedTextures::Held SharedTextures::kept(Kept& kept, const std::filesystem::path& path,
                                          double rotation,
                                          const std::function<LoadedTexture()>& load) {
  const std::lock_guard lock(mutex_);
  if (!kept.texture || kept.path != path || kept.rotation != rotation) {
    kept = {path, rotation, std::make_shared<const LoadedTexture>(load())};
  }
  return kept.texture;
}

SharedTextures::Held SharedTextures::wave_map(const Plan& plan, const Limits& limits) {
  if (!plan.reads_wave_map) return {};
  const std::filesystem::path path = plan.look.of<WaveNormals>().map;
  return kept(wave_map_, path, 0, [&] { return load_texture(path, limits); });
}

SharedTextures::Held SharedTextures::environment(const Plan& plan, const SceneFile& scene,
                                                 const Limits& limits) {
  if (!plan.reads_environment) return {};
  const double rotation = scene.environment_rotation;
  return kept(environment_, scene.environment, rotation,
              [&] { return load_environment(scene.environment, rotation, limits); });
}

std::string SharedTextures::hash_of(const std::filesystem::path& path) {
  const std::lock_guard lock(mutex_);
  std::string& hash = hashes_[path];
  if (hash.empty()) hash = hash_of_file(path);
  return hash;
}

}  // namespace limpid
