#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/files/gltf/gltf.h"
#include "limpid/files/picture/image_file.h"

#include "files/exr/written.h"
#include "files/gltf/gltf_error.h"
#include "files/gltf/made_gltf.h"

/// Opacity, emission, wrapping, sets of uvs, vertex colors.

namespace limpid {
namespace {

using nlohmann::json;
using test::error_of_text;
using test::own_folder;
using test::square_gltf;
using test::written;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Model load(const json& gltf) { return load_gltf(written("scene.gltf", gltf.dump())); }

/// The square with this material, and two pictures of one texel each, textures 0 and 1.
json square_with(const char* material) {
  json gltf = square_gltf();
  gltf["images"] = json::array();
  for (const std::string name : {"a.png", "b.png"}) {
    Plane plane(Rect{0, 0, 1, 1});
    plane.view().at(0, 0) = 1;
    write_image8(own_folder() / name, {plane.view(), plane.view(), plane.view()});
    gltf["images"].push_back({{"uri", name}});
  }
  gltf["textures"] = json::parse(R"([{"source": 0}, {"source": 1}])");
  gltf["materials"] = json::array({json::parse(material)});
  gltf["meshes"][0]["primitives"][0]["material"] = 0;
  return gltf;
}

Material material_of(const char* text) { return load(square_with(text)).materials.at(0); }

/// One more attribute of the square.
template <class T>
void add_attribute(json& gltf, const std::string& key, const std::vector<T>& values, int component,
                   const std::string& type) {
  const std::string bytes = test::bytes_of(values);
  gltf["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", test::data_uri(bytes)}});
  gltf["bufferViews"].push_back(
      {{"buffer", gltf["buffers"].size() - 1}, {"byteLength", bytes.size()}});
  gltf["accessors"].push_back({{"bufferView", gltf["bufferViews"].size() - 1},
                               {"componentType", component},
                               {"normalized", component != 5126},
                               {"type", type},
                               {"count", 4}});
  gltf["meshes"][0]["primitives"][0]["attributes"][key] = gltf["accessors"].size() - 1;
}

const std::vector<float> kOtherUvs{0, 0, 2, 0, 2, -3, 0, -3};

// --- opacity ---

TEST(GltfMaterials, ReadsAlphaModes) {
  const Material plain = material_of(R"({})");
  EXPECT_EQ(plain.alpha_mode, AlphaMode::kOpaque);
  EXPECT_EQ(plain.alpha, 1);
  EXPECT_EQ(plain.alpha_cutoff, 0.5);
  const Material mask = material_of(R"({"alphaMode": "MASK", "alphaCutoff": 0.25,
      "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.75]}})");
  EXPECT_EQ(mask.alpha_mode, AlphaMode::kMask);
  EXPECT_EQ(mask.alpha_cutoff, 0.25);
  EXPECT_EQ(mask.alpha, 0.75);
  EXPECT_EQ(material_of(R"({"alphaMode": "BLEND"})").alpha_mode, AlphaMode::kBlend);
  EXPECT_EQ(material_of(R"({"alphaMode": "OPAQUE", "pbrMetallicRoughness":
                           {"baseColorFactor": [1, 1, 1, 0.5]}})")
                .alpha_mode,
            AlphaMode::kOpaque);
}

TEST(GltfMaterials, RefusesACutoffBelow0) {
  EXPECT_THAT(error_of_text(square_with(R"({"alphaMode": "MASK", "alphaCutoff": -1})").dump()),
              HasSubstr("materials[0].alphaCutoff = -1: expected a number from 0 up"));
}

// --- emission ---

TEST(GltfMaterials, ReadsEmission) {
  const Material lamp = material_of(R"({"emissiveFactor": [1, 0.5, 0], "emissiveTexture":
      {"index": 1}, "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}})");
  EXPECT_EQ(lamp.emission, (Rgb<double>{4, 2, 0}));
  EXPECT_EQ(lamp.emissive_texture, 0);
  EXPECT_EQ(lamp.base_texture, -1);
}

