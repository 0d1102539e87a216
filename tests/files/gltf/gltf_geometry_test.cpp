#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/files/gltf/gltf.h"

#include "files/exr/written.h"
#include "files/gltf/made_gltf.h"

/// Vertices and triangles as files keep them otherwise than one by one: strips, fans, fractions,
/// differences, poses.

namespace limpid {
namespace {

using nlohmann::json;
using test::Square;
using test::square_gltf;
using test::written;
using testing::ElementsAre;

Model load(const json& gltf) { return load_gltf(written("scene.gltf", gltf.dump())); }
Mesh mesh_of(const json& gltf) { return load(gltf).meshes.at(0); }

void expect_near(glm::dvec3 value, glm::dvec3 expected, double tolerance = 1e-6) {
  EXPECT_LT(glm::length(value - expected), tolerance)
      << value.x << " " << value.y << " " << value.z << ", expected " << expected.x << " "
      << expected.y << " " << expected.z;
}

/// Puts an accessor behind those that there are; returns its index.
template <class T>
int add_accessor(json& gltf, const std::vector<T>& values, int component, const char* type,
                 std::size_t count, bool normalized = false) {
  const std::string bytes = test::bytes_of(values);
  gltf["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", test::data_uri(bytes)}});
  gltf["bufferViews"].push_back(
      {{"buffer", gltf["buffers"].size() - 1}, {"byteLength", bytes.size()}});
  gltf["accessors"].push_back({{"bufferView", gltf["bufferViews"].size() - 1},
                               {"componentType", component},
                               {"type", type},
                               {"count", count},
                               {"normalized", normalized}});
  return static_cast<int>(gltf["accessors"].size()) - 1;
}

json& primitive_of(json& gltf) { return gltf["meshes"][0]["primitives"][0]; }

TEST(GltfGeometry, StripsAndFansTurnTheirFrontAsTheirFirstTriangle) {
  json gltf = square_gltf();
  primitive_of(gltf)["indices"] =
      add_accessor<std::uint16_t>(gltf, {0, 1, 3, 2}, 5123, "SCALAR", 4);
  primitive_of(gltf)["mode"] = 5;
  EXPECT_THAT(mesh_of(gltf).indices, ElementsAre(0, 1, 3, 1, 2, 3));
  primitive_of(gltf)["indices"] =
      add_accessor<std::uint16_t>(gltf, {0, 1, 2, 3}, 5123, "SCALAR", 4);
  primitive_of(gltf)["mode"] = 6;
  EXPECT_THAT(mesh_of(gltf).indices, ElementsAre(1, 2, 0, 2, 3, 0));
}

TEST(GltfGeometry, TrianglesThatJoinStripsAreNotMissed) {
  json gltf = square_gltf();
  primitive_of(gltf)["indices"] =
      add_accessor<std::uint16_t>(gltf, {0, 1, 3, 3, 3, 2}, 5123, "SCALAR", 6);
  primitive_of(gltf)["mode"] = 5;
  const Model model = load(gltf);
  EXPECT_THAT(model.meshes.at(0).indices, ElementsAre(0, 1, 3));
  EXPECT_EQ(model.skipped_triangles, 0);
}

TEST(GltfGeometry, SparseValuesStandInForThoseOfTheBase) {
  json gltf = square_gltf();
  const int values = add_accessor<float>(gltf, {5, 6, 7}, 5126, "VEC3", 1);
  const int indices = add_accessor<std::uint8_t>(gltf, {2}, 5121, "SCALAR", 1);
  const json sparse = {
      {"count", 1},
      {"indices",
       {{"bufferView", gltf["accessors"][indices]["bufferView"]}, {"componentType", 5121}}},
      {"values", {{"bufferView", gltf["accessors"][values]["bufferView"]}}}};
  gltf["accessors"][0]["sparse"] = sparse;
  Mesh mesh = mesh_of(gltf);
  EXPECT_EQ(mesh.positions[1], glm::vec3(1, 0, 0));
  EXPECT_EQ(mesh.positions[2], glm::vec3(5, 6, 7));
  gltf["accessors"][0].erase("bufferView");
  primitive_of(gltf).erase("indices");
  gltf["accessors"][0]["count"] = gltf["accessors"][1]["count"] = gltf["accessors"][2]["count"] = 3;
  EXPECT_EQ(load(gltf).skipped_triangles, 1);  // two of its corners are zeros
}

