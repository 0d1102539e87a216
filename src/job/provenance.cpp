#include "job/provenance.h"

#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/core/simd.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/version.h"

#include "core/toml_text.h"
#include "files/content_hash.h"
#include "files/picture/byte_of.h"

namespace limpid {
namespace {

/// Hashes the numbers of a model, each list after its length.
class ModelHash {
 public:
  template <class... Numbers>
  void add(const Numbers&... numbers) {
    (hash_.add(&numbers, sizeof numbers), ...);
  }
  template <class T>
  void add_list(const std::vector<T>& list) {
    add(std::uint64_t{list.size()});
    hash_.add(list.data(), list.size() * sizeof(T));
  }
  void add_count(std::size_t count) { add(std::uint64_t{count}); }
  void add(const Rgb<double>& color) { add(color.r, color.g, color.b); }
  std::string text() const { return hash_.text(); }

 private:
  ContentHash hash_;
};

static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::vec2) == 8 && sizeof(glm::vec4) == 16 &&
                  sizeof(glm::dmat4) == 128,
              "lists of vectors are hashed as their numbers, without gaps");

/// Names do not count, nor parts that were left out: they are not drawn.
std::string hash_of_model(const Model& model) {
  ModelHash hash;
  hash.add_count(model.meshes.size());
  for (const Mesh& mesh : model.meshes) {
    hash.add_list(mesh.positions);
    hash.add_list(mesh.normals);
    hash.add_list(mesh.uvs);
    hash.add_list(mesh.second_uvs);
    hash.add_list(mesh.colors);
    hash.add_list(mesh.indices);
    hash.add(mesh.material);
  }
  hash.add_count(model.materials.size());
  for (const Material& m : model.materials) {
    hash.add(m.shading, m.base_texture, m.specular_texture, m.power, m.double_sided);
    hash.add(m.alpha_mode, m.alpha, m.alpha_cutoff, m.emissive_texture);
    hash.add(m.base_color);
    hash.add(m.ambient);
    hash.add(m.specular);
    hash.add(m.emission);
    for (const TextureLookup& lookup : {m.base_lookup, m.specular_lookup, m.emissive_lookup}) {
      hash.add(lookup.uv_set, lookup.wrap_u, lookup.wrap_v);
    }
  }
  hash.add_count(model.textures.size());
  for (const ModelTexture& texture : model.textures) {
    hash.add(texture.width, texture.height);
    hash.add_list(texture.rgba);
  }
  hash.add_count(model.instances.size());
  for (const Instance& instance : model.instances) {
    hash.add(instance.mesh, instance.world_from_mesh, instance.water);
  }
  hash.add(model.background);
  return hash.text();
}

std::string simd_line(std::string_view key, const std::string& simd) {
  return line(key, toml_text(simd.empty() ? simd_targets().front() : simd));
}

}  // namespace

std::string line(std::string_view key, const std::string& value) {
  return std::string(key) + " = " + value + "\n";
}

std::string aovs_line(const std::vector<Aov>& list, bool visible) {
  std::vector<std::string> names;
  for (const Aov aov : list) {
    names.push_back(toml_text(std::string(aovs()[static_cast<std::size_t>(aov)].name)));
  }
  if (visible) names.push_back(toml_text(std::string("visible")));
  return line("aovs", "[" + join(names) + "]");
}

HashedModel::HashedModel(const Model& named) : model(&named), hash(hash_of_model(named)) {}

Record record_of(const Scene& scene, const std::string& inputs, const std::string& options) {
  const std::string scene_text = to_toml(scene);
  return {{"limpid/version", kVersion},
          {"limpid/scene", scene_text},
          {"limpid/inputs", inputs},
          {"limpid/scene_hash", hash_of(scene_text + inputs)},
          {"limpid/options", options}};
}

void add_look(Record& record, const Look& look) {
  // The map by its name, without its folder; the inputs record its contents.
  Look recorded = look;
  std::string& map = recorded.of<WaveNormals>().map;
  map = std::filesystem::path(map).filename().string();
  record["limpid/look"] = to_toml(recorded);
}

void add_look(Record& record, const Look& look, const Plan& plan) {
  add_look(record, look);
  record["limpid/plan"] = to_text(plan);
}

std::string model_inputs(const HashedModel& model, Size size) {
  return line("model", toml_text(model.hash)) +
         line("size", "[" + std::to_string(size.width) + ", " + std::to_string(size.height) + "]");
}

