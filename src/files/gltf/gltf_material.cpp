#include "files/gltf/gltf_material.h"

#include <algorithm>

#include "limpid/core/error.h"

#include "files/gltf/gltf_extensions.h"

namespace limpid {
namespace {

// In the order of Shading.
constexpr std::string_view kShadings[] = {"flat", "textured", "lambert", "phong", "toon"};
constexpr std::string_view kAlphaModes[] = {"OPAQUE", "MASK", "BLEND"};
constexpr const char* kUnlit = "KHR_materials_unlit";
constexpr const char* kEmissiveStrength = "KHR_materials_emissive_strength";
constexpr const char* kSpecularGlossiness = "KHR_materials_pbrSpecularGlossiness";

constexpr int kUvSets = 2;  // that a Mesh has room for

Rgb<double> rgb(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

double number_from_0(const JsonPlace& place) {
  if (!(place.number() >= 0)) place.refuse("a number from 0 up");
  return place.number();
}

/// A sampler's wrap modes, in u and v.
struct GltfSampler {
  Wrap wrap_u = Wrap::kRepeat, wrap_v = Wrap::kRepeat;
};

Wrap wrap_of(const JsonPlace& sampler, std::string_view key) {
  const std::optional<JsonPlace> wrap = sampler.find(key);
  if (!wrap) return Wrap::kRepeat;
  switch (wrap->integer(0, INT32_MAX)) {
    case 10497:
      return Wrap::kRepeat;
    case 33071:
      return Wrap::kClamp;
    case 33648:
      return Wrap::kMirror;
    default:
      wrap->refuse("one of 10497, 33071, 33648");
  }
}

class Reader {
 public:
  Reader(const JsonPlace& root, Undrawable undrawable, ModelWarnings& warnings)
      : warnings_(warnings),
        textures_(root.list("textures")),
        texture_of_image_(root.count("images"), -1) {
    for (const JsonPlace& sampler : root.list("samplers")) {
      samplers_.push_back({wrap_of(sampler, "wrapS"), wrap_of(sampler, "wrapT")});
    }
    for (const JsonPlace& texture : textures_) {
      if (const auto source = texture.find("source")) source->index(texture_of_image_.size());
      if (const auto sampler = texture.find("sampler")) sampler->index(samplers_.size());
    }
    for (const JsonPlace& material : root.list("materials")) {
      try {
        add(material);
      } catch (const Error& error) {
        if (undrawable == Undrawable::kRefuse) throw;
        result_.materials.back().fault = error.what();
      }
    }
    result_.materials.emplace_back();
  }

  GltfMaterials take() { return std::move(result_); }

 private:
  void add(const JsonPlace& place) {
    GltfMaterial& read = result_.materials.emplace_back();
    Material& material = read.material;
    if (const auto name = place.find("name")) material.name = name->text();
    if (const auto sided = place.find("doubleSided")) material.double_sided = sided->boolean();
    if (const auto mode = place.find("alphaMode")) {
      material.alpha_mode = static_cast<AlphaMode>(mode->choice(kAlphaModes));
    }
    if (const auto cutoff = place.find("alphaCutoff")) {
      material.alpha_cutoff = number_from_0(*cutoff);
    }
    const auto extensions = place.find("extensions");
    const auto extension = [&](const char* name) {
      return extensions ? extensions->find(name) : std::nullopt;
    };
    const auto unlit = extension(kUnlit), diffuse = extension(kSpecularGlossiness);
    if (diffuse && !unlit) {
      warnings_.add(std::string(kSpecularGlossiness) + " is drawn by its diffuse color alone",
                    place.path());
      read_base(*diffuse, "diffuseFactor", "diffuseTexture", read);
    } else if (const auto base = place.find("pbrMetallicRoughness")) {
      read_base(*base, "baseColorFactor", "baseColorTexture", read);
      warn_of_map(*base, "metallicRoughnessTexture", "metallic-roughness", place);
    }
    if (unlit) {
      material.shading = material.base_texture < 0 ? Shading::kFlat : Shading::kTextured;
    } else {
      read_emission(place, extension(kEmissiveStrength), read);
      warn_of_map(place, "normalTexture", "normal", place);
      warn_of_map(place, "occlusionTexture", "occlusion", place);
    }
    if (extensions) warn_of_extensions(*extensions);
    if (const auto extras = place.extras()) read_extras(*extras, read);
  }

  void warn_of_map(const JsonPlace& holder, std::string_view key, const std::string& kind,
                   const JsonPlace& material) {
    if (holder.find(key)) warnings_.add(kind + " maps are not drawn", material.path());
  }

  void warn_of_extensions(const JsonPlace& extensions) {
    for (const std::string& name : extensions.keys()) {
      if (name == kUnlit || name == kSpecularGlossiness || name == kEmissiveStrength) continue;
      warnings_.add(name + " is not drawn", extensions.path());
    }
  }

  void read_base(const JsonPlace& base, const char* factor_key, const char* texture_key,
                 GltfMaterial& read) {
    Material& material = read.material;
    if (const auto factor = base.find(factor_key)) {
      const std::vector<double> color = factor->numbers(4);
      if (*std::min_element(color.begin(), color.end()) < 0) {
        factor->refuse("four numbers from 0 up");
      }
      material.base_color = rgb(color);
      material.alpha = color[3];
    }
    if (const auto texture = base.find(texture_key)) {
      material.base_texture = texture_of(*texture, read, material.base_lookup);
    }
  }

  void read_emission(const JsonPlace& place, const std::optional<JsonPlace>& strength,
                     GltfMaterial& read) {
    Material& material = read.material;
    if (const auto factor = place.find("emissiveFactor")) material.emission = rgb(factor->color());
    if (const auto times = strength ? strength->find("emissiveStrength") : std::nullopt) {
      material.emission = number_from_0(*times) * material.emission;
    }
    const auto texture = place.find("emissiveTexture");
    if (!texture || material.emission == Rgb<double>{0, 0, 0}) return;
    material.emissive_texture = texture_of(*texture, read, material.emissive_lookup);
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
      texture->expect_keys({"index", "texCoord", "extensions"});
      material.specular_texture = texture_of(*texture, read, material.specular_lookup);
    }
  }

  // The uv set of a texture lookup among the material's.
  static int uv_set_of(const JsonPlace& info, GltfMaterial& read) {
    const UvSource source = read_uv_source(info);
    const auto found = std::find(read.uvs.begin(), read.uvs.end(), source);
    const int place = static_cast<int>(found - read.uvs.begin());
    if (place >= kUvSets) {
      throw Error(info.path() + ": " + source.text() + " beside " + read.uvs[0].text() + " and " +
                  read.uvs[1].text() + ", expected at most two sets in one material");
    }
    if (found == read.uvs.end()) read.uvs.push_back(source);
    return place;
  }

  // The image of a texture; a packed image only if there is no other.
  int image_of(const JsonPlace& texture) const {
    const auto source = texture.find("source");
    if (source) return source->index(texture_of_image_.size());
    const auto packing = packing_of(texture);
    if (!packing) texture.at("source");
    throw Error(texture.path() + ": has a picture by " + *packing +
                " alone, which is not read, expected a source in PNG or JPEG");
  }

  // The index of its image in result_.images.
  int texture_of(const JsonPlace& info, GltfMaterial& read, TextureLookup& lookup) {
    const JsonPlace& texture = textures_[info.at("index").index(textures_.size())];
    lookup.uv_set = uv_set_of(info, read);
    if (const auto place = texture.find("sampler")) {
      const GltfSampler& sampler = samplers_[place->index(samplers_.size())];
      lookup.wrap_u = sampler.wrap_u;
      lookup.wrap_v = sampler.wrap_v;
    }
    const int image = image_of(texture);
    int& index = texture_of_image_[image];
    if (index < 0) {
      index = static_cast<int>(result_.images.size());
      result_.images.push_back(image);
    }
    read.textures.push_back(index);
    return index;
  }

  ModelWarnings& warnings_;
  std::vector<JsonPlace> textures_;
  std::vector<int> texture_of_image_;
  std::vector<GltfSampler> samplers_;
  GltfMaterials result_;
};

}  // namespace

GltfMaterials read_gltf_materials(const JsonPlace& root, Undrawable undrawable,
                                  ModelWarnings& warnings) {
  return Reader(root, undrawable, warnings).take();
}

}  // namespace limpid