TEST(GltfMaterials, LeavesOutEmissionThatIsBlackOrUnlit) {
  const Model black = load(square_with(R"({"emissiveTexture": {"index": 1}})"));
  EXPECT_EQ(black.materials[0].emissive_texture, -1);
  EXPECT_TRUE(black.textures.empty());
  const Material unlit =
      material_of(R"({"emissiveFactor": [1, 1, 1], "extensions": {"KHR_materials_unlit": {}}})");
  EXPECT_EQ(unlit.emission, (Rgb<double>{0, 0, 0}));
  EXPECT_EQ(unlit.shading, Shading::kFlat);
}

TEST(GltfMaterials, RefusesDarkStrength) {
  EXPECT_THAT(error_of_text(square_with(R"({"extensions": {"KHR_materials_emissive_strength":
                                            {"emissiveStrength": -2}}})")
                                .dump()),
              HasSubstr("emissiveStrength = -2: expected a number from 0 up"));
}

// --- specular-glossiness ---

TEST(GltfMaterials, DrawsSpecularGlossinessByItsDiffuse) {
  const Model model = load(square_with(R"({"alphaMode": "BLEND",
      "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1], "baseColorTexture": {"index": 0}},
      "extensions": {"KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0.5, 0.25, 1, 0.75], "diffuseTexture": {"index": 1},
        "specularGlossinessTexture": {"index": 0}}}})"));
  EXPECT_EQ(model.materials[0].base_color, (Rgb<double>{0.5, 0.25, 1}));
  EXPECT_EQ(model.materials[0].alpha, 0.75);
  EXPECT_EQ(model.materials[0].base_texture, 0);
  EXPECT_EQ(model.textures.size(), 1u);
  EXPECT_THAT(model.warnings,
              ElementsAre("KHR_materials_pbrSpecularGlossiness is drawn by its diffuse color "
                          "alone: materials[0]"));
}

TEST(GltfMaterials, MayBeRequired) {
  json gltf = square_with(R"({})");
  gltf["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness",
                                "KHR_materials_emissive_strength"};
  EXPECT_EQ(load(gltf).instances.size(), 1u);
}

// --- warnings ---

TEST(GltfMaterials, TellsOfMapsThatAreNotDrawn) {
  json gltf = square_with(R"({"normalTexture": {"index": 0}, "occlusionTexture": {"index": 0},
      "pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}})");
  gltf["materials"].push_back({{"normalTexture", {{"index", 0}}}});
  EXPECT_THAT(load(gltf).warnings,
              ElementsAre("metallic-roughness maps are not drawn: materials[0]",
                          "normal maps are not drawn: materials[0], materials[1]",
                          "occlusion maps are not drawn: materials[0]"));
  EXPECT_THAT(load(square_with(R"({"alphaMode": "MASK", "emissiveFactor": [1, 1, 1],
      "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}}})"))
                  .warnings,
              IsEmpty());
}

// --- textures ---

TEST(GltfMaterials, ReadsHowTexturesWrap) {
  json gltf = square_with(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
      "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 1}})");
  gltf["samplers"] = json::parse(R"([{"wrapS": 33071, "wrapT": 33648}, {"wrapT": 33071}])");
  gltf["textures"][0]["sampler"] = 0;
  gltf["textures"][1]["sampler"] = 1;
  const Material m = load(gltf).materials[0];
  EXPECT_EQ(m.base_lookup, (TextureLookup{0, Wrap::kClamp, Wrap::kMirror}));
  EXPECT_EQ(m.emissive_lookup, (TextureLookup{0, Wrap::kRepeat, Wrap::kClamp}));
}

TEST(GltfMaterials, LetsUvsLeaveTexturesThatDoNotRepeat) {
  json gltf = square_with(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})");
  gltf["samplers"] = json::parse(R"([{"wrapS": 33071, "wrapT": 33648}])");
  gltf["textures"][0]["sampler"] = 0;
  add_attribute(gltf, "TEXCOORD_0", kOtherUvs, 5126, "VEC2");
  EXPECT_EQ(load(gltf).meshes.at(0).uvs[2], glm::vec2(2, -3));
}

