#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/exr/written.h"
#include "files/gltf/gltf_error.h"
#include "files/gltf/made_gltf.h"
#include "files/picture/png_bytes.h"

namespace limpid {
namespace {

using nlohmann::json;
using test::bytes_of;
using test::error_of;
using test::error_of_text;
using test::glb;
using test::own_folder;
using test::Square;
using test::square_gltf;
using test::written;
using testing::HasSubstr;

namespace fs = std::filesystem;

TEST(GltfFile, MustBeThereAndBeJson) {
  EXPECT_THAT(error_of([] { load_gltf(own_folder() / "none.gltf"); }), HasSubstr("no such file"));
  EXPECT_THAT(error_of([] { load_gltf(own_folder()); }), HasSubstr("expected a file"));
  EXPECT_THAT(error_of_text(""), HasSubstr("not JSON: parse error"));
  EXPECT_THAT(error_of_text("{\"asset\": "), HasSubstr("not JSON: parse error"));
  EXPECT_THAT(error_of_text("[1]"), HasSubstr("the file = [...] of 1: expected an object"));
  EXPECT_THAT(error_of_text("{\"asset\": {\"version\": 1e999}}"), HasSubstr("not JSON"));
}

TEST(GltfFile, MayNotNestWithoutEnd) {
  const std::string deep(200000, '[');
  EXPECT_THAT(error_of_text("{\"extras\": " + deep), HasSubstr("nested more than 64 deep"));
}

TEST(GltfFile, MayNotLeadOutOfItsFolder) {
  const Square square;
  const fs::path folder = own_folder() / "inner";
  fs::create_directories(folder);
  written("outside.bin", square.bytes());
  fs::remove(folder / "link.bin");
  fs::create_symlink("../outside.bin", folder / "link.bin");
  json gltf = square_gltf();
  gltf["buffers"][0]["uri"] = "link.bin";
  const fs::path path = written("inner/scene.gltf", gltf.dump());
  EXPECT_THAT(error_of([&] { load_gltf(path); }), HasSubstr("link.bin: links lead to "));
}

TEST(GltfFile, MayNotHaveShortBuffers) {
  json gltf = square_gltf();
  written("short.bin", std::string(100, 'x'));
  gltf["buffers"][0]["uri"] = "short.bin";
  EXPECT_THAT(error_of_text(gltf.dump()),
              HasSubstr("buffers[0].byteLength = 140: expected at most the 100 bytes that it has"));
}

TEST(GltfFile, MustBeAWholeBinary) {
  json gltf = square_gltf();
  gltf["buffers"][0].erase("uri");
  const std::string whole = glb(gltf.dump(), Square().bytes());
  EXPECT_EQ(error_of_text(whole), "");
  for (const std::size_t size : {4u, 11u, 13u, 19u, 40u}) {
    EXPECT_NE(error_of_text(whole.substr(0, size)), "") << size;
  }
  EXPECT_THAT(error_of_text(whole.substr(0, whole.size() - 1)), HasSubstr("its header says"));
  std::string damaged = whole;
  damaged[4] = 1;
  EXPECT_THAT(error_of_text(damaged), HasSubstr("is a .glb of version 1: expected 2"));
  damaged = whole;
  damaged[14] = 1;  // 64 KiB more JSON
  EXPECT_THAT(error_of_text(damaged), HasSubstr("its chunk JSON has "));
  damaged = whole;
  damaged[whole.size() - 140 - 8] = static_cast<char>(0xFF);
  EXPECT_THAT(error_of_text(damaged), HasSubstr("its chunk BIN has "));
  damaged[16] = 'X';
  EXPECT_THAT(error_of_text(damaged), HasSubstr("expected a chunk JSON, found another"));
  gltf["buffers"][0]["byteLength"] = 145;
  EXPECT_THAT(error_of_text(glb(gltf.dump(), Square().bytes())),
              HasSubstr("byteLength = 145: expected at most the 140 bytes of the chunk BIN"));
}

/// One triangle in a file of its own, drawn as often as `triangles` says.
json heavy_gltf(int triangles) {
  json gltf = square_gltf();
  written("heavy.bin", std::string(36, '\0') + bytes_of(std::vector<std::uint32_t>(3 * triangles)));
  gltf["buffers"][0] = {{"byteLength", 36 + 12 * triangles}, {"uri", "heavy.bin"}};
  gltf["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}},
                         {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 12 * triangles}}};
  gltf["accessors"] = json::parse(
      R"([{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
          {"bufferView": 1, "componentType": 5125, "type": "SCALAR"}])");
  gltf["accessors"][1]["count"] = 3 * triangles;
  gltf["meshes"] =
      json::parse(R"([{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}])");
  return gltf;
}

