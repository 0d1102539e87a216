#include "limpid/files/gltf/gltf.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/files/picture/image_file.h"

#include "files/exr/written.h"
#include "files/gltf/made_gltf.h"
#include "paths.h"

namespace limpid {
namespace {

using nlohmann::json;
using test::error_of;
using test::glb;
using test::own_folder;
using test::Square;
using test::square_gltf;
using test::written;
using testing::ElementsAre;
using testing::HasSubstr;

namespace fs = std::filesystem;

Model load(const json& gltf) { return load_gltf(written("scene.gltf", gltf.dump())); }

glm::dvec3 point(const glm::dmat4& matrix, glm::dvec3 p) { return matrix * glm::dvec4(p, 1); }

void expect_near(glm::dvec3 value, glm::dvec3 expected, double tolerance = 1e-12) {
  EXPECT_LT(glm::length(value - expected), tolerance)
      << value.x << " " << value.y << " " << value.z << ", expected " << expected.x << " "
      << expected.y << " " << expected.z;
}

std::string file_bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// 2 x 2: red, half grey; black, white.
fs::path write_checks(const std::string& name) {
  std::vector<Plane> planes;
  const float values[3][4] = {{1, 0.5f, 0, 1}, {0, 0.5f, 0, 1}, {0, 0.5f, 0, 1}};
  std::vector<View<const float>> views;
  for (const auto& channel : values) {
    planes.emplace_back(Rect{0, 0, 2, 2});
    for (int i = 0; i < 4; ++i) planes.back().view().at(i % 2, i / 2) = channel[i];
  }
  for (const Plane& plane : planes) views.push_back(plane.view());
  write_image8(own_folder() / name, views);
  return own_folder() / name;
}

json textured(const std::string& uri) {
  json gltf = square_gltf();
  gltf["images"] = {{{"uri", uri}}};
  gltf["textures"] = {{{"source", 0}}};
  gltf["materials"] = json::parse(
      R"([{"name": "sheet", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
  gltf["meshes"][0]["primitives"][0]["material"] = 0;
  return gltf;
}

json with_material(const char* material) {
  json gltf = textured(write_checks("checks.png").filename().string());
  gltf["materials"].push_back(json::parse(material));
  return gltf;
}

Material material_of(const char* text) { return load(with_material(text)).materials.at(1); }

// --- geometry ---

TEST(Gltf, ReadsASquare) {
  const Model model = load(square_gltf());
  ASSERT_EQ(model.meshes.size(), 1u);
  const Mesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.name, "square");
  EXPECT_EQ(mesh.positions[2], glm::vec3(1, 1, 0));
  EXPECT_EQ(mesh.normals[3], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.uvs[0], glm::vec2(0, 1));
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2, 0, 2, 3));
  ASSERT_EQ(model.instances.size(), 1u);
  EXPECT_EQ(model.instances[0].world_from_mesh, glm::dmat4(1.0));
  EXPECT_FALSE(model.instances[0].water);
  EXPECT_EQ(model.materials.at(mesh.material).shading, Shading::kLambert);
  EXPECT_EQ(model.materials.at(mesh.material).base_color, (Rgb<double>{1, 1, 1}));
  EXPECT_FALSE(model.camera);
  EXPECT_FALSE(model.sun);
  EXPECT_EQ(model.background, (Rgb<double>{0.5, 0.7, 1.0}));
  EXPECT_EQ(model.skipped_triangles, 0);
  EXPECT_THAT(model.warnings, ElementsAre());
}

