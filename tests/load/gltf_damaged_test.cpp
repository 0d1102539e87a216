#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "load/gltf_error.h"
#include "load/gltf_files.h"
#include "load/written.h"

namespace limpid {
namespace {

using nlohmann::json;
using test::error_of_text;
using test::Square;
using test::square_gltf;
using testing::HasSubstr;

struct Damage {
  const char* name;
  std::function<void(json&)> apply;
  const char* sentence;

  friend void PrintTo(const Damage& damage, std::ostream* out) { *out << damage.name; }
};

const char* const kCamera = R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])";

const Damage kDamages[] = {
    // structure
    {"no_asset", [](json& g) { g.erase("asset"); }, "the file: expected \"asset\" in it"},
    {"version_1", [](json& g) { g["asset"]["version"] = "1.0"; },
     "asset.version = \"1.0\": expected glTF \"2.0\""},
    {"newer_version", [](json& g) { g["asset"]["minVersion"] = "2.1"; },
     "asset.minVersion = \"2.1\": expected \"2.0\" at most"},
    {"required_extension",
     [](json& g) { g["extensionsRequired"] = {"KHR_draco_mesh_compression"}; },
     "extensionsRequired[0] = \"KHR_draco_mesh_compression\": expected a file that does not "
     "require more than KHR_lights_punctual, KHR_materials_unlit"},
    {"nodes_no_list", [](json& g) { g["nodes"] = 5; }, "nodes = 5: expected a list"},
    {"mesh_no_object", [](json& g) { g["meshes"][0] = "x"; },
     "meshes[0] = \"x\": expected an object"},
    // buffers
    {"buffer_no_uri", [](json& g) { g["buffers"][0].erase("uri"); }, "buffers[0]: expected a uri"},
    {"buffer_too_long", [](json& g) { g["buffers"][0]["byteLength"] = 141; }, "not glTF: "},
    {"buffer_negative", [](json& g) { g["buffers"][0]["byteLength"] = -1; },
     "buffers[0].byteLength = -1: expected an integer from 1 to 2147483647"},
    {"buffer_huge", [](json& g) { g["buffers"][0]["byteLength"] = 18446744073709551615u; },
     "buffers[0].byteLength = 18446744073709551615: expected an integer"},
    {"buffer_missing", [](json& g) { g["buffers"][0]["uri"] = "missing.bin"; }, "no such file"},
    {"buffer_of_text", [](json& g) { g["buffers"][0]["uri"] = "data:,hello"; },
     "expected a data uri of base64"},
    {"uri_above", [](json& g) { g["buffers"][0]["uri"] = "../scene.bin"; },
     "buffers[0].uri = \"../scene.bin\": expected a path inside the folder"},
    {"uri_above_encoded", [](json& g) { g["buffers"][0]["uri"] = "a/%2e%2E/%2e%2e/b.bin"; },
     "without '..'"},
    {"uri_absolute", [](json& g) { g["buffers"][0]["uri"] = "/etc/passwd"; }, "not an absolute"},
    {"uri_absolute_encoded", [](json& g) { g["buffers"][0]["uri"] = "%2Fetc/passwd"; },
     "not an absolute"},
    {"uri_scheme", [](json& g) { g["buffers"][0]["uri"] = "file:///etc/passwd"; }, "not a scheme"},
    {"uri_http", [](json& g) { g["buffers"][0]["uri"] = "http://localhost/x.bin"; },
     "uri = \"http://localhost/x.bin\": expected a data uri or a file beside the glTF file, not a "
     "scheme"},
    {"uri_scheme_encoded", [](json& g) { g["buffers"][0]["uri"] = "file%3A///etc/passwd"; },
     "not a scheme"},
    {"uri_empty", [](json& g) { g["buffers"][0]["uri"] = ""; }, "expected the name of a file"},
    {"uri_number", [](json& g) { g["buffers"][0]["uri"] = 7; }, "uri = 7: expected a text"},
    {"data_not_base64",
     [](json& g) { g["buffers"][0]["uri"] = "data:application/octet-stream;base64,~~~~"; },
     "not glTF: "},
    {"data_of_html", [](json& g) { g["buffers"][0]["uri"] = "data:text/html;base64,AAAA"; },
     "expected a data uri of base64 and of type"},
    {"uri_backslash", [](json& g) { g["buffers"][0]["uri"] = "..\\x.bin"; },
     "expected the name of a file"},
    {"uri_nul", [](json& g) { g["buffers"][0]["uri"] = "x%00.bin"; },
     "expected the name of a file"},
    {"uri_percent", [](json& g) { g["buffers"][0]["uri"] = "x%2"; }, "two hexadecimal digits"},
    {"uri_folder", [](json& g) { g["buffers"][0]["uri"] = "."; }, "expected a file"},
    {"view_buffer", [](json& g) { g["bufferViews"][1]["buffer"] = 1; },
     "bufferViews[1].buffer = 1: expected an index below 1"},
    {"view_beyond", [](json& g) { g["bufferViews"][2]["byteLength"] = 13; },
     "bufferViews[2]: bytes 128 to 141 of a buffer of 140"},
    {"view_offset_wraps", [](json& g) { g["bufferViews"][2]["byteOffset"] = 9223372036854775807; },
     "bufferViews[2].byteOffset = 9223372036854775807: expected an integer from 0 to"},
    {"view_stride", [](json& g) { g["bufferViews"][0]["byteStride"] = 6; },
     "bufferViews[0].byteStride = 6: expected a multiple of 4"},
    {"view_stride_small", [](json& g) { g["bufferViews"][0]["byteStride"] = 8; },
     "elements of 12 bytes in a buffer view of byteStride 8"},
    {"accessor_view", [](json& g) { g["accessors"][0]["bufferView"] = 3; },
     "accessors[0].bufferView = 3: expected an index below 3"},
    {"accessor_beyond", [](json& g) { g["accessors"][1]["count"] = 5; },
     "accessors[1]: needs 108 bytes of a buffer view of 96"},
    {"accessor_count_wraps", [](json& g) { g["accessors"][0]["count"] = 1537228672809129302; },
     "accessors[0].count = 1537228672809129302: expected an integer from 1 to"},
    {"accessor_offset_fraction", [](json& g) { g["accessors"][0]["byteOffset"] = 1.5; },
     "accessors[0].byteOffset = 1.5: expected an integer"},
    {"accessor_component", [](json& g) { g["accessors"][0]["componentType"] = 5130; },
     "accessors[0].componentType = 5130: expected one of"},
    {"accessor_type", [](json& g) { g["accessors"][0]["type"] = "VEC5"; },
     "expected one of SCALAR, VEC2, VEC3"},
    {"accessor_sparse", [](json& g) { g["accessors"][0]["sparse"] = json::object(); },
     "accessors[0]: sparse accessors are not supported"},
    {"view_offset_negative", [](json& g) { g["bufferViews"][1]["byteOffset"] = -4; },
     "bufferViews[1].byteOffset = -4: expected an integer from 0"},
    {"view_empty", [](json& g) { g["bufferViews"][1]["byteLength"] = 0; },
     "bufferViews[1].byteLength = 0: expected an integer from 1"},
    {"view_stride_large", [](json& g) { g["bufferViews"][0]["byteStride"] = 256; },
     "byteStride = 256: expected an integer from 4 to 252"},
    {"accessor_offset_negative", [](json& g) { g["accessors"][1]["byteOffset"] = -48; },
     "accessors[1].byteOffset = -48: expected an integer from 0"},
    {"accessor_offset_large", [](json& g) { g["accessors"][1]["byteOffset"] = 1099511627776; },
     "accessors[1]: needs 1099511627824 bytes of a buffer view of 96"},
    {"accessor_empty", [](json& g) { g["accessors"][0]["count"] = 0; },
     "accessors[0].count = 0: expected an integer from 1"},
    {"accessor_of_nothing", [](json& g) { g["accessors"][0].erase("bufferView"); },
     "accessors[0]: expected a bufferView"},
    // meshes
    {"attribute_index",
     [](json& g) { g["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 9; },
     "meshes[0].primitives[0].attributes.NORMAL = 9: expected an index below 4"},
    {"no_positions",
     [](json& g) { g["meshes"][0]["primitives"][0]["attributes"].erase("POSITION"); },
     "meshes[0].primitives[0].attributes: expected \"POSITION\" in it"},
    {"positions_of_vec2",
     [](json& g) { g["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 2; },
     "expected an accessor of VEC3 float"},
    {"indices_of_float", [](json& g) { g["meshes"][0]["primitives"][0]["indices"] = 0; },
     "expected an accessor of SCALAR unsigned integers"},
    {"counts_differ", [](json& g) { g["accessors"][2]["count"] = 3; },
     "accessors[2].count = 3: expected 4 as in POSITION"},
    {"two_corners", [](json& g) { g["accessors"][3]["count"] = 5; },
     "5 corners, expected three a triangle"},
    {"strip", [](json& g) { g["meshes"][0]["primitives"][0]["mode"] = 5; },
     "mode = 5: expected 4, a triangle list, not a triangle strip"},
    {"mode_of_text", [](json& g) { g["meshes"][0]["primitives"][0]["mode"] = "4"; },
     "mode = \"4\": expected an integer"},
    {"morph", [](json& g) { g["meshes"][0]["primitives"][0]["targets"] = json::array(); },
     "morph targets are not supported"},
    {"material_index", [](json& g) { g["meshes"][0]["primitives"][0]["material"] = 0; },
     "material = 0: expected an index below 0"},
    {"material_negative", [](json& g) { g["meshes"][0]["primitives"][0]["material"] = -1; },
     "material = -1: expected an index below 0"},
    {"index_beyond",
     [](json& g) {
       Square square;
       square.indices[4] = 4;
       g["buffers"][0]["uri"] = test::data_uri(square.bytes());
     },
     "meshes[0] 'square' corner 4: index 4, expected one below 4"},
    {"nan_position",
     [](json& g) {
       Square square;
       square.positions[7] = std::numeric_limits<float>::quiet_NaN();
       g["buffers"][0]["uri"] = test::data_uri(square.bytes());
     },
     "meshes[0] 'square' vertex 2: position (1.000000, nan, 0.000000), expected finite"},
    {"infinite_normal",
     [](json& g) {
       Square square;
       square.normals[0] = std::numeric_limits<float>::infinity();
       g["buffers"][0]["uri"] = test::data_uri(square.bytes());
     },
     "meshes[0] 'square' vertex 0: normal (inf"},
    {"nan_uv",
     [](json& g) {
       Square square;
       square.uvs[3] = std::numeric_limits<float>::quiet_NaN();
       g["buffers"][0]["uri"] = test::data_uri(square.bytes());
     },
     "meshes[0] 'square' vertex 1: uv nan"},
    // materials
    {"texture_index",
     [](json& g) {
       g["materials"] =
           json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
     },
     "materials[0].pbrMetallicRoughness.baseColorTexture.index = 0: expected an index below 0"},
    {"image_index", [](json& g) { g["textures"] = json::parse(R"([{"source": 2}])"); },
     "textures[0].source = 2: expected an index below 0"},
    {"image_uri_above", [](json& g) { g["images"] = json::parse(R"([{"uri": "../x.png"}])"); },
     "images[0].uri = \"../x.png\": expected a path inside"},
    {"image_view_beyond", [](json& g) { g["images"] = json::parse(R"([{"bufferView": 3}])"); },
     "images[0].bufferView = 3: expected an index below 3"},
    {"image_twice",
     [](json& g) { g["images"] = json::parse(R"([{"bufferView": 0, "uri": "x.png"}])"); },
     "images[0]: expected either a uri or a bufferView"},
    {"image_of_floats",
     [](json& g) {
       g["images"] = json::parse(R"([{"bufferView": 0, "mimeType": "image/png"}])");
       g["textures"] = json::parse(R"([{"source": 0}])");
       g["materials"] =
           json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
     },
     "images[0]: expected a PNG or JPEG picture"},
    {"extras_key",
     [](json& g) {
       g["materials"] = json::parse(R"([{"extras": {"limpid": {"shadin": "flat"}}}])");
     },
     "materials[0].extras.limpid: unknown key 'shadin', expected one of shading, ambient, power, "
     "specular, specular_texture; did you mean 'shading'?"},
    {"extras_word",
     [](json& g) {
       g["materials"] = json::parse(R"([{"extras": {"limpid": {"shading": "fong"}}}])");
     },
     "materials[0].extras.limpid.shading = \"fong\": expected one of flat, textured, lambert, "
     "phong, toon"},
    {"extras_unused",
     [](json& g) { g["materials"] = json::parse(R"([{"extras": {"limpid": {"power": 3}}}])"); },
     "materials[0].extras.limpid.power: has no use with shading lambert, expected shading phong"},
    {"extras_untextured",
     [](json& g) {
       g["materials"] = json::parse(R"([{"extras": {"limpid": {"shading": "textured"}}}])");
     },
     "expected a baseColorTexture in the material"},
    {"dark_color",
     [](json& g) {
       g["materials"] =
           json::parse(R"([{"pbrMetallicRoughness": {"baseColorFactor": [-1, 0, 0, 1]}}])");
     },
     "baseColorFactor = [...] of 4: expected four numbers from 0 up"},
    // nodes
    {"own_parent",
     [](json& g) {
       g["nodes"][0]["children"] = {0};
       g["scenes"][0]["nodes"] = json::array();
     },
     "nodes[0]: is its own ancestor, expected no cycles"},
    {"cycle",
     [](json& g) {
       g["nodes"] = json::parse(R"([{}, {"children": [2]}, {"children": [3]}, {"children": [1]}])");
     },
     "nodes[1]: is its own ancestor"},
    {"two_parents",
     [](json& g) { g["nodes"] = json::parse(R"([{"children": [2]}, {"children": [2]}, {}])"); },
     "nodes[1].children[0] = 2: expected each node to have one parent; it already is a child of "
     "nodes[0]"},
    {"child_index", [](json& g) { g["nodes"][0]["children"] = {1}; },
     "nodes[0].children[0] = 1: expected an index below 1"},
    {"scene_lists_a_child", [](json& g) { g["nodes"] = json::parse(R"([{}, {"children": [0]}])"); },
     "scenes[0].nodes[0] = 0: expected a root; it is a child of nodes[1]"},
    {"scene_index", [](json& g) { g["scene"] = 1; }, "scene = 1: expected an index below 1"},
    {"mesh_index", [](json& g) { g["nodes"][0]["mesh"] = 4294967296; },
     "nodes[0].mesh = 4294967296: expected an index below 1"},
    {"camera_index", [](json& g) { g["nodes"][0]["camera"] = 0; },
     "nodes[0].camera = 0: expected an index below 0"},
    {"light_index",
     [](json& g) {
       g["nodes"][0]["extensions"] = json::parse(R"({"KHR_lights_punctual": {"light": 0}})");
     },
     "nodes[0].extensions.KHR_lights_punctual.light = 0: expected an index below 0"},
    {"skin", [](json& g) { g["nodes"][0]["skin"] = 0; }, "nodes[0].skin: skins are not supported"},
    {"short_matrix",
     [](json& g) {
       g["nodes"][0]["matrix"] = {1, 2, 3};
     },
     "nodes[0].matrix = [...] of 3: expected a list of 16 numbers"},
    {"short_rotation",
     [](json& g) {
       g["nodes"][0]["rotation"] = {0, 0, 1};
     },
     "nodes[0].rotation = [...] of 3: expected a list of 4 numbers"},
    {"zero_rotation",
     [](json& g) {
       g["nodes"][0]["rotation"] = {0, 0, 0, 0};
     },
     "expected a unit quaternion"},
    {"null_in_matrix",
     [](json& g) {
       g["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, nullptr, 0, 0, 1};
     },
     "nodes[0].matrix[12] = null: expected a number"},
    {"matrix_of_texts",
     [](json& g) {
       g["nodes"][0]["translation"] = {"NaN", 0, 0};
     },
     "nodes[0].translation[0] = \"NaN\": expected a number"},
    {"matrix_projective",
     [](json& g) { g["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
     "expected 0, 0, 0, 1 in its last row"},
    {"matrix_and_scale",
     [](json& g) {
       g["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
       g["nodes"][0]["scale"] = {1, 1, 1};
     },
     "nodes[0].scale: expected either a matrix or its parts"},
    {"root_twice",
     [](json& g) {
       g["scenes"][0]["nodes"] = {0, 0};
     },
     "scenes[0].nodes[1] = 0: expected each root once"},
    {"flat_scale",
     [](json& g) {
       g["nodes"][0]["scale"] = {1, 0, 1};
     },
     "nodes[0] 'thing': its matrix has the determinant 0.000000"},
    {"endless_scale",
     [](json& g) {
       g["nodes"].push_back({{"scale", {1e200, 1e200, 1e200}}, {"children", {0}}});
       g["nodes"][0]["scale"] = {1e200, 1e200, 1e200};
       g["scenes"][0]["nodes"] = {1};
     },
     "nodes[0] 'thing': its matrix, with those of its parents, has a NaN or infinite entry"},
    {"water_without_mesh",
     [](json& g) { g["nodes"][0] = json::parse(R"({"extras": {"limpid": {"water": true}}})"); },
     "expected a mesh in the node whose surface is water"},
    {"water_word",
     [](json& g) { g["nodes"][0]["extras"] = json::parse(R"({"limpid": {"watr": true}})"); },
     "nodes[0].extras.limpid: unknown key 'watr', expected one of water; did you mean 'water'?"},
    {"water_of_text",
     [](json& g) { g["nodes"][0]["extras"] = json::parse(R"({"limpid": {"water": "yes"}})"); },
     "nodes[0].extras.limpid.water = \"yes\": expected true or false"},
    {"camera_type", [](json& g) { g["cameras"] = json::parse(R"([{"type": "perspektive"}])"); },
     "expected one of perspective, orthographic; did you mean 'perspective'?"},
    {"camera_wide",
     [](json& g) {
       g["cameras"] = json::parse(kCamera);
       g["cameras"][0]["perspective"]["yfov"] = 3.2;
     },
     "cameras[0].perspective.yfov = 3.2: expected less than pi"},
    {"camera_far",
     [](json& g) {
       g["cameras"] = json::parse(kCamera);
       g["cameras"][0]["perspective"]["zfar"] = 0;
     },
     "cameras[0].perspective.zfar = 0: expected more than znear"},
    {"camera_mirrored",
     [](json& g) {
       g["cameras"] = json::parse(kCamera);
       g["nodes"][0] = json::parse(R"({"camera": 0, "scale": [-1, 1, 1]})");
     },
     "nodes[0]: its camera is mirrored"},
    {"camera_sheared",
     [](json& g) {
       g["cameras"] = json::parse(kCamera);
       g["nodes"][0] = json::parse(
           R"({"camera": 0, "matrix": [1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]})");
     },
     "nodes[0]: camera: the view matrix scales or shears"},
    {"background",
     [](json& g) { g["scenes"][0]["extras"] = json::parse(R"({"limpid": {"background": [1]}})"); },
     "scenes[0].extras.limpid.background = [...] of 1: expected a list of 3 numbers"},
};

class GltfDamaged : public testing::TestWithParam<Damage> {};

TEST_P(GltfDamaged, IsRefusedByName) {
  json gltf = square_gltf();
  GetParam().apply(gltf);
  EXPECT_THAT(error_of_text(gltf.dump()), HasSubstr(GetParam().sentence));
}

INSTANTIATE_TEST_SUITE_P(Files, GltfDamaged, testing::ValuesIn(kDamages),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace limpid