TEST(GltfFile, StaysWithinLimits) {
  Limits limits;
  limits.max_memory = 100;
  EXPECT_THAT(error_of_text(square_gltf().dump(), limits), HasSubstr("expected at most 100"));
  limits.max_memory = 10000;
  EXPECT_THAT(error_of_text(square_gltf().dump(), limits), HasSubstr("its JSON may need"));
  // One buffer, drawn over and over.
  json gltf = heavy_gltf(20000);
  json& primitives = gltf["meshes"][0]["primitives"];
  for (int i = 0; i < 9; ++i) primitives.push_back(primitives[0]);
  limits.max_memory = 240000 + 20000;
  EXPECT_THAT(error_of_text(gltf.dump(), limits),
              HasSubstr("heavy.bin: has 240036 bytes: expected at most"));
  limits.max_memory = 1500000;
  EXPECT_THAT(error_of_text(gltf.dump(), limits),
              HasSubstr("meshes[0]: needs 240168 bytes of memory, expected at most"));
}

/// Millions of values in few bytes, in places that nobody reads; also the time is bounded.
TEST(GltfFile, MayNotBeMostlyValues) {
  Limits limits;
  limits.max_memory = 16 << 20;
  for (const std::string value : {"{}", "[]", "1", "\"\"", "{\"a\":[]}"}) {
    std::string extras = "[" + value;
    for (int i = 0; i < 40000; ++i) extras += "," + value;
    const std::string text = "{\"asset\": {\"version\": \"2.0\"}, \"extras\": " + extras + "]}";
    EXPECT_THAT(error_of_text(text, limits), HasSubstr("its JSON may need ")) << value;
    EXPECT_EQ(error_of_text(text), "") << value;
  }
}

/// A chain of nodes may be as long as it likes: nobody goes along it by recursion.
TEST(GltfFile, MayHaveLongFamilies) {
  constexpr int kNodes = 20000;
  json gltf = square_gltf();
  gltf["nodes"] = json::array();
  for (int i = 1; i < kNodes; ++i) gltf["nodes"].push_back({{"children", {i}}});
  gltf["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(error_of_text(gltf.dump()), "");
  gltf["nodes"].back()["children"] = {0};
  EXPECT_THAT(error_of_text(gltf.dump()), HasSubstr("nodes[0]: is its own ancestor"));
}

/// A picture is refused by its header, before there is memory for its texels.
TEST(GltfFile, MayNotHaveHugePictures) {
  const auto error_of_picture = [&](std::uint32_t width, std::uint32_t height,
                                    const std::string& data = "xx") {
    json gltf = square_gltf();
    gltf["images"][0]["uri"] =
        "data:image/png;base64," + test::base64(test::png_file({width, height}, data));
    gltf["textures"] = json::parse(R"([{"source": 0}])");
    gltf["materials"] =
        json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
    gltf["meshes"][0]["primitives"][0]["material"] = 0;
    return error_of_text(gltf.dump());
  };
  EXPECT_THAT(error_of_picture(70000, 1), HasSubstr("images[0]: 70000x1 pixels: expected sides"));
  EXPECT_THAT(error_of_picture(16384, 16385), HasSubstr("images[0]: "));
  EXPECT_THAT(error_of_picture(20000000, 20000000), HasSubstr("images[0]"));
  EXPECT_THAT(error_of_picture(0, 5), HasSubstr("images[0]"));
  EXPECT_THAT(error_of_picture(5, 5), HasSubstr("images[0]: is damaged: "));
  // A header that says one pixel, and a stored block of 100 bytes.
  const std::string stored = test::stored(std::string(100, '\0'));
  EXPECT_THAT(error_of_picture(1, 1, stored), HasSubstr("decompress to more than its size"));
  EXPECT_THAT(error_of_picture(5, 5, stored), Not(HasSubstr("decompress to more")));
}

}  // namespace
}  // namespace limpid
