#include "load/gltf_material.h"

#include <algorithm>

#include "limpid/core/error.h"

namespace limpid {
namespace {

// In the order of Shading.
constexpr std::string_view kShadings[] = {"flat", "textured", "lambert", "phong", "toon"};
constexpr std::string_view kAlphaModes[] = {"OPAQUE", "MASK", "BLEND"};
constexpr const char* kUnlit = "KHR_materials_unlit";
constexpr std::int64_t kRepeat = 10497, kClamp = 33071, kMirror = 33648;

Rgb<double> rgb(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

bool repeats(const JsonPlace& sampler) {
  bool both = true;
  for (const std::string_view key : {"wrapS", "wrapT"}) {
    const std::optional<JsonPlace> wrap = sampler.find(key);
    if (!wrap) continue;
    const std::int64_t word = wrap->integer(0, INT32_MAX);
    if (word != kRepeat && word != kClamp && word != kMirror) {
      wrap->refuse("one of 10497, 33071, 33648");
    }
    both = both && word == kRepeat;
  }
  return both;
}

class Reader {
 public:
  Reader(const JsonPlace& root, ModelWarnings& warnings)
      : warnings_(warnings),
        textures_(root.list("textures")),
        texture_of_image_(root.count("images"), -1) {
    for (const JsonPlace& sampler : root.list("samplers")) {
      sampler_repeats_.push_back(repeats(sampler));
    }
    for (const JsonPlace& texture : textures_) {
      texture.at("source").index(texture_of_image_.size());
      if (const auto sampler = texture.find("sampler")) sampler->index(sampler_repeats_.size());
    }
    for (const JsonPlace& material : root.list("materials")) add(material);
    result_.materials.emplace_back();
  }

  GltfMaterials take() { return std::move(result_); }

 private:
  void add(const JsonPlace& place) {
    GltfMaterial& read = result_.materials.emplace_back();
    Material& material = read.material;
    if (const auto name = place.find("name")) material.name = name->text();
    if (const auto sided = place.find("doubleSided")) material.double_sided = sided->boolean();
    if (const auto mode = place.find("alphaMode")) read.opaque = mode->choice(kAlphaModes) == 0;
    if (const auto base = place.find("pbrMetallicRoughness")) read_base(*base, read);
    if (const auto extensions = place.find("extensions")) read_extensions(*extensions, read);
    if (const auto extras = place.extras()) read_extras(*extras, read);
  }

  void read_extensions(const JsonPlace& extensions, GltfMaterial& read) {
    Material& material = read.material;
    if (extensions.find(kUnlit)) {
      material.shading = material.base_texture < 0 ? Shading::kFlat : Shading::kTextured;
    }
    for (const std::string& name : extensions.keys()) {
      if (name != kUnlit) warnings_.add(name + " is not drawn", extensions.path());
    }
  }

  void read_base(const JsonPlace& base, GltfMaterial& read) {
    if (const auto factor = base.find("baseColorFactor")) {
      const std::vector<double> color = factor->numbers(4);
      if (*std::min_element(color.begin(), color.end()) < 0) {
        factor->refuse("four numbers from 0 up");
      }
      read.material.base_color = rgb(color);
    }
    if (const auto texture = base.find("baseColorTexture")) {
      read.material.base_texture = texture_of(*texture, read);
    }
  }

  void read_extras(const JsonPlace& extras, GltfMaterial& read) {
    extras.expect_keys({"shading", "ambient", "power", "specular", "specular_texture"});
    Material& material = read.material;
    if (const auto word = extras.find("shading")) {
      material.shading = static_cast<Shading>(word->choice(kShadings));
      if (material.shading == Shading::kTextured && material.base_texture < 0) {
        word->refuse("a baseColorTexture in the material");
      }
    }
    const bool lit = material.shading != Shading::kFlat && material.shading != Shading::kTextured;
    const bool shiny = material.shading == Shading::kPhong;
    const auto used = [&](const char* key, bool use, const char* shadings) {
      const auto found = extras.find(key);
      if (!found || use) return found;
      throw Error(found->path() + ": has no use with shading " +
                  std::string(kShadings[static_cast<int>(material.shading)]) +
                  ", expected shading " + shadings);
    };
    if (const auto ambient = used("ambient", lit, "lambert, phong or toon")) {
      material.ambient = rgb(ambient->color());
    }
    if (const auto power = used("power", shiny, "phong")) {
      if (!(power->number() > 0)) power->refuse("a number above 0");
      material.power = power->number();
    }
    if (const auto specular = used("specular", shiny, "phong")) {
      material.specular = rgb(specular->color());
    }
    if (const auto texture = used("specular_texture", shiny, "phong")) {
      texture->expect_keys({"index"});
      material.specular_texture = texture_of(*texture, read);
    }
  }

  // The place of its image in result_.images.
  int texture_of(const JsonPlace& info, GltfMaterial& read) {
    const JsonPlace& texture = textures_[info.at("index").index(textures_.size())];
    if (const auto set = info.find("texCoord")) {
      if (set->integer(0, INT32_MAX) != 0) set->refuse("0: only TEXCOORD_0 is supported");
    }
    const auto extensions = info.find("extensions");
    if (extensions && extensions->find("KHR_texture_transform")) {
      throw Error(info.path() +
                  ": KHR_texture_transform is not supported, expected it applied to the uvs");
    }
    if (const auto sampler = texture.find("sampler")) {
      read.repeats = read.repeats && sampler_repeats_[sampler->index(sampler_repeats_.size())];
    }
    const int image = texture.at("source").index(texture_of_image_.size());
    int& index = texture_of_image_[image];
    if (index < 0) {
      index = static_cast<int>(result_.images.size());
      result_.images.push_back(image);
    }
    return index;
  }

  ModelWarnings& warnings_;
  std::vector<JsonPlace> textures_;
  std::vector<int> texture_of_image_;
  std::vector<bool> sampler_repeats_;
  GltfMaterials result_;
};

}  // namespace

GltfMaterials read_gltf_materials(const JsonPlace& root, ModelWarnings& warnings) {
  return Reader(root, warnings).take();
}

}  // namespace limpid
