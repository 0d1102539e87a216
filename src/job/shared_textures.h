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

/// Whether the scene file names surroundings. Throws Error if their file does not exist.
bool has_environment(const SceneFile& scene);

/// The files of the textures that a job reads; an empty path for a texture that it does not read.
struct TextureFiles {
  std::filesystem::path wave_map;     ///< the tiling normal map
  std::filesystem::path environment;  ///< the surroundings
  double rotation = 0;                ///< rad, of the environment
  Primaries primaries = kRec709;      ///< that the environment's light is made of
};
TextureFiles textures_read(const Plan& plan, const SceneFile& scene);

/// Textures as long as somebody holds them; none where no file is.
struct HeldTextures {
  std::shared_ptr<const LoadedTexture> wave_map, environment;
  void show_in(Frame& frame) const;
};

/// The textures of many frames: loaded when a job first reads them, and again only for another
/// file. Any number of threads may use it.
class SharedTextures {
 public:
  HeldTextures load(const TextureFiles& files, const Limits& limits = {});

  /// The hash of the bytes of such a file, as ExrFile::content_hash(): computed once. Throws Error.
  std::string hash_of(const std::filesystem::path& path);

 private:
  struct Kept {
    std::filesystem::path path;
    double rotation = 0;
    Primaries primaries = kRec709;
    std::shared_ptr<const LoadedTexture> texture;
  };
  std::shared_ptr<const LoadedTexture> kept(Kept& kept, const std::filesystem::path& path,
                                            double rotation, const Primaries& primaries,
                                            const std::function<LoadedTexture()>& load);

  std::mutex mutex_;
  Kept wave_map_, environment_;
  std::map<std::filesystem::path, std::string> hashes_;
};

/// The view of a loaded texture, if there is one.
inline Texture texture_of(const std::shared_ptr<const LoadedTexture>& held) {
  return held ? held->texture : Texture{};
}

}  // namespace limpid