TEST(GltfGeometry, ReadsQuantizedVertices) {
  json gltf = square_gltf();
  gltf["extensionsRequired"] = {"KHR_mesh_quantization"};
  json& attributes = primitive_of(gltf)["attributes"];
  attributes["POSITION"] = add_accessor<std::int16_t>(
      gltf, {0, 0, 0, 300, 0, 0, 300, -200, 0, 0, -200, 0}, 5122, "VEC3", 4);
  attributes["NORMAL"] = add_accessor<std::int8_t>(
      gltf, {0, 0, -127, 0, 0, 0, -127, 0, 0, 0, -127, 0, 0, 0, -128, 0}, 5120, "VEC3", 4, true);
  gltf["bufferViews"].back()["byteStride"] = 4;
  attributes["TEXCOORD_0"] = add_accessor<std::int16_t>(gltf, {-32768, 32767, 0, 0, 16384, 0, 0, 0},
                                                        5122, "VEC2", 4, true);
  const Mesh mesh = mesh_of(gltf);
  EXPECT_EQ(mesh.positions[2], glm::vec3(300, -200, 0));
  EXPECT_EQ(mesh.normals[3], glm::vec3(0, 0, -1));
  EXPECT_EQ(mesh.uvs[0], glm::vec2(-1, 1));  // -32768 is below -1, and cut
}

TEST(GltfGeometry, AddsMorphTargetsByTheWeightsOfTheNodeElseOfTheMesh) {
  json gltf = square_gltf();
  const int up = add_accessor<float>(gltf, {0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0}, 5126, "VEC3", 4);
  const int tilt = add_accessor<float>(gltf, {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 5126, "VEC3", 4);
  primitive_of(gltf)["targets"] = {{{"POSITION", up}, {"NORMAL", tilt}}, {{"POSITION", up}}};
  EXPECT_EQ(mesh_of(gltf).positions[2], glm::vec3(1, 1, 0));
  gltf["meshes"][0]["weights"] = {0.5, 0};
  EXPECT_EQ(mesh_of(gltf).positions[2], glm::vec3(1, 3, 0));
  // The normal was (0, 0, 2), of which the direction counts.
  expect_near(mesh_of(gltf).normals[0], glm::normalize(glm::dvec3(0.5, 0, 1)));
  gltf["nodes"][0]["weights"] = {1, -0.25};
  EXPECT_EQ(mesh_of(gltf).positions[2], glm::vec3(1, 4, 0));
  // Another node shows the mesh as it is.
  gltf["nodes"].push_back({{"mesh", 0}});
  gltf["scenes"][0]["nodes"] = {0, 1};
  EXPECT_EQ(load(gltf).meshes.at(1).positions[2], glm::vec3(1, 3, 0));
}

/// The square, bound to the joints 1 and 2 by these weights, all vertices alike.
json bound(float first, float second) {
  json gltf = square_gltf();
  std::vector<std::uint8_t> joints;
  std::vector<float> weights;
  for (int i = 0; i < 4; ++i) {
    joints.insert(joints.end(), {0, 1, 0, 0});
    weights.insert(weights.end(), {first, second, 0, 0});
  }
  json& attributes = primitive_of(gltf)["attributes"];
  attributes["JOINTS_0"] = add_accessor(gltf, joints, 5121, "VEC4", 4);
  attributes["WEIGHTS_0"] = add_accessor(gltf, weights, 5126, "VEC4", 4);
  gltf["skins"] = json::parse(R"([{"joints": [1, 2]}])");
  gltf["nodes"] = json::parse(R"([{"mesh": 0, "skin": 0, "translation": [50, 0, 0]},
                                  {"translation": [0, 0, 8], "children": [2]},
                                  {"scale": [2, 2, 2]}])");
  gltf["scenes"][0]["nodes"] = {0, 1};
  return gltf;
}

TEST(GltfGeometry, TellsOfMorphTargetsThatAreNotDrawn) {
  json gltf = square_gltf();
  const json target = {{"POSITION", 1}, {"NORMAL", 1}, {"TANGENT", 1}, {"TEXCOORD_0", 2}};
  primitive_of(gltf)["targets"] = {target, target};
  gltf["meshes"][0]["weights"] = {1, 1};
  EXPECT_THAT(load(gltf).warnings,
              ElementsAre("morph targets of TEXCOORD_0 are not drawn: meshes[0] 'square'"));
}

TEST(GltfGeometry, SkinsGoWhereTheirJointsAre) {
  const Model model = load(bound(1, 0));
  EXPECT_EQ(model.instances.at(0).world_from_mesh, glm::dmat4(1.0));
  EXPECT_EQ(model.meshes.at(0).positions[2], glm::vec3(1, 1, 8));
  EXPECT_EQ(mesh_of(bound(0, 1)).positions[2], glm::vec3(2, 2, 8));
  // By their share of the sum; without any, the first.
  EXPECT_EQ(mesh_of(bound(3, 1)).positions[2], glm::vec3(1.25, 1.25, 8));
  EXPECT_EQ(mesh_of(bound(0, 0)).positions[2], glm::vec3(1, 1, 8));
}

TEST(GltfGeometry, InverseBindMatricesTakeVerticesToTheirJoint) {
  json gltf = bound(1, 0);
  std::vector<float> matrices;
  for (int i = 0; i < 2; ++i) {
    matrices.insert(matrices.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 7, 0, 1});
  }
  gltf["skins"][0]["inverseBindMatrices"] = add_accessor(gltf, matrices, 5126, "MAT4", 2);
  EXPECT_EQ(mesh_of(gltf).positions[2], glm::vec3(1, 8, 8));
}

