#include <array>
#include <cstdint>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/exr/written.h"
#include "files/gltf/gltf_error.h"
#include "files/gltf/made_gltf.h"

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

// The square's positions again, by the indices of its triangles: 0 1 2 0 2 3.
void make_sparse(json& g, int count) {
  g["accessors"][0]["sparse"] = {{"count", count},
                                 {"indices", {{"bufferView", 2}, {"componentType", 5123}}},
                                 {"values", {{"bufferView", 0}}}};
}

void make_skin(json& g) {
  g["nodes"][0]["skin"] = 0;
  g["skins"] = json::parse(R"([{"joints": [0]}])");
}

// All four vertices alike.
void make_bound(json& g, const std::array<std::uint8_t, 4>& joints,
                const std::array<float, 4>& weights) {
  make_skin(g);
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += std::string(joints.begin(), joints.end());
  for (int i = 0; i < 4; ++i) {
    bytes += test::bytes_of(std::vector<float>(weights.begin(), weights.end()));
  }
  g["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", test::data_uri(bytes)}});
  g["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 16}});
  g["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 16}, {"byteLength", 64}});
  g["accessors"].push_back(
      {{"bufferView", 3}, {"componentType", 5121}, {"type", "VEC4"}, {"count", 4}});
  g["accessors"].push_back(
      {{"bufferView", 4}, {"componentType", 5126}, {"type", "VEC4"}, {"count", 4}});
  json& attributes = g["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = 4;
  attributes["WEIGHTS_0"] = 5;
}

const Damage kDamages[] = {
    // structure
    {"no_asset", [](json& g) { g.erase("asset"); }, "the file: expected \"asset\" in it"},
    {"version_1", [](json& g) { g["asset"]["version"] = "1.0"; },
     "asset.version = \"1.0\": expected glTF \"2.0\""},
    {"newer_version", [](json& g) { g["asset"]["minVersion"] = "2.1"; },
     "asset.minVersion = \"2.1\": expected \"2.0\" at most"},
    {"required_extension",
     [](json& g) { g["extensionsRequired"] = {"KHR_draco_mesh_compression"}; },
     "extensionsRequired[0] = \"KHR_draco_mesh_compression\": meshes packed by Draco are not read, "
     "expected a file that requires no more than EXT_mesh_gpu_instancing, "},
    {"required_meshopt", [](json& g) { g["extensionsRequired"] = {"EXT_meshopt_compression"}; },
     "\"EXT_meshopt_compression\": buffers packed by meshopt are not read"},
    {"required_new_meshopt", [](json& g) { g["extensionsRequired"] = {"KHR_meshopt_compression"}; },
     "\"KHR_meshopt_compression\": buffers packed by meshopt are not read"},
    {"required_ktx2", [](json& g) { g["extensionsRequired"] = {"KHR_texture_basisu"}; },
     "\"KHR_texture_basisu\": textures in KTX2 are not read"},
    {"required_webp", [](json& g) { g["extensionsRequired"] = {"EXT_texture_webp"}; },
     "\"EXT_texture_webp\": textures in WebP are not read"},
    {"required_unknown", [](json& g) { g["extensionsRequired"] = {"EXT_soup"}; },
     "extensionsRequired[0] = \"EXT_soup\": is not read, expected a file that requires no more"},
    {"nodes_no_list", [](json& g) { g["nodes"] = 5; }, "nodes = 5: expected a list"},
    {"mesh_no_object", [](json& g) { g["meshes"][0] = "x"; },
     "meshes[0] = \"x\": expected an object"},
    // buffers
    {"buffer_no_uri", [](json& g) { g["buffers"][0].erase("uri"); }, "buffers[0]: expected a uri"},
    {"buffer_too_long", [](json& g) { g["buffers"][0]["byteLength"] = 141; },
     "buffers[0].byteLength = 141: expected at most the 140 bytes that it has"},
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
    {"uri_number", [](json& g) { g["buffers"][0]["uri"] = 7; }, "uri = 7: expected a string"},
    {"data_not_base64",
     [](json& g) { g["buffers"][0]["uri"] = "data:application/octet-stream;base64,~~~~"; },
     "expected letters of base64"},
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
     "accessors[0].sparse: expected \"count\" in it"},
    {"sparse_count", [](json& g) { make_sparse(g, 5); },
     "accessors[0].sparse.count = 5: expected an integer from 1 to 4"},
    {"sparse_indices_of_bytes",
     [](json& g) {
       make_sparse(g, 1);
       g["accessors"][0]["sparse"]["indices"]["componentType"] = 5122;
     },
     "accessors[0].sparse.indices.componentType = 5122: expected one of 5121, 5123, 5125"},
    {"sparse_view",
     [](json& g) {
       make_sparse(g, 1);
       g["accessors"][0]["sparse"]["values"]["bufferView"] = 3;
     },
     "accessors[0].sparse.values.bufferView = 3: expected an index below 3"},
    {"sparse_values_beyond",
     [](json& g) {
       make_sparse(g, 4);
       g["accessors"][0]["sparse"]["values"]["byteOffset"] = 52;
     },
     "accessors[0].sparse.values: needs 100 bytes of a buffer view of 96"},
    {"sparse_indices_beyond",
     [](json& g) {
       make_sparse(g, 4);
       g["accessors"][0]["sparse"]["indices"]["byteOffset"] = 6;
     },
     "accessors[0].sparse.indices: needs 14 bytes of a buffer view of 12"},
    // The indices of the triangles, 0 1 2 0, do not rise.
    {"sparse_falls", [](json& g) { make_sparse(g, 4); },
     "accessors[0].sparse: index 3 is 0, expected one above 2 and below 4"},
    {"sparse_index_beyond",
     [](json& g) {
       Square square;
       square.indices[0] = 4;
       g["buffers"][0]["uri"] = test::data_uri(square.bytes());
       make_sparse(g, 1);
     },
     "accessors[0].sparse: index 0 is 4, expected one above -1 and below 4"},
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
    {"accessor_of_much_nothing",
     [](json& g) {
       for (const int i : {0, 1, 2}) {
         g["accessors"][i].erase("bufferView");
         g["accessors"][i]["count"] = 2147483647;
       }
     },
     "bytes of memory, expected at most"},
    // meshes
    {"attribute_index",
     [](json& g) { g["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 9; },
     "meshes[0].primitives[0].attributes.NORMAL = 9: expected an index below 4"},
    {"positions_of_vec2",
     [](json& g) { g["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 2; },
     "expected an accessor of VEC3 float"},
    {"indices_of_float", [](json& g) { g["meshes"][0]["primitives"][0]["indices"] = 0; },
     "expected an accessor of SCALAR unsigned integers"},
    {"counts_differ", [](json& g) { g["accessors"][2]["count"] = 3; },
     "accessors[2].count = 3: expected 4 as in POSITION"},
    {"two_corners", [](json& g) { g["accessors"][3]["count"] = 5; },
     "5 corners, expected three a triangle"},
    {"short_strip",
     [](json& g) {
       g["meshes"][0]["primitives"][0]["mode"] = 5;
       g["accessors"][3]["count"] = 2;
     },
     "meshes[0].primitives[0].indices: 2 corners, expected at least three"},
    {"mode_of_seven", [](json& g) { g["meshes"][0]["primitives"][0]["mode"] = 7; },
     "mode = 7: expected an integer from 0 to 6"},
    {"quantized_unsaid", [](json& g) { g["accessors"][0]["componentType"] = 5122; },
     "attributes.POSITION = 0: expected an accessor of VEC3 float"},
    {"quantized_normals_unnormalized",
     [](json& g) {
       g["extensionsUsed"] = {"KHR_mesh_quantization"};
       g["accessors"][1]["componentType"] = 5122;
     },
     "attributes.NORMAL = 1: expected an accessor of VEC3 float, normalized bytes or shorts"},
    {"draco_alone",
     [](json& g) {
       g["meshes"][0]["primitives"][0]["extensions"] = {
           {"KHR_draco_mesh_compression", json::object()}};
       g["accessors"][1].erase("bufferView");
     },
     "meshes[0].primitives[0]: is packed by Draco (KHR_draco_mesh_compression), which is not read"},
    {"meshopt_alone",
     [](json& g) {
       g["buffers"].push_back(
           {{"byteLength", 96}, {"extensions", {{"EXT_meshopt_compression", json::object()}}}});
       g["bufferViews"][0]["buffer"] = 1;
     },
     "nodes[0] 'thing': bufferViews[0]: is packed by meshopt, which is not read"},
    {"meshopt_beyond",
     [](json& g) {
       g["buffers"].push_back(
           {{"byteLength", 95}, {"extensions", {{"EXT_meshopt_compression", json::object()}}}});
       g["bufferViews"][0]["buffer"] = 1;
     },
     "bufferViews[0]: bytes 0 to 96 of a buffer of 95"},
    {"mode_of_text", [](json& g) { g["meshes"][0]["primitives"][0]["mode"] = "4"; },
     "mode = \"4\": expected an integer"},
    {"morph_weights",
     [](json& g) {
       g["meshes"][0]["primitives"][0]["targets"] = json::parse(R"([{"POSITION": 0}])");
       g["meshes"][0]["weights"] = {1, 1};
     },
     "meshes[0].weights = [...] of 2: expected a list of 1 numbers"},
    {"morph_weights_of_node", [](json& g) { g["nodes"][0]["weights"] = {1}; },
     "nodes[0].weights = [...] of 1: expected a list of 0 numbers"},
    {"morph_count",
     [](json& g) {
       g["meshes"][0]["primitives"][0]["targets"] = json::parse(R"([{"POSITION": 3}])");
     },
     "accessors[3].count = 6: expected 4 as in POSITION"},
    {"morph_of_some",
     [](json& g) {
       json& primitives = g["meshes"][0]["primitives"];
       primitives.push_back(primitives[0]);
       primitives[0]["targets"] = json::parse(R"([{"POSITION": 0}])");
     },
     "meshes[0].primitives[1]: has 0 morph targets, expected 1 as in the first primitive"},
    {"endless_morph",
     [](json& g) {
       g["meshes"][0]["primitives"][0]["targets"] = json::parse(R"([{"POSITION": 0}])");
       g["meshes"][0]["weights"] = {1e300};
     },
     "meshes[0] 'square' vertex 0: posed position"},
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
    {"webp_alone",
     [](json& g) {
       g["images"] = json::parse(R"([{"uri": "data:image/webp;base64,UklGRgAAAABXRUJQ"}])");
       g["textures"] = json::parse(R"([{"extensions": {"EXT_texture_webp": {"source": 0}}}])");
       g["materials"] =
           json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
     },
     "textures[0]: has a picture by EXT_texture_webp alone, which is not read"},
    {"ktx2_alone",
     [](json& g) {
       g["images"] = json::parse(R"([{"uri": "x.ktx2"}])");
       g["textures"] = json::parse(R"([{"extensions": {"KHR_texture_basisu": {"source": 0}}}])");
       g["materials"] = json::parse(R"([{"emissiveFactor": [1, 1, 1],
                                         "emissiveTexture": {"index": 0}}])");
     },
     "textures[0]: has a picture by KHR_texture_basisu alone, which is not read"},
    {"webp_for_png",
     [](json& g) {
       g["images"] = json::parse(R"([{"uri": "data:image/png;base64,UklGRgAAAABXRUJQ"}])");
       g["textures"] = json::parse(R"([{"source": 0}])");
       g["materials"] =
           json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
     },
     "images[0]: is WebP, expected a PNG or JPEG picture"},
    {"transform_of_text",
     [](json& g) {
       g["images"] = json::parse(R"([{"uri": "x.png"}])");
       g["textures"] = json::parse(R"([{"source": 0}])");
       g["materials"] = json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0,
         "extensions": {"KHR_texture_transform": {"offset": "left"}}}}}])");
     },
     "KHR_texture_transform.offset = \"left\": expected a list of 2 numbers"},
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
    {"skin_index", [](json& g) { g["nodes"][0]["skin"] = 0; },
     "nodes[0].skin = 0: expected an index below 0"},
    {"skin_without_mesh",
     [](json& g) {
       make_skin(g);
       g["nodes"][0].erase("mesh");
     },
     "nodes[0].skin = 0: expected a mesh in the node that has a skin"},
    {"skin_joint",
     [](json& g) {
       make_skin(g);
       g["skins"][0]["joints"] = {0, 7};
     },
     "skins[0].joints[1] = 7: expected an index below 1"},
    {"skin_matrices",
     [](json& g) {
       make_skin(g);
       g["skins"][0]["inverseBindMatrices"] = 0;
     },
     "skins[0].inverseBindMatrices = 0: expected an accessor of MAT4 float"},
    {"skin_of_unbound", [](json& g) { make_skin(g); },
     "nodes[0] 'thing': meshes[0] 'square': expected JOINTS_0 and WEIGHTS_0"},
    {"joint_beyond",
     [](json& g) {
       make_bound(g, {0, 0, 1, 0}, {0.5f, 0.5f, 0.5f, 0});
     },
     "meshes[0] 'square' vertex 0: joint 1, expected one below 1"},
    {"weight_below_0",
     [](json& g) {
       make_bound(g, {0, 0, 0, 0}, {1, -0.5f, 0, 0});
     },
     "meshes[0] 'square' vertex 0: weight -0.500000, expected a number from 0 up"},
    {"weight_nan",
     [](json& g) {
       make_bound(g, {0, 0, 0, 0}, {1, std::numeric_limits<float>::quiet_NaN(), 0, 0});
     },
     "weight nan, expected a number from 0 up"},
    {"instance_counts",
     [](json& g) {
       g["nodes"][0]["extensions"] =
           json::parse(R"({"EXT_mesh_gpu_instancing": {"attributes": {"SCALE": 0, "_ID": 3}}})");
     },
     "accessors[3].count = 6: expected 4 as in the other attributes of instances"},
    {"instance_rotation",
     [](json& g) {
       g["nodes"][0]["extensions"] =
           json::parse(R"({"EXT_mesh_gpu_instancing": {"attributes": {"ROTATION": 0}}})");
     },
     "ROTATION = 0: expected an accessor of VEC4 float, or of normalized bytes or shorts"},
    {"instances_without_end",
     [](json& g) {
       g["accessors"][1].erase("bufferView");
       g["accessors"][1]["count"] = 2147483647;
       g["nodes"][0]["extensions"] =
           json::parse(R"({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}})");
       g["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
     },
     "bytes of memory, expected at most"},
    {"visible_of_text",
     [](json& g) {
       g["nodes"][0]["extensions"] = json::parse(R"({"KHR_node_visibility": {"visible": "no"}})");
     },
     "nodes[0].extensions.KHR_node_visibility.visible = \"no\": expected true or false"},
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
     "nodes[0].rotation = [0, 0, 0, 0], of norm 0: expected a unit quaternion (norm 1)"},
    {"long_rotation",
     [](json& g) {
       g["nodes"][0]["rotation"] = {0, 0.5, -0.25, 1};
     },
     "nodes[0].rotation = [0, 0.5, -0.25, 1], of norm 1.14564: expected a unit quaternion (norm "
     "1)"},
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
