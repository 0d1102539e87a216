#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "limpid/files/text/scene_file.h"
#include "limpid/plan/plan.h"
#include "limpid/plate/texture.h"

namespace limpid {

/// Whether the scene file names surroundings. Throws Error when it does and they are not there.
bool has_environment(const SceneFile& scene);

/// The textures that plans look up, kept from frame to frame: loaded when a plan first reads them,
/// and again only where another file is meant. Empty for plans that do not. Any threads may ask.
class SharedTextures {
 public:
  using Held = std::shared_ptr<const LoadedTexture>;

  /// The tiling normal map.
  Held wave_map(const Plan& plan, const Limits& limits = {});
  /// The surroundings.
  Held environment(const Plan& plan, const SceneFile& scene, const Limits& limits = {});

  /// The hash of the bytes of such a file, as ExrFile::content_hash(): taken once. Throws Error.
  std::string hash_of(const std::filesystem::path& path);

 private:
  struct Kept {
    std::filesystem::path path;
    double rotation = 0;
    Held texture;
  };
  Held kept(Kept& kept, const std::filesystem::path& path, double rotation,
            const std::function<LoadedTexture()>& load);

  std::mutex mutex_;
  Kept wave_map_, environment_;
  std::map<std::filesystem::path, std::string> hashes_;
};

/// The view of what is held, if anything is.
inline Texture texture_of(const SharedTextures::Held& held) {
  return held ? held->texture : Texture{};
}

}  // namespace limpid
