#include <fstream>

#include <gmock/gmock.h>
#include <unistd.h>

#include "tool/made_plate.h"
#include "tool/tool.h"

/// Each fault gives one clear sentence and exit code 1; an old file under the output's name stays.

namespace limpid::test {
namespace {

namespace fs = std::filesystem;

class BadInputTest : public ToolTest {
 protected:
  /// Expects the plate to be refused with this sentence.
  void expect_bad_plate(const std::string& plate, const Words& parts) const {
    expect_no_composite({plate, "--scene", "scene.toml"}, parts);
  }
  void expect_bad_scene(const std::string& text, const Words& parts) const {
    write_text("bad.toml", text);
    expect_no_composite({"plate.exr", "--scene", "bad.toml"}, parts);
  }
  void expect_bad_look(const std::string& text, const Words& parts) const {
    write_text("bad.toml", text);
    expect_no_composite({"plate.exr", "--scene", "scene.toml", "--look", "bad.toml"}, parts);
  }
};

TEST_F(BadInputTest, NoSuchFile) {
  expect_bad_plate("absent.exr", {"absent.exr: cannot be opened (no such file or directory)"});
  expect_bad_plate("absent.png", {"absent.png: no such file"});
  fs::create_directory(folder_ / "folder.exr");
  expect_bad_plate("folder.exr", {"folder.exr: is not a file"});
  expect_no_composite({"plate.exr", "--scene", "absent.toml"}, {"absent.toml: cannot be opened"});
  expect_no_composite({"plate.exr", "--scene", "scene.toml", "--look", "absent.toml"},
                      {"absent.toml: cannot be opened"});
  expect_no_composite({"plate.exr", "--scene", "scene.toml", "--look", "realistc"},
                      {"no look is named 'realistc'", "did you mean 'realistic'?"});
}

TEST_F(BadInputTest, NotAnExr) {
  write_text("text.exr", "these are words");
  expect_bad_plate("text.exr", {"text.exr: is not an OpenEXR file"});
  write_text("empty.exr", "");
  expect_bad_plate("empty.exr", {"empty.exr: "});
  write_text("text.png", "these are words");
  expect_bad_plate("text.png", {"text.png: "});
}

TEST_F(BadInputTest, TruncatedExr) {
  const std::string whole = text_of("plate.exr");
  for (const std::size_t size : {whole.size() / 8, whole.size() / 2, whole.size() - 1}) {
    write_text("cut.exr", whole.substr(0, size));
    expect_bad_plate("cut.exr", {"cut.exr: "});
  }
}

TEST_F(BadInputTest, NoDepthListsWhatThereIs) {
  write_plate(folder_ / "flat.exr", {.depth = false});
  expect_bad_plate("flat.exr", {"no depth found; there is R G B A, reflection (R G B), shadow (Y)",
                                "--layer depth=LAYER"});
  expect_no_composite({"flat.exr", "--scene", "scene.toml", "-n"}, {"no depth found"});
}

TEST_F(BadInputTest, NoColorListsWhatThereIs) {
  write_plate(folder_ / "blind.exr", {.color = false});
  expect_bad_plate("blind.exr", {"no color found; there is depth (Z), ", "--layer color=LAYER"});
}

TEST_F(BadInputTest, TwoCandidatesAreListed) {
  const Ran made = oiiotool(
      {"plate.exr", "--ch", "R,G,B,A,near.Depth.Z=depth.Z,far.Depth.Z=depth.Z", "-o", "two.exr"});
  ASSERT_EQ(made.code, 0) << made.err;
  expect_bad_plate("two.exr", {"2 candidates fit equally well: ", "near.Depth.Z", "far.Depth.Z",
                               "--layer depth="});
  EXPECT_EQ(limpid({"composite", "two.exr", "--scene", "scene.toml", "--look", "look.toml",
                    "--layer", "depth=near.Depth.Z", "-o", "wet.exr"})
                .code,
            0);
}

TEST_F(BadInputTest, NamesFromFilesDoNotSteerTheTerminal) {
  const Ran made = oiiotool({"plate.exr", "--ch", "bell\a\n.Y=R", "-o", "rude.exr"});
  ASSERT_EQ(made.code, 0) << made.err;
  expect_bad_plate("rude.exr", {"no color found; there is bell?? (Y)"});
}

TEST_F(BadInputTest, UnknownLayer) {
  expect_no_composite({"plate.exr", "--scene", "scene.toml", "--layer", "depth=dpth.Z"},
                      {"dpth.Z", "depth"});
}

TEST_F(BadInputTest, SizesThatDiffer) {
  write_plate(folder_ / "small.exr", {.data = {0, 0, 32, 18}, .display = {0, 0, 32, 18}});
  expect_no_composite({"plate.exr", "--scene", "scene.toml", "--layer", "depth=small.exr:depth.Z"},
                      {"depth (small.exr) is 32x18 pixels and color (plate.exr) is 64x36"});
}

TEST_F(BadInputTest, DeepFile) {
  const Ran made = oiiotool({"plate.exr", "--ch", "R,G,B,Z=depth.Z", "--deepen", "-o", "deep.exr"});
  ASSERT_EQ(made.code, 0) << made.err;
  expect_bad_plate("deep.exr", {"deep.exr: no channel 'A'", "R, G, B, A and Z"});
  const Words with_kind = {"deep.exr", "--scene", "scene.toml", "--depth-kind", "inverse"};
  expect_no_composite(with_kind, {"deep.exr: holds deep samples", "kind eye or ray"});
  // Other buffers cannot be deep: a pixel needs one value of each.
  expect_no_composite({"plate.exr", "--scene", "scene.toml", "--layer", "shadow=deep.exr:R"},
                      {"deep.exr: part 0", "holds deep samples", "flat pixels"});
}

TEST_F(BadInputTest, SingularCamera) {
  expect_bad_scene(
      "[camera]\nview = [[1,0,0,0],[0,1,0,0],[0,1,0,0],[0,0,0,1]]\nfov_x = 50\n"
      "[water]\nheight = 0\n",
      {"bad.toml:2:8: camera: the view matrix is singular"});
  const std::string view = "[camera]\nview = [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]\n";
  expect_bad_scene(view + "projection = [[1,0,0,0],[0,0,0,0],[0,0,-1,-0.2],[0,0,-1,0]]\n",
                   {"bad.toml:3:14: camera: the projection matrix is singular"});
}

TEST_F(BadInputTest, NoCameraAtAll) {
  const Words sentence = {"no camera found: expected a scene with [camera]", "worldToCamera"};
  expect_no_composite({"plate.exr"}, sentence);
  expect_bad_scene("[water]\nheight = 0.0\n", sentence);
}

TEST_F(BadInputTest, NoWaterPlaneAtAll) {
  const std::string scene = scene_toml();
  expect_bad_scene(scene.substr(0, scene.find("[water]")),
                   {"no water plane found: expected a scene with [water]"});
  write_plate(folder_ / "seen.exr", {.camera = true});
  expect_no_composite({"seen.exr"}, {"no water plane found"});
}

TEST_F(BadInputTest, UnknownKeyInTheScene) {
  expect_bad_scene("[watr]\nheight = 0\n",
                   {"bad.toml:1:2: unknown table 'watr'", "did you mean 'water'?"});
  expect_bad_scene("[water]\nup = [0, 1, 0]\nheigth = 0\n",
                   {"bad.toml:3:1: unknown key 'water.heigth'", "did you mean 'height'?"});
  expect_bad_scene("[water\n", {"bad.toml:1:"});
}

TEST_F(BadInputTest, UnknownKeyInTheLook) {
  expect_bad_look("[depth_frog]\n",
                  {"bad.toml:1:2: unknown table 'depth_frog'", "did you mean 'depth_fog'?"});
  expect_bad_look("[depth_fog]\n  densty = 1\n",
                  {"bad.toml:2:3: unknown key 'depth_fog.densty'", "did you mean 'density'?"});
}

TEST_F(BadInputTest, NanInTheLook) {
  expect_bad_look("[depth_fog]\ndensity = nan\n",
                  {"bad.toml:2:11: depth_fog.density = nan: expected 0 ... "});
  expect_bad_look("[depth_fog]\ncolor = [0.1, nan, 0.1]\n", {"bad.toml:2:9: depth_fog.color"});
}

TEST_F(BadInputTest, AMapThatIsNotThere) {
  expect_bad_look("[wave_normals]\nmap = \"absent.exr\"\n", {"absent.exr: cannot be opened"});
}

TEST_F(BadInputTest, UnwritableOutput) {
  const std::vector<std::string> before = files();
  expect_refused(composite("absent/wet.exr"),
                 {"absent/wet.exr: the folder 'absent' cannot be written to (no such file"});
  EXPECT_EQ(files(), before);
  fs::create_directory(folder_ / "wet.exr");
  expect_refused(composite("wet.exr"), {"wet.exr: exists and is not a file"});
  EXPECT_TRUE(fs::is_empty(folder_ / "wet.exr"));
  if (::geteuid() != 0) {  // root can write to every folder
    fs::create_directory(folder_ / "locked");
    fs::permissions(folder_ / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    expect_refused(composite("locked/wet.exr"), {"locked/wet.exr: ", "permission denied"});
    fs::permissions(folder_ / "locked", fs::perms::owner_all);
  }
}

TEST_F(BadInputTest, AnUnwritablePreviewKeepsThePictureBack) {
  expect_no_composite({"plate.exr", "--scene", "scene.toml", "--preview", "absent/wet.png"},
                      {"absent/wet.png: the folder 'absent' cannot be written to"});
  expect_no_composite({"plate.exr", "--scene", "scene.toml", "--preview", "wet.gif"},
                      {"wet.gif: ", ".png"});
}

}  // namespace
}  // namespace limpid::test