std::string model_inputs(const HashedModel& model, const RenderOptions& options) {
  return model_inputs(model, options.size) + line("overscan", std::to_string(options.overscan)) +
         line("shadow_map", std::to_string(options.shadow_map_size));
}

std::string texture_inputs(const TextureFiles& files, SharedTextures& textures) {
  std::string text;
  if (!files.wave_map.empty()) {
    text += line("wave_map", toml_text(textures.hash_of(files.wave_map)));
  }
  if (!files.environment.empty()) {
    text += line("environment", "{file = " + toml_text(textures.hash_of(files.environment)) +
                                    ", rotation = " + toml_text(files.rotation) + "}");
  }
  return text;
}

/// A hash of the bytes that the view makes of light: black, and colors of -12 ... 6 stops in all
/// three. Files that the config names, such as tables, count by what they do.
std::string hash_of_view(const DisplayChoice& display) {
  constexpr int kSteps = 33;
  const auto light = [](int step) {
    return step == 0 ? 0.0f : static_cast<float>(std::exp2(-12 + step * 18.0 / (kSteps - 1)));
  };
  std::array<Plane, 3> colors;
  for (Plane& plane : colors) plane = Plane({0, 0, kSteps * kSteps, kSteps});
  for (int y = 0; y < kSteps; ++y) {
    for (int x = 0; x < kSteps * kSteps; ++x) {
      colors[0].view().at(x, y) = light(x % kSteps);
      colors[1].view().at(x, y) = light(x / kSteps);
      colors[2].view().at(x, y) = light(y);
    }
  }
  DisplayChoice plain = display;
  plain.exposure = 0;
  std::string bytes;
  const std::array<Plane, 3> shown =
      DisplayTransform(plain).displayed({colors[0].view(), colors[1].view(), colors[2].view()});
  for (const Plane& plane : shown) {
    for (int y = 0; y < kSteps; ++y) {
      for (int x = 0; x < kSteps * kSteps; ++x) {
        bytes += static_cast<char>(byte_of(plane.view().at(x, y)));
      }
    }
  }
  return hash_of(bytes);
}

/// A config is known by its contents, or where it is no file, as OpenColorIO's own are not, by its
/// name; its view also by what it makes of light. Hashed once a program, as DisplayTransform reads
/// the config: the frames of a sequence share the text.
std::string config_options(const DisplayChoice& display) {
  static std::mutex mutex;
  static std::map<std::pair<std::string, std::string>, std::string> known;
  const std::lock_guard lock(mutex);
  std::string& text = known[{display.config.string(), display.view}];
  if (text.empty()) {
    std::error_code ignored;
    const bool file = std::filesystem::is_regular_file(display.config, ignored);
    text = line("ocio", toml_text(file ? hash_of_file(display.config) : display.config.string())) +
           line("view", toml_text(display.view)) +
           line("view_hash", toml_text(hash_of_view(display)));
  }
  return text;
}

/// Nothing of the usual one.
std::string display_options(const DisplayChoice& display) {
  std::string text;
  if (display.exposure != 0) text += line("exposure", toml_text(display.exposure));
  return display.config.empty() ? text : text + config_options(display);
}

std::string picture_options(const OutputChoice& choice, const std::string& gpu) {
  const bool lanes = choice.runner != Runner::kReference;
  return line("runner", toml_text(std::string(runner_name(choice.runner)))) +
         (lanes ? simd_line("simd", choice.simd) : "") +
         (gpu.empty() ? "" : line("gpu", toml_text(gpu))) +
         line("max_error", toml_text(choice.max_error)) +
         (choice.wave_samples > 1 ? line("wave_samples", std::to_string(choice.wave_samples))
                                  : "") +
         (choice.overscan > 0 ? line("overscan", std::to_string(choice.overscan)) : "") +
         aovs_line(choice.aovs) + (choice.shows() ? display_options(choice.display) : "") +
         (choice.aov_names != AovNames::kLimpid
              ? line("aov_names", toml_text(std::string(aov_names_name(choice.aov_names))))
              : "") +
         file_options(choice.compression, choice.store_float);
}

std::string raster_options(const std::string& simd) { return simd_line("raster_simd", simd); }

std::string file_options(const std::string& compression, bool store_float) {
  return line("compression", toml_text(compression)) +
         line("pixels", toml_text(std::string(store_float ? "float" : "half")));
}

}  // namespace limpid