TEST(GltfGeometry, SkinsKeepTheirFrontAndTurnTheirNormals) {
  json gltf = bound(1, 0);
  // Mirrored, and flattened along x, so that a slanted normal leans over.
  gltf["nodes"][1] = json::parse(R"({"scale": [-0.5, 1, 1], "children": [2]})");
  const std::vector<float> slanted = {1, 0, 1, 1, 0, 1, 1, 0, 1, 1, 0, 1};
  primitive_of(gltf)["attributes"]["NORMAL"] = add_accessor(gltf, slanted, 5126, "VEC3", 4);
  const Mesh mesh = mesh_of(gltf);
  const auto corner = [&](int i) { return glm::dvec3(mesh.positions[mesh.indices[i]]); };
  EXPECT_GT(glm::cross(corner(1) - corner(0), corner(2) - corner(0)).z, 0);
  expect_near(mesh.normals[0], glm::normalize(glm::dvec3(-2, 0, 1)));
}

TEST(GltfGeometry, InstancesStandOnTheirNode) {
  json gltf = square_gltf();
  gltf["nodes"][0]["translation"] = {10, 0, 0};
  const int places = add_accessor<float>(gltf, {0, 1, 0, 0, 2, 0, 0, 3, 0}, 5126, "VEC3", 3);
  const int sizes = add_accessor<float>(gltf, {1, 1, 1, -2, 2, 2, 0, 0, 0}, 5126, "VEC3", 3);
  const int turns = add_accessor<std::int16_t>(
      gltf, {0, 0, 23170, 23170, 0, 0, 0, 32767, 0, 0, 0, 32767}, 5122, "VEC4", 3, true);
  gltf["nodes"][0]["extensions"] = {
      {"EXT_mesh_gpu_instancing",
       {{"attributes", {{"TRANSLATION", places}, {"SCALE", sizes}, {"ROTATION", turns}}}}}};
  const Model model = load(gltf);
  ASSERT_EQ(model.instances.size(), 2u);  // the third has no size
  EXPECT_EQ(model.skipped_triangles, 2);
  const auto at = [&](int i, glm::dvec3 p) {
    return glm::dvec3(model.instances[i].world_from_mesh * glm::dvec4(p, 1));
  };
  expect_near(at(0, {1, 0, 0}), {10, 2, 0}, 1e-4);
  EXPECT_EQ(model.meshes.at(model.instances[1].mesh).positions[1], glm::vec3(-1, 0, 0));
  expect_near(at(1, {-1, 0, 0}), {8, 2, 0});
}

TEST(GltfGeometry, HiddenNodesHideWhatHangsOnThem) {
  json gltf = square_gltf();
  gltf["nodes"].push_back({{"name", "off"},
                           {"children", {2}},
                           {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
  gltf["nodes"].push_back({{"mesh", 0}});
  gltf["nodes"][0]["extensions"] = {{"KHR_node_visibility", {{"visible", true}}}};
  gltf["scenes"][0]["nodes"] = {0, 1};
  const Model model = load(gltf);
  EXPECT_EQ(model.instances.size(), 1u);
  EXPECT_THAT(model.warnings,
              ElementsAre("hidden nodes and their children are not drawn: nodes[1] 'off'"));
}

TEST(GltfGeometry, TellsOfLightsThatAreNotDrawn) {
  json gltf = square_gltf();
  gltf["extensions"] = json::parse(R"({"KHR_lights_punctual": {"lights": [{"type": "spot"}]}})");
  gltf["nodes"][0]["extensions"] = json::parse(R"({"KHR_lights_punctual": {"light": 0}})");
  EXPECT_THAT(load(gltf).warnings,
              ElementsAre("lights but the first directional one are not drawn: nodes[0] 'thing'"));
}

TEST(GltfGeometry, TexturesAreMovedByTheirTransform) {
  json gltf = square_gltf();
  gltf["images"] = json::parse(
      R"([{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC"}])");
  gltf["textures"] = json::parse(R"([{"source": 0}])");
  gltf["materials"] = json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0,
    "extensions": {"KHR_texture_transform": {"offset": [0, 1], "scale": [0.5, 0.5]}}}}}])");
  json& transform = gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
                        ["KHR_texture_transform"];
  transform["rotation"] = std::numbers::pi / 2;
  primitive_of(gltf)["material"] = 0;
  // The extension's own example: the lower left quarter, turned clockwise.
  const std::vector<glm::vec2> uvs = mesh_of(gltf).uvs;  // of (0, 1), (1, 1), (1, 0), (0, 0)
  const glm::dvec2 expected[] = {{0.5, 1}, {0.5, 0.5}, {0, 0.5}, {0, 1}};
  for (int i = 0; i < 4; ++i) EXPECT_LT(glm::length(glm::dvec2(uvs[i]) - expected[i]), 1e-6) << i;
}

}  // namespace
}  // namespace limpid
