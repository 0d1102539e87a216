// `limpid report` of a plate: its numbers beside those of composite and compare, and its refusals.
// tests/tools/shot_page.py checks its page in a browser.
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "limpid/ops/chain.h"
#include "limpid/run/target.h"

#include "paths.h"
#include "tool/tool.h"

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class ShotReportTest : public ToolTest {
 protected:
  Ran shot(const Words& more) const {
    Words words = {"report", "plate.exr", "--scene",  "scene.toml",
                   "--look", "look.toml", "--rounds", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return limpid(words);
  }

  json report(const std::string& folder) const {
    return json::parse(text_of(folder + "/report.json"));
  }

  /// Each picture of the page equals the preview that composite writes.
  void expect_preview(const std::string& picture, const Words& more) const {
    composed("other.exr", with(more, {"--preview", "other.png"}));
    EXPECT_TRUE(same(picture, "other.png")) << picture;
  }

  /// The output of `compare` for the two pictures.
  void expect_as_compared(const json& row, const std::string& a, const std::string& b) const {
    const Ran ran = limpid({"compare", a, b, "--channels", "R,G,B", "--clip", "4", "--metrics",
                            "ssim,flip", "--tolerance", "100"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto expect = [&](const char* name, double found) {
      const std::size_t at = ran.out.find(std::string(name) + " = ");
      ASSERT_NE(at, std::string::npos) << ran.out;
      const double told = std::atof(ran.out.c_str() + at + std::string(name).size() + 3);
      EXPECT_NEAR(found, told, 1e-5 * std::abs(told)) << name << "\n" << ran.out;
    };
    expect("Mean error", row["error"]["mean"]);
    expect("RMS error", row["rmse"]);
    expect("Max error", row["error"]["max"]);
    expect("SSIM", row["ssim"]);
    expect("FLIP", row["flip"]);
  }

  static Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

json row_of(const json& rows, const char* key, const std::string& name) {
  for (const json& row : rows) {
    if (row[key] == name) return row;
  }
  ADD_FAILURE() << "no row of " << name;
  return {};
}

TEST_F(ShotReportTest, TellsWhatCompositeAndCompareTell) {
  composed("truth.exr", {"--float", "--set", "depth_fog.density=0.3"});
  const Ran ran = shot({"--truth", "truth.exr", "--against", "realistic", "-o", "page"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out, "page/report.json\npage/index.html\n");
  EXPECT_THAT(ran.err, HasSubstr("without depth_fog: "));
  const json shot = report("page");
  EXPECT_EQ(shot["width"], 64);
  EXPECT_EQ(shot["height"], 36);
  EXPECT_EQ(shot["truth"], "truth.exr");

  composed("wet.exr", {"--float", "--aov", "all"});
  expect_preview("page/wet.png", {});
  expect_as_compared(shot["looks"][0]["beside_truth"], "wet.exr", "truth.exr");
  EXPECT_EQ(shot["looks"][0]["beside_shot"]["error"]["max"], 0);
  expect_as_compared(shot["dry"]["beside_shot"], "plate.exr", "wet.exr");

  for (const char* name : {"physical", "fast", "realistic"}) {
    const json look = row_of(shot["looks"], "look", name);
    const Words words = {"composite", "plate.exr", "--scene", "scene.toml", "--look", name, "-q"};
    ASSERT_EQ(limpid(with(words, {"--float", "-o", "look.exr", "--preview", "look.png"})).code, 0);
    expect_as_compared(look["beside_shot"], "look.exr", "wet.exr");
    expect_as_compared(look["beside_truth"], "look.exr", "truth.exr");
    EXPECT_GT(look["milliseconds"], 0);
    EXPECT_TRUE(same("page/" + std::string(look["picture"]), "look.png"));
    if (std::string(name) != "realistic")
      fs::rename(folder_ / "look.exr", folder_ / (std::string(name) + ".exr"));
  }
  expect_as_compared(shot["fast"]["beside_physical"], "fast.exr", "physical.exr");
  EXPECT_GT(shot["fast"]["time_share"], 0);
}

TEST_F(ShotReportTest, LeavesOutEachOperatorAsAParameterDoes) {
  ASSERT_EQ(shot({"-o", "page", "-q"}).code, 0);
  const json shot = report("page");
  composed("wet.exr", {"--float"});
  const std::pair<const char*, const char*> neutral[] = {
      {"water_shadow", "water_shadow.strength=0"},
      {"sun_highlight", "sun_highlight.strength=0"},
      {"wave_normals", "wave_normals.strength=0"}};
  for (const auto& [name, setting] : neutral) {
    const json op = row_of(shot["operators"], "operator", name);
    ASSERT_TRUE(op["runs"]) << name;
    composed("without.exr", {"--float", "--set", setting, "--preview", "without.png"});
    expect_as_compared(op["without_beside_shot"], "without.exr", "wet.exr");
    EXPECT_GT(op["without_beside_shot"]["error"]["max"], 0) << name;
    EXPECT_GT(op["milliseconds"], 0) << name;
    EXPECT_TRUE(same("page/" + std::string(op["picture"]), "without.png")) << name;
  }
  EXPECT_EQ(shot["operators"].size(), Chain::kCount);
  for (const json& op : shot["operators"]) {
    if (op["runs"]) continue;
    EXPECT_THAT(std::string(op["planned"]), HasSubstr("skipped")) << op;
    EXPECT_FALSE(op.contains("milliseconds"));
  }
  EXPECT_TRUE(shot["truth"].is_null());
  EXPECT_TRUE(shot["looks"][0]["beside_truth"].is_null());
}

TEST_F(ShotReportTest, HasAllPicturesAndFacts) {
  ASSERT_EQ(shot({"-o", "page", "-q", "--set", "refraction.strength=0.2"}).code, 0);
  const json shot = report("page");
  std::set<std::string> named = {"index.html", "report.json"}, there;
  int count = 0;
  for (const json& picture : shot["pictures"]) {
    EXPECT_TRUE(named.insert(picture["file"]).second) << picture;
    count += picture["group"] == "aovs" ? 1 : 0;
  }
  for (const auto& entry : fs::directory_iterator(folder_ / "page")) {
    there.insert(entry.path().filename());
  }
  EXPECT_EQ(there, named);
  EXPECT_EQ(count, kAovCount);
  EXPECT_THAT(named, Contains("dry.png"));
  EXPECT_THAT(text_of("page/index.html"), Not(HasSubstr("://")));
  const Ran parsed =
      run(folder_, {PYTHON3, "-c", "import xml.dom.minidom as d; d.parse('page/index.html')"});
  EXPECT_EQ(parsed.code, 0) << parsed.err;

  // The numbers of the AOVs, pixel by pixel, and of the plan.
  composed("wet.exr",
           {"--float", "--aov", "surface_depth,confidence", "--set", "refraction.strength=0.2"});
  oiiotool({"wet.exr", "--ch", "confidence.Y,surface_depth.Z", "-o", "two.exr"});
  const Ran told = oiiotool({"--dumpdata", "two.exr"});
  double wet = 0, sum = 0, guessed = 0;
  for (std::size_t at = told.out.find("): "); at != told.out.npos;
       at = told.out.find("): ", at + 1)) {
    double confidence = 0;
    std::array<char, 16> depth{};
    ASSERT_EQ(std::sscanf(told.out.c_str() + at + 3, "%lf %15s", &confidence, depth.data()), 2);
    if (std::string(depth.data()).starts_with("inf")) continue;
    ++wet;
    sum += confidence;
    guessed += confidence < 0.5 ? 1 : 0;
  }
  ASSERT_GT(wet, 0);
  EXPECT_DOUBLE_EQ(shot["wet_share"], wet / (64 * 36));
  EXPECT_NEAR(shot["confidence"]["mean_of_wet"], sum / wet, 1e-4);
  EXPECT_DOUBLE_EQ(shot["confidence"]["guessed_share_of_wet"], guessed / wet);
  const Ran plan = limpid({"plan", "plate.exr", "--scene", "scene.toml", "--look", "look.toml",
                           "--set", "refraction.strength=0.2"});
  EXPECT_THAT(plan.out, HasSubstr(std::string(shot["off_frame"]["advice"])));
}

TEST_F(ShotReportTest, TheSameLookIsToldOnce) {
  ASSERT_EQ(
      limpid({"report", "plate.exr", "--scene", "scene.toml", "--rounds", "1", "-o", "page", "-q"})
          .code,
      0);
  const json shot = report("page");
  EXPECT_EQ(shot["look"], "physical");
  ASSERT_EQ(shot["looks"].size(), 2);
  EXPECT_EQ(shot["looks"][1]["look"], "fast");
  EXPECT_FALSE(shot["fast"].is_null());
}

TEST_F(ShotReportTest, RefusesWhatIsWrongAndWritesNothing) {
  const std::vector<std::string> before = files();
  const auto refused = [&](const Words& more, const Words& parts, int code = 1) {
    expect_refused(shot(with({"-o", "page"}, more)), parts, code);
    EXPECT_EQ(files(), before);
  };
  refused({"--size", "64x36"}, {"report --size", "no PLATE"}, 2);
  refused({"--quick"}, {"report --quick"}, 2);
  refused({"--hard"}, {"report --hard"}, 2);
  refused({"--set", "depth_fog.densty=1"}, {"did you mean 'density'?"}, 2);
  refused({"--against", "fsat"}, {"fsat", "did you mean 'fast'?"});
  refused({"--layer", "depth=none"}, {"no depth"});
  refused({"--layer", "depth=plate.exr:no.Z"}, {"no.Z"});
  refused({"--truth", "none.exr"}, {"none.exr"});
  refused({"--truth", "look.toml"}, {"look.toml"});
  expect_refused(limpid({"report", "-o", "page", "--truth", "plate.exr"}),
                 {"report --truth", "PLATE"}, 2);
  expect_refused(limpid({"report", "-o", "page", "--look", "fast"}), {"report --look"}, 2);
  expect_refused(limpid({"report", "plate.exr", "--scene", "scene.toml"}), {"-o FOLDER"}, 2);
  EXPECT_EQ(files(), before);
}

TEST_F(ShotReportTest, RefusesATruthOfAnotherSizeOrWithoutColor) {
  oiiotool({"plate.exr", "--resize", "32x18", "-o", "small.exr"});
  oiiotool({"plate.exr", "--ch", "depth.Z", "-o", "depth.exr"});
  oiiotool({"plate.exr", "--cut", "40x36+0+0", "--fullsize", "64x36+0+0", "-o", "part.exr"});
  const std::vector<std::string> before = files();
  const auto refused = [&](const std::string& truth, const Words& parts) {
    expect_refused(shot({"-o", "page", "--truth", truth}), parts);
    EXPECT_EQ(files(), before);
  };
  refused("small.exr", {"small.exr: is 32x18: expected the plate's 64x36 pixels"});
  refused("part.exr", {"part.exr: is 64x36 and lacks a part of it"});
  refused("depth.exr", {"depth.exr", "R, G and B"});
}

TEST_F(ShotReportTest, RefusesAFolderThatCannotBeWrittenTo) {
  expect_refused(shot({"-o", "plate.exr"}), {"plate.exr", "not a folder"});
  // A picture of the page would overwrite its own input.
  fs::create_directory(folder_ / "page");
  composed("page/truth.png.exr", {});
  composed("other.exr", {"--preview", "page/truth.png"});
  const std::string truth = text_of("page/truth.png");
  expect_refused(shot({"-o", "page", "--truth", "page/truth.png"}), {"truth.png", "input"}, 2);
  EXPECT_EQ(text_of("page/truth.png"), truth);
  // A folder has the name of a picture.
  fs::create_directories(folder_ / "other" / "wet.png");
  const std::vector<std::string> before = files();
  expect_refused(shot({"-o", "other"}), {"wet.png"});
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace limpid::test
