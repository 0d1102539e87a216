#include <algorithm>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "limpid/core/simd.h"
#include "limpid/files/picture/image_file.h"

#include "paths.h"
#include "sanitized.h"
#include "tool/tool.h"

/// `limpid report` as a whole: one quick run, its rows read back, its page judged by an XML parser
/// and by a browser.

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class ReportTest : public ToolTest {
 protected:
  void expect_rows(const json& report) const;
  /// Opens the page with the inserted checks, in a window of this width.
  void expect_good_page(int width) const;
};

std::vector<std::string> names_in(const fs::path& folder, bool folders) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory() != folders) continue;
    if (folders || entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  }
  return names;
}

/// The planner keeps its bound: no pixel has a larger error than allowed, except by rounding.
void expect_budgets_kept(const json& rows, std::size_t subjects) {
  EXPECT_EQ(rows.size(), subjects * 2 * 5);
  for (const json& row : rows) {
    EXPECT_GT(row["ns_per_pixel"], 0);
    EXPECT_LE(row["error"]["max"], double(row["max_error"]) + 1e-5) << row;
    EXPECT_LE(row["bound"], row["max_error"]) << row;
  }
}

/// For each of two looks: one row per buffer, starting with color and depth.
void expect_what_is_brought(const json& section, std::size_t subjects) {
  EXPECT_EQ(section["samples_a_pixel"], 16);
  EXPECT_EQ(section["subjects"].size(), subjects);
  std::size_t begun = 0;
  for (const json& row : section["rows"]) {
    begun += row["brought"] == "color, depth" ? 1 : 0;
    EXPECT_GT(row["ns_per_pixel"], 0) << row;
    EXPECT_GT(row["relative_error_wet"], 0) << row;
    EXPECT_LT(row["relative_error_wet"], 0.6) << row;
    EXPECT_GT(row["flip_wet"], 0) << row;
  }
  EXPECT_EQ(begun, 2 * subjects);
  // The lagoon's reflection has neither depth nor validity.
  EXPECT_EQ(section["rows"].size(), 2 * (5 * subjects - 1));
}

void ReportTest::expect_rows(const json& report) const {
  std::vector<std::string> subjects = names_in(LIMPID_DATA "/plates", true);
  for (const std::string& scene : names_in(LIMPID_DATA "/scenes", false)) subjects.push_back(scene);
  const std::vector<std::string> looks = names_in(LIMPID_DATA "/looks", false);
  ASSERT_GE(subjects.size(), 7);
  ASSERT_GE(looks.size(), 5);
  EXPECT_EQ(report["subjects"].size(), subjects.size());

  std::set<std::string> runs;
  for (const json& row : report["looks_by_runner"]) {
    EXPECT_GT(row["ns_per_pixel"], 0);
    EXPECT_LT(row["error"]["mean"], 1e-4) << row;
    if (row["threads"] != 1) continue;
    const std::string simd = row["simd"].is_null() ? "" : row["simd"];
    runs.insert(std::string(row["subject"]) + "/" + std::string(row["look"]) + "/" + simd);
  }
  std::vector<std::string> targets = simd_targets();
  targets.push_back("");  // the reference
  for (const std::string& subject : subjects) {
    for (const std::string& look : looks) {
      for (const std::string& simd : targets) {
        EXPECT_TRUE(runs.contains(subject + "/" + look + "/" + simd))
            << subject << ", " << look << ", " << simd;
      }
    }
  }
  EXPECT_EQ(runs.size(), subjects.size() * looks.size() * targets.size());

  EXPECT_EQ(report["looks_beside_physical"].size(), subjects.size() * looks.size());
  for (const json& row : report["looks_beside_physical"]) {
    EXPECT_EQ(row["error"]["max"] == 0, row["look"] == "physical") << row;
  }
  EXPECT_EQ(report["refraction_beside_truth"]["rows"].size(), 17);
  std::set<std::string> traced, choices;
  for (const json& row : report["models_beside_traced_light"]) {
    EXPECT_GT(row["ns_per_pixel"], 0);
    EXPECT_GT(row["flip"], 0) << row;
    EXPECT_LT(row["flip"], 0.5) << row;
    EXPECT_LT(row["ssim"], 1) << row;
    EXPECT_LE(row["offset_pixels"]["median"], row["offset_pixels"]["p95"]) << row;
    EXPECT_LT(row["wrongly_accepted"], 1) << row;
    if (row["parameter"].is_null()) {
      traced.insert(std::string(row["subject"]) + "/" + std::string(row["look"]));
    } else {
      choices.insert(row["parameter"]);
    }
  }
  const auto scenes = std::count_if(report["subjects"].begin(), report["subjects"].end(),
                                    [](const json& s) { return s["kind"] == "scene"; });
  EXPECT_EQ(traced.size(), static_cast<std::size_t>(scenes) * looks.size());
  EXPECT_TRUE(choices.contains("refraction.rejection"));
  std::set<std::string> parameters;
  for (const json& row : report["choices_of_physical"]["rows"]) {
    if (!row["parameter"].is_null()) parameters.insert(row["parameter"]);
  }
  for (const char* name : {"refraction.steps", "refraction.rejection", "depth_fog.distance",
                           "fresnel_reflection.reflectance", "sun_highlight.model"}) {
    EXPECT_TRUE(parameters.contains(name)) << name;
  }
  expect_what_is_brought(report["looks_by_what_is_brought"], subjects.size());
  expect_budgets_kept(report["error_budgets"], subjects.size());
}