TEST(Gltf, ReadsBuffersBesideTheFileAndInBinaries) {
  const Square square;
  json gltf = square_gltf();
  fs::create_directories(own_folder() / "parts");
  written("parts/the +square%.bin", square.bytes() + "more than byteLength");
  gltf["buffers"][0]["uri"] = "parts/the%20+square%25.bin";
  EXPECT_THAT(load(gltf).meshes.at(0).indices, ElementsAre(0, 1, 2, 0, 2, 3));
  gltf["buffers"][0].erase("uri");
  const Model model = load_gltf(written("scene.glb", glb(gltf.dump(), square.bytes())));
  EXPECT_THAT(model.meshes.at(0).indices, ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(Gltf, ReadsTrianglesWithoutIndicesNormalsOrUvs) {
  json gltf = square_gltf();
  gltf["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 0}}}};
  gltf["accessors"][0]["count"] = 3;
  const Mesh mesh = load(gltf).meshes.at(0);
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.uvs.empty());
}

TEST(Gltf, ReadsSmallIndicesAndNormalizedUvs) {
  json gltf = square_gltf();
  std::string bytes = test::bytes_of(Square().positions);
  bytes += std::string("\x00\xFF\x00\x00\xFF\xFF\x00\x00\xFF\x00\x00\x00\x33\x00\x00\x00", 16);
  bytes += std::string("\x00\x01\x02\x00\x02\x03", 6);
  gltf["buffers"] = {{{"byteLength", bytes.size()}, {"uri", test::data_uri(bytes)}}};
  gltf["bufferViews"] = json::parse(R"([
    {"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 16, "byteStride": 4},
    {"buffer": 0, "byteOffset": 64, "byteLength": 6}])");
  gltf["accessors"] = json::parse(R"([
    {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4},
    {"bufferView": 1, "componentType": 5121, "normalized": true, "type": "VEC2", "count": 4},
    {"bufferView": 2, "componentType": 5121, "type": "SCALAR", "count": 6}])");
  gltf["meshes"][0]["primitives"][0] =
      json::parse(R"({"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2})");
  const Mesh mesh = load(gltf).meshes.at(0);
  EXPECT_EQ(mesh.uvs[1], glm::vec2(1, 1));
  EXPECT_EQ(mesh.uvs[3], glm::vec2(0.2f, 0));
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(Gltf, SkipsAndCountsTrianglesWithoutArea) {
  Square square;
  square.indices = {0, 1, 2, 3, 3, 1};
  const Model model = load(square_gltf(square));
  EXPECT_THAT(model.meshes.at(0).indices, ElementsAre(0, 1, 2));
  EXPECT_EQ(model.skipped_triangles, 1);
  square.positions = {0, 0, 0, 1, 1, 1, 2, 2, 2, 5, 5, 5};
  const Model line = load(square_gltf(square));
  EXPECT_TRUE(line.meshes.empty());
  EXPECT_TRUE(line.instances.empty());
  EXPECT_EQ(line.skipped_triangles, 2);
}

TEST(Gltf, TakesTheTrianglesForAZeroNormal) {
  Square square;
  square.normals[5] = 0;
  EXPECT_EQ(load(square_gltf(square)).meshes.at(0).normals[1], glm::vec3(0, 0, 1));
}

TEST(Gltf, MultipliesTheMatricesOfNodes) {
  json gltf = square_gltf();
  const double s = std::sqrt(0.5);  // 90 degrees about +Y
  gltf["nodes"] = json::array({{{"translation", {10, 0, 0}}, {"children", {1}}},
                               {{"mesh", 0}, {"rotation", {0, s, 0, s}}, {"scale", {2, 3, 4}}}});
  const glm::dmat4 world = load(gltf).instances.at(0).world_from_mesh;
  expect_near(point(world, {1, 1, 1}), {14, 3, -2});
  gltf["nodes"][0] = {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 0, 1}},
                      {"children", {1}}};
  expect_near(point(load(gltf).instances.at(0).world_from_mesh, {1, 1, 1}), {4, 8, -2});
}

TEST(Gltf, KeepsTheFrontOfMirroredMeshes) {
  json gltf = square_gltf();
  gltf["nodes"] =
      json::array({{{"mesh", 0}, {"children", {1}}}, {{"mesh", 0}, {"scale", {1, -1, 1}}}});
  const Model model = load(gltf);
  ASSERT_EQ(model.instances.size(), 2u);
  ASSERT_EQ(model.meshes.size(), 2u);
  const Instance& mirrored = model.instances[1];
  const Mesh& mesh = model.meshes[mirrored.mesh];
  EXPECT_GT(glm::determinant(glm::dmat3(mirrored.world_from_mesh)), 0);
  // glTF 2.0, 3.7.4: the front of a mirrored triangle stays the side that it was.
  const glm::dvec3 a = point(mirrored.world_from_mesh, mesh.positions[mesh.indices[0]]);
  const glm::dvec3 b = point(mirrored.world_from_mesh, mesh.positions[mesh.indices[1]]);
  const glm::dvec3 c = point(mirrored.world_from_mesh, mesh.positions[mesh.indices[2]]);
  EXPECT_GT(glm::cross(b - a, c - a).z, 0);
  double lowest = 0;
  for (const glm::vec3 p : mesh.positions) {
    lowest = std::min(lowest, point(mirrored.world_from_mesh, p).y);
  }
  EXPECT_EQ(lowest, -1);
}

TEST(Gltf, HidesWhatHasScaleZero) {
  json gltf = square_gltf();
  gltf["nodes"][0]["scale"] = {0, 0, 0};
  const Model model = load(gltf);
  EXPECT_TRUE(model.instances.empty());
  EXPECT_EQ(model.skipped_triangles, 2);
}