TEST(GltfMaterials, ReadsTheSetOfUvsThatATextureAsksFor) {
  json gltf =
      square_with(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}}})");
  EXPECT_THAT(error_of_text(gltf.dump()), HasSubstr("meshes[0] 'square': expected TEXCOORD_1"));
  add_attribute(gltf, "TEXCOORD_1", kOtherUvs, 5126, "VEC2");
  const Model model = load(gltf);
  // One set alone is the first that the raster pass knows.
  EXPECT_EQ(model.materials[0].base_lookup.uv_set, 0);
  EXPECT_EQ(model.meshes[0].uvs[1], glm::vec2(2, 0));
  EXPECT_TRUE(model.meshes[0].second_uvs.empty());
}

TEST(GltfMaterials, ReadsTwoSetsOfUvs) {
  json gltf = square_with(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
      "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 1, "texCoord": 1}})");
  add_attribute(gltf, "TEXCOORD_1", kOtherUvs, 5126, "VEC2");
  const Model model = load(gltf);
  EXPECT_EQ(model.materials[0].base_lookup.uv_set, 0);
  EXPECT_EQ(model.materials[0].emissive_lookup.uv_set, 1);
  EXPECT_EQ(model.meshes[0].uvs[1], glm::vec2(1, 1));
  EXPECT_EQ(model.meshes[0].second_uvs[1], glm::vec2(2, 0));
}

TEST(GltfMaterials, RefusesAThirdSetOfUvs) {
  const json gltf = square_with(
      R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 2}},
          "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 1, "texCoord": 1},
          "extras": {"limpid": {"shading": "phong", "specular_texture": {"index": 0}}}})");
  EXPECT_THAT(error_of_text(gltf.dump()),
              HasSubstr("materials[0].extras.limpid.specular_texture: TEXCOORD_0 beside TEXCOORD_2 "
                        "and TEXCOORD_1, expected at most two sets in one material"));
}

// --- vertex colors ---

TEST(GltfMaterials, ReadsVertexColors) {
  json floats = square_with(R"({})");
  add_attribute<float>(floats, "COLOR_0", {1, 0, 0, 0, 2, 0, 0, 0, -1, 1, 1, 1}, 5126, "VEC3");
  const Mesh three = load(floats).meshes.at(0);
  ASSERT_EQ(three.colors.size(), 4u);
  EXPECT_EQ(three.colors[1], glm::vec4(0, 2, 0, 1));
  EXPECT_EQ(three.colors[2], glm::vec4(0, 0, 0, 1));  // nothing is darker than black
  json bytes = square_with(R"({})");
  add_attribute<std::uint8_t>(bytes, "COLOR_0",
                              {255, 0, 51, 102, 0, 0, 0, 0, 255, 255, 255, 255, 1, 2, 3, 4}, 5121,
                              "VEC4");
  EXPECT_EQ(load(bytes).meshes.at(0).colors.at(0), glm::vec4(1, 0, 0.2f, 0.4f));
  json shorts = square_with(R"({})");
  add_attribute<std::uint16_t>(
      shorts, "COLOR_0", {65535, 0, 13107, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 5123, "VEC4");
  EXPECT_EQ(load(shorts).meshes.at(0).colors.at(0), glm::vec4(1, 0, 0.2f, 0));
}

TEST(GltfMaterials, DropsColorsThatAreWhite) {
  json gltf = square_with(R"({})");
  add_attribute(gltf, "COLOR_0", std::vector<float>(16, 1.0f), 5126, "VEC4");
  EXPECT_TRUE(load(gltf).meshes.at(0).colors.empty());
}

TEST(GltfMaterials, RefusesColorsThatAreNone) {
  json gltf = square_with(R"({})");
  gltf["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 2;
  EXPECT_THAT(error_of_text(gltf.dump()),
              HasSubstr("attributes.COLOR_0 = 2: expected an accessor of VEC3 or VEC4 float"));
  std::vector<float> colors(12, 1.0f);
  colors[4] = std::numeric_limits<float>::quiet_NaN();
  add_attribute(gltf, "COLOR_0", colors, 5126, "VEC3");
  EXPECT_THAT(error_of_text(gltf.dump()),
              HasSubstr("meshes[0] 'square' vertex 1: color nan, expected a number"));
}

}  // namespace
}  // namespace limpid