void ReportTest::expect_good_page(int width) const {
  const std::string browser = CHROMIUM;
  ASSERT_TRUE(fs::exists(browser))
      << "no browser to look at the page: install chromium (tools/dev setup) and configure anew";
  std::ifstream file(fs::path(LIMPID_TEST_DATA) / "../tool/report_checks.js");
  const std::string checks{std::istreambuf_iterator<char>(file), {}};
  ASSERT_THAT(checks, HasSubstr("result"));
  std::string page = text_of("report/index.html");
  page.insert(page.find("<title>"), "<script>" + checks + "</script>\n");
  write_text("checked.html", page);

  const std::string url = "file://" + (folder_ / "checked.html").string();
  const Ran ran =
      run(folder_, {browser, "--headless", "--no-sandbox", "--disable-gpu",
                    "--disable-dev-shm-usage", "--hide-scrollbars", "--enable-logging=stderr",
                    "--user-data-dir=" + (folder_ / "profile").string(),
                    "--window-size=" + std::to_string(width) + ",3000",
                    "--screenshot=" + (folder_ / "shot.png").string(), "--dump-dom", url});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, Not(HasSubstr("CONSOLE"))) << "the page complains";
  const std::string begin = "<script type=\"application/json\" id=\"result\">";
  const std::size_t at = ran.out.find(begin);
  ASSERT_NE(at, std::string::npos) << "the checks did not run\n" << ran.err;
  const std::size_t from = at + begin.size();
  const json seen = json::parse(ran.out.substr(from, ran.out.find("</script>", from) - from));

  EXPECT_THAT(seen["complaints"], IsEmpty());
  EXPECT_EQ(seen["window_width"], width);
  EXPECT_LE(seen["page_width"], width);
  EXPECT_GT(seen["page_height"], 3000);
  EXPECT_THAT(seen["wide"], IsEmpty());
  EXPECT_GT(seen["images"], 15);
  EXPECT_EQ(seen["broken_images"], 0);
  EXPECT_GE(seen["plots"].size(), 6);  // at least one of them plots error budgets
  for (const json& plot : seen["plots"]) {
    EXPECT_GT(plot["width"], 400) << plot["title"];
    EXPECT_GT(plot["height"], 200) << plot["title"];
    EXPECT_GT(plot["texts"], 10) << plot["title"];
    EXPECT_GT(plot["markers"], 4) << plot["title"];
    EXPECT_THAT(plot["overlaps"], IsEmpty()) << plot["title"];
    EXPECT_THAT(plot["outside"], IsEmpty()) << plot["title"];
  }
  const std::vector<double> rising = seen["rising"], falling = seen["falling"];
  EXPECT_GT(rising.size(), 30);
  EXPECT_TRUE(std::is_sorted(rising.begin(), rising.end()));
  EXPECT_TRUE(std::is_sorted(falling.rbegin(), falling.rend()));

  const ImageFile shot = read_image(folder_ / "shot.png");
  EXPECT_EQ(shot.window.width(), width);
  std::set<float> greens;
  for (int y = 0; y < shot.window.height(); ++y) {
    for (int x = 0; x < width; ++x) greens.insert(shot.planes[1].view().at(x, y));
  }
  EXPECT_GT(greens.size(), 100) << "the screenshot is blank";
}