TEST(Gltf, SharesMeshesAndSplitsPrimitives) {
  json gltf = square_gltf();
  gltf["meshes"][0]["primitives"].push_back(gltf["meshes"][0]["primitives"][0]);
  gltf["scenes"][0]["nodes"] = {0, 1};
  gltf["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 1}}});
  const Model model = load(gltf);
  EXPECT_EQ(model.meshes.size(), 2u);
  EXPECT_EQ(model.instances.size(), 4u);
}

TEST(Gltf, DrawsOnlyTheDefaultScene) {
  json gltf = square_gltf();
  gltf["nodes"].push_back({{"mesh", 0}, {"translation", {7, 0, 0}}});
  gltf["scenes"].push_back({{"nodes", {1}}});
  gltf["scene"] = 1;
  const Model model = load(gltf);
  ASSERT_EQ(model.instances.size(), 1u);
  EXPECT_EQ(model.instances[0].world_from_mesh[3].x, 7);
}

TEST(Gltf, GoesThroughLongChainsOfNodes) {
  json gltf = square_gltf();
  constexpr int kNodes = 20000;
  gltf["nodes"] = json::array();
  for (int i = 0; i + 1 < kNodes; ++i) {
    gltf["nodes"].push_back({{"translation", {1, 0, 0}}, {"children", {i + 1}}});
  }
  gltf["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(load(gltf).instances.at(0).world_from_mesh[3].x, kNodes - 1);
}

// --- camera, sun, water, background ---

TEST(Gltf, ReadsAPerspectiveCamera) {
  json gltf = square_gltf();
  gltf["cameras"] = json::parse(R"([{"type": "perspective", "perspective":
    {"yfov": 1.2, "aspectRatio": 1.5, "znear": 0.1, "zfar": 50}}])");
  gltf["nodes"].push_back({{"camera", 0}, {"translation", {1, 2, 3}}, {"scale", {2, 2, 2}}});
  gltf["nodes"].push_back({{"camera", 0}, {"translation", {9, 9, 9}}});
  gltf["scenes"][0]["nodes"] = {0, 1, 2};
  const Camera camera = load(gltf).camera.value();
  expect_near(camera.eye(), {1, 2, 3});
  EXPECT_EQ(camera.clip, ClipSpace::kGl);
  EXPECT_EQ(camera.projection, perspective(1.2, 1.5, 0.1, 50, ClipSpace::kGl));
  json& lens = gltf["cameras"][0]["perspective"];
  lens.erase("zfar");
  lens.erase("aspectRatio");
  EXPECT_EQ(load(gltf).camera->projection,
            perspective(1.2, 1, 0.1, std::numeric_limits<double>::infinity(), ClipSpace::kGl));
}

TEST(Gltf, ReadsAnOrthographicCamera) {
  json gltf = square_gltf();
  gltf["cameras"] = json::parse(R"([{"type": "orthographic", "orthographic":
    {"xmag": 4, "ymag": 3, "znear": 0, "zfar": 100}}])");
  gltf["nodes"][0]["camera"] = 0;
  const Camera camera = load(gltf).camera.value();
  EXPECT_EQ(camera.projection, orthographic(8, 6, 0, 100, ClipSpace::kGl));
}

TEST(Gltf, TakesTheFirstDirectionalLightAsTheSun) {
  json gltf = square_gltf();
  gltf["extensionsUsed"] = {"KHR_lights_punctual"};
  gltf["extensionsRequired"] = {"KHR_lights_punctual"};
  gltf["extensions"] = json::parse(R"({"KHR_lights_punctual": {"lights": [
    {"type": "point"}, {"type": "directional", "color": [1, 0.5, 0.25], "intensity": 3},
    {"type": "directional"}]}})");
  for (const int light : {0, 1, 2}) {
    // 90 degrees about +X: the light shines down, the sun is where +Z went.
    gltf["nodes"].push_back({{"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                             {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
  }
  gltf["scenes"][0]["nodes"] = {0, 1, 2, 3};
  const Sun sun = load(gltf).sun.value();
  expect_near(sun.direction, {0, 1, 0});
  EXPECT_EQ(sun.color, (Rgb<double>{3, 1.5, 0.75}));
}

TEST(Gltf, MarksWaterAndTakesTheBackground) {
  json gltf = square_gltf();
  gltf["nodes"][0]["extras"] = json::parse(R"({"limpid": {"water": true}, "other": 1})");
  gltf["scenes"][0]["extras"] = json::parse(R"({"limpid": {"background": [0.1, 3000000000, 2]}})");
  gltf["materials"] = json::parse(R"([{"alphaMode": "BLEND"}])");
  gltf["meshes"][0]["primitives"][0]["material"] = 0;
  const Model model = load(gltf);
  EXPECT_TRUE(model.instances.at(0).water);
  EXPECT_EQ(model.background, (Rgb<double>{0.1, 3e9, 2}));
}

// --- materials ---

TEST(Gltf, ReadsMaterials) {
  const Material plain = material_of(
      R"({"name": "red", "doubleSided": true, "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0.25, 1]}})");
  EXPECT_EQ(plain.name, "red");
  EXPECT_TRUE(plain.double_sided);
  EXPECT_EQ(plain.shading, Shading::kLambert);
  EXPECT_EQ(plain.base_color, (Rgb<double>{1, 0.5, 0.25}));
  EXPECT_EQ(plain.base_texture, -1);
  const Material phong = material_of(
      R"({"extras": {"limpid": {"shading": "phong", "power": 3000000000, "ambient": [0.1, 0.2, 0.3],
          "specular": [1, 2, 3], "specular_texture": {"index": 0}}}})");
  EXPECT_EQ(phong.shading, Shading::kPhong);
  EXPECT_EQ(phong.power, 3e9);
  EXPECT_EQ(phong.ambient, (Rgb<double>{0.1, 0.2, 0.3}));
  EXPECT_EQ(phong.specular, (Rgb<double>{1, 2, 3}));
  EXPECT_EQ(phong.specular_texture, 0);
  EXPECT_EQ(material_of(R"({"extras": {"limpid": {"shading": "toon"}}})").shading, Shading::kToon);
  EXPECT_EQ(material_of(R"({"extras": {"limpid": {"shading": "flat"}}})").shading, Shading::kFlat);
  EXPECT_EQ(material_of(R"({"extensions": {"KHR_materials_unlit": {}}})").shading, Shading::kFlat);
  EXPECT_EQ(material_of(R"({"extensions": {"KHR_materials_unlit": {}},
                            "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})")
                .shading,
            Shading::kTextured);
}

