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

TextureFiles textures_read(const Plan& plan, const SceneFile& scene) {
  TextureFiles files;
  if (plan.reads_wave_map) files.wave_map = plan.look.of<WaveNormals>().map;
  if (plan.reads_environment) {
    files.environment = scene.environment;
    files.rotation = scene.environment_rotation;
    files.primaries = plan.primaries;
  }
  return files;
}

void HeldTextures::show_in(Frame& frame) const {
  frame.wave_map = texture_of(wave_map);
  frame.environment = texture_of(environment);
}

std::shared_ptr<const LoadedTexture> SharedTextures::kept(
    Kept& kept, const std::filesystem::path& path, double rotation, const Primaries& primaries,
    const std::function<LoadedTexture()>& load) {
  if (path.empty()) return {};
  const std::lock_guard lock(mutex_);
  if (!kept.texture || kept.path != path || kept.rotation != rotation ||
      kept.primaries != primaries) {
    kept = {path, rotation, primaries, std::make_shared<const LoadedTexture>(load())};
  }
  return kept.texture;
}

HeldTextures SharedTextures::load(const TextureFiles& files, const Limits& limits) {
  return {kept(wave_map_, files.wave_map, 0, kRec709,
               [&] { return load_texture(files.wave_map, limits); }),
          kept(environment_, files.environment, files.rotation, files.primaries, [&] {
            return load_environment(files.environment, files.rotation, files.primaries, limits);
          })};
}

std::string SharedTextures::hash_of(const std::filesystem::path& path) {
  const std::lock_guard lock(mutex_);
  std::string& hash = hashes_[path];
  if (hash.empty()) hash = hash_of_file(path);
  return hash;
}

}  // namespace limpid