TEST_F(ReportTest, AQuickOneHasAllRowsAndAPageThatABrowserShows) {
  if (kSanitized) GTEST_SKIP() << "takes minutes; the tests of judge/report run its parts";
  const Ran ran = limpid({"report", "-o", "report", "--quick", "--rounds", "1"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out, "report/report.json\nreport/index.html\n");
  EXPECT_THAT(ran.err, HasSubstr("lagoon, fast, reference, 1 thread: "));
  EXPECT_THAT(ran.err, HasSubstr("truth, snell march, shorten: "));
  expect_rows(json::parse(text_of("report/report.json")));

  EXPECT_THAT(text_of("report/index.html"), Not(HasSubstr("://")));
  const Ran parsed =
      run(folder_, {PYTHON3, "-c", "import xml.dom.minidom as d; d.parse('report/index.html')"});
  EXPECT_EQ(parsed.code, 0) << parsed.err;
  expect_good_page(1400);
  expect_good_page(500);
}

TEST_F(ReportTest, HardCasesAreATableAPageAndRows) {
  if (kSanitized) GTEST_SKIP() << "takes a minute; the tests of judge/hard run each case";
  const Ran ran = limpid({"report", "--hard", "-o", "hard"});
  ASSERT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("depth: 24 bit reversed, eye depth "));
  EXPECT_THAT(ran.out, HasSubstr("hard/hard.json\nhard/hard.html\n"));
  const json hard = json::parse(text_of("hard/hard.json"));
  EXPECT_GT(hard["rows"].size(), 100);
  for (const json& row : hard["rows"]) EXPECT_TRUE(row["passed"]) << row;
  EXPECT_THAT(text_of("hard/hard.html"), Not(HasSubstr("://")));
  const Ran parsed =
      run(folder_, {PYTHON3, "-c", "import xml.dom.minidom as d; d.parse('hard/hard.html')"});
  EXPECT_EQ(parsed.code, 0) << parsed.err;
}

TEST_F(ReportTest, WrongUsage) {
  expect_refused(limpid({"report", "-o", "r", "--hard", "--quick"}), {"--hard", "no --size"}, 2);
  expect_refused(limpid({"report"}), {"-o FOLDER"}, 2);
  expect_refused(limpid({"report", "-o", "r", "--size", "12"}), {"--size 12", "WxH"}, 2);
  expect_refused(limpid({"report", "-o", "r", "--size", "8x8"}), {"--size 8x8", "16 ... 8192"}, 2);
  expect_refused(limpid({"report", "-o", "r", "--rounds", "0"}), {"--rounds 0", "1 ..."}, 2);
  expect_refused(limpid({"report", "-o", "r", "--rounds", "many"}), {"many", "number"}, 2);
  expect_refused(limpid({"report", "-o", "plate.exr"}), {"plate.exr", "not a folder"});
  EXPECT_FALSE(fs::exists(folder_ / "r"));
}

}  // namespace
}  // namespace limpid::test