void expect_checks(const ModelTexture& texture, float tolerance) {
  ASSERT_EQ(texture.width, 2);
  ASSERT_EQ(texture.height, 2);
  // 128 / 255 in sRGB; alpha stays as it is.
  const float grey = 0.21586f;
  const float expected[16] = {1, 0, 0, 1, grey, grey, grey, 1, 0, 0, 0, 1, 1, 1, 1, 1};
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(texture.rgba[i], expected[i], tolerance) << i;
}

TEST(Gltf, DecodesTexturesToLinear) {
  const fs::path png = write_checks("checks.png");
  const Model model = load(textured("checks.png"));
  ASSERT_EQ(model.textures.size(), 1u);
  EXPECT_EQ(model.materials.at(0).base_texture, 0);
  expect_checks(model.textures[0], 1e-5f);
  const std::string bytes = file_bytes(png);
  expect_checks(load(textured("data:image/png;base64," + test::base64(bytes))).textures.at(0),
                1e-5f);
  json packed = textured("");
  packed["images"][0] = {{"bufferView", 3}, {"mimeType", "image/png"}};
  packed["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", "checks.png"}});
  packed["bufferViews"].push_back({{"buffer", 1}, {"byteLength", bytes.size()}});
  expect_checks(load(packed).textures.at(0), 1e-5f);
}

TEST(Gltf, ReadsJpegTexturesWhole) {
  const fs::path path = write_checks("checks.jpg");
  EXPECT_EQ(load(textured("checks.jpg")).textures.at(0).width, 2);
  const std::string bytes = file_bytes(path);
  written("half.jpg", bytes.substr(0, bytes.size() - 8));
  EXPECT_THAT(error_of([] { load(textured("half.jpg")); }),
              HasSubstr("images[0] half.jpg: ends too early"));
}

TEST(Gltf, DecodesEachImageOnceAndOnlyWhenUsed) {
  write_checks("checks.png");
  json gltf = textured("missing.png");
  gltf["images"].push_back({{"uri", "checks.png"}});
  gltf["textures"] = json::parse(R"([{"source": 0}, {"source": 1}, {"source": 1}])");
  gltf["materials"] = json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 2}},
    "extras": {"limpid": {"shading": "phong", "specular_texture": {"index": 1}}}}])");
  const Model model = load(gltf);
  EXPECT_EQ(model.textures.size(), 1u);
  EXPECT_EQ(model.materials[0].base_texture, 0);
  EXPECT_EQ(model.materials[0].specular_texture, 0);
}

TEST(Gltf, ReadsItsOwnScenes) {
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(LIMPID_DATA "/scenes")) {
    if (entry.path().extension() != ".gltf") continue;
    ++scenes;
    const Model model = load_gltf(entry.path());
    SCOPED_TRACE(entry.path());
    EXPECT_TRUE(model.camera);
    EXPECT_TRUE(model.sun);
    EXPECT_EQ(model.skipped_triangles, 0);
    std::size_t triangles = 0;
    int water = 0;
    for (const Instance& instance : model.instances) {
      triangles += model.meshes[instance.mesh].indices.size() / 3;
      water += instance.water;
    }
    EXPECT_LE(triangles, 30000u);
    EXPECT_EQ(water, 1);
    EXPECT_TRUE(fs::exists(fs::path(entry.path()).replace_extension(".toml")));
  }
  EXPECT_EQ(scenes, 5);
}

}  // namespace
}  // namespace limpid
