#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/files/gltf/gltf.h"

#include "files/exr/written.h"
#include "files/gltf/made_gltf.h"

/// Files of which a part cannot be drawn: refused, or drawn without it.

namespace limpid {
namespace {

using nlohmann::json;
using test::error_of;
using test::Square;
using test::square_gltf;
using test::written;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

Model load(const json& gltf, Undrawable undrawable) {
  return load_gltf(written("scene.gltf", gltf.dump()), {}, undrawable);
}

/// Beside the square as it is, a node with a mesh of its own to be spoilt.
json two_squares() {
  json gltf = square_gltf();
  gltf["meshes"].push_back(gltf["meshes"][0]);
  gltf["meshes"][1]["name"] = "spoilt";
  gltf["nodes"].push_back({{"name", "bad"}, {"mesh", 1}});
  gltf["scenes"][0]["nodes"] = {0, 1};
  return gltf;
}

/// Refused as it is; drawn without the second node, with this warning.
void expect_left_out(const json& gltf, const std::string& warning) {
  EXPECT_NE(error_of([&] { load(gltf, Undrawable::kRefuse); }), "");
  const Model model = load(gltf, Undrawable::kLeaveOut);
  ASSERT_EQ(model.instances.size(), 1u);
  EXPECT_EQ(model.meshes.at(model.instances[0].mesh).name, "square");
  EXPECT_THAT(model.warnings, ElementsAre(HasSubstr(warning)));
}

TEST(GltfUndrawable, LeavesOutWhatIsPacked) {
  json gltf = two_squares();
  gltf["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  json& primitive = gltf["meshes"][1]["primitives"][0];
  primitive["extensions"] = {{"KHR_draco_mesh_compression", json::object()}};
  gltf["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 4}});
  primitive["attributes"] = {{"POSITION", 4}};
  expect_left_out(gltf,
                  "nodes[1] 'bad' is left out: meshes[1].primitives[0]: is packed by Draco "
                  "(KHR_draco_mesh_compression), which is not read");
}

TEST(GltfUndrawable, LeavesOutWhatIsInAPackedBuffer) {
  json gltf = two_squares();
  gltf["extensionsRequired"] = {"EXT_meshopt_compression"};
  gltf["buffers"].push_back(
      {{"byteLength", 48}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  gltf["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 48}});
  gltf["accessors"].push_back(
      {{"bufferView", 3}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 4}});
  gltf["meshes"][1]["primitives"][0]["attributes"]["POSITION"] = 4;
  expect_left_out(gltf, "nodes[1] 'bad' is left out: bufferViews[3]: is packed by meshopt");
}

TEST(GltfUndrawable, ReadsWhatIsPackedFromItsPlainBytes) {
  json gltf = square_gltf();
  gltf["extensionsUsed"] = {"KHR_draco_mesh_compression", "EXT_meshopt_compression"};
  gltf["buffers"][0]["extensions"] = {{"EXT_meshopt_compression", {{"fallback", true}}}};
  gltf["meshes"][0]["primitives"][0]["extensions"] = {
      {"KHR_draco_mesh_compression", {{"bufferView", 0}}}};
  const Model model = load(gltf, Undrawable::kRefuse);
  EXPECT_EQ(model.meshes.at(0).positions.at(2), glm::vec3(1, 1, 0));
  EXPECT_THAT(model.warnings, ElementsAre());
}

TEST(GltfUndrawable, LeavesOutWhatHasADamagedMesh) {
  json gltf = two_squares();
  gltf["meshes"][1]["primitives"][0]["attributes"]["NORMAL"] = 2;
  expect_left_out(gltf,
                  "nodes[1] 'bad' is left out: meshes[1].primitives[0].attributes.NORMAL = 2");
  gltf = two_squares();
  Square square;
  square.positions[0] = std::numeric_limits<float>::quiet_NaN();
  const std::string bytes = square.bytes();
  gltf["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", test::data_uri(bytes)}});
  gltf["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 48}});
  gltf["accessors"].push_back(
      {{"bufferView", 3}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 4}});
  gltf["meshes"][1]["primitives"][0]["attributes"]["POSITION"] = 4;
  expect_left_out(gltf, "nodes[1] 'bad' is left out: meshes[1] 'spoilt' vertex 0: position (nan");
}

TEST(GltfUndrawable, LeavesOutWhatHasAMaterialThatCannotBeRead) {
  json gltf = two_squares();
  gltf["meshes"][1]["primitives"][0]["material"] = 0;
  gltf["materials"] = json::parse(R"([{"emissiveFactor": [-1, 0, 0]}])");
  expect_left_out(gltf, "nodes[1] 'bad' is left out: materials[0].emissiveFactor");
  gltf["materials"] =
      json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
  gltf["textures"] = json::parse(R"([{"source": 0}])");
  gltf["images"] = json::parse(R"([{"uri": "missing.png"}])");
  expect_left_out(gltf, "missing.png: no such file");
  gltf["images"] = json::parse(R"([{"uri": "data:image/ktx2;base64,q0tUWCAyMLs="}])");
  expect_left_out(gltf, "nodes[1] 'bad' is left out: images[0]: is KTX2, expected a PNG");
}

TEST(GltfUndrawable, LeavesOutWhatHangsOnANodeWithoutAPlace) {
  json gltf = square_gltf();
  gltf["nodes"].push_back({{"rotation", {0, 0, 0, 2}}, {"children", {2}}});
  gltf["nodes"].push_back({{"mesh", 0}});
  gltf["scenes"][0]["nodes"] = {0, 1};
  expect_left_out(gltf,
                  "nodes[1] is left out, with all below it: nodes[1].rotation = [0, 0, 0, 2], of "
                  "norm 2: expected a unit quaternion");
}

TEST(GltfUndrawable, LeavesOutWhatHasASkinWithoutAPlace) {
  json gltf = two_squares();
  gltf["nodes"][1]["skin"] = 0;
  gltf["skins"] = json::parse(R"([{"joints": []}])");
  expect_left_out(gltf, "nodes[1] 'bad' is left out: skins[0].joints");
  gltf["skins"] = json::parse(R"([{"joints": [2]}])");
  gltf["nodes"].push_back({{"scale", "big"}});
  EXPECT_THAT(
      load(gltf, Undrawable::kLeaveOut).warnings,
      ElementsAre(HasSubstr("skins[0].joints[0] = 2: expected a joint with a finite matrix")));
}

TEST(GltfUndrawable, DrawsWithoutWhatOtherExtensionsRequire) {
  json gltf = square_gltf();
  gltf["extensionsRequired"] = {"EXT_soup"};
  gltf["extensionsUsed"] = {"EXT_soup", "KHR_other", "KHR_materials_unlit"};
  const Model model = load(gltf, Undrawable::kLeaveOut);
  EXPECT_EQ(model.instances.size(), 1u);
  EXPECT_THAT(model.warnings,
              ElementsAre("extensions that the file requires are not read: EXT_soup",
                          "extensions are not read: KHR_other"));
}

TEST(GltfUndrawable, StillRefusesWhatIsWrongWithTheWhole) {
  json gltf = square_gltf();
  gltf["bufferViews"][0]["byteLength"] = 1000;
  EXPECT_THAT(error_of([&] { load(gltf, Undrawable::kLeaveOut); }), HasSubstr("bufferViews[0]"));
  gltf = square_gltf();
  gltf["nodes"][0]["children"] = {0};
  EXPECT_THAT(error_of([&] { load(gltf, Undrawable::kLeaveOut); }), HasSubstr("no cycles"));
}

TEST(GltfUndrawable, StillRefusesWhatIsOverTheLimits) {
  json gltf = square_gltf();
  for (const int i : {0, 1, 2}) {
    gltf["accessors"][i].erase("bufferView");
    gltf["accessors"][i]["count"] = 100000000;
  }
  Limits limits;
  limits.max_memory = 1 << 20;
  const auto path = written("scene.gltf", gltf.dump());
  EXPECT_THAT(error_of([&] { load_gltf(path, limits, Undrawable::kLeaveOut); }),
              HasSubstr("nodes[0] 'thing': meshes[0] 'square': needs"));
}

TEST(GltfUndrawable, CountsTheMemoryOfInstancesMorphTargetsAndJoints) {
  Limits limits;
  limits.max_memory = 1 << 20;
  const auto error = [&](const json& gltf) {
    const auto path = written("scene.gltf", gltf.dump());
    return error_of([&] { load_gltf(path, limits); });
  };
  json instanced = square_gltf();
  instanced["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 10000}});
  instanced["nodes"][0]["extensions"] =
      json::parse(R"({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 4}}})");
  EXPECT_THAT(error(instanced), HasSubstr("bytes of memory, expected at most"));

  json plain = square_gltf();
  plain["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 4}}}};
  plain["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 3000}});
  EXPECT_EQ(error(plain), "");
  json morphed = plain;
  for (int i = 0; i < 40; ++i) {
    morphed["meshes"][0]["primitives"][0]["targets"].push_back({{"POSITION", 4}});
    morphed["meshes"][0]["weights"].push_back(1);
  }
  EXPECT_THAT(error(morphed), HasSubstr("morph target: needs 36000 bytes"));
}

}  // namespace
}  // namespace limpid
