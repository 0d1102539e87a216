#include "judge/report/report.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "limpid/core/error.h"

#include "judge/report/jpeg.h"
#include "judge/report/made_report.h"
#include "judge/report/numbers.h"
#include "judge/report/page.h"
#include "judge/report/report_json.h"
#include "judge/report/rounds.h"
#include "paths.h"
#include "show/encoded.h"

namespace limpid {
namespace {

using nlohmann::json;
using test::made_report;
using ::testing::ElementsAre;

namespace fs = std::filesystem;

fs::path scratch_folder() {
  const fs::path path = fs::path(testing::TempDir()) /
                        (std::string("limpid_report_") +
                         testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::remove_all(path);
  return path;
}

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

// ---- rows as JSON

TEST(ReportJson, HoldsEveryRow) {
  const Report report = made_report();
  const json j = json::parse(to_json(report));
  EXPECT_EQ(j["schema"], "limpid-report");
  EXPECT_EQ(j["schema_version"], 2);
  EXPECT_EQ(j["machine"]["cores"], 2);
  EXPECT_EQ(j["machine"]["simd"], json({"avx2", "scalar"}));
  EXPECT_EQ(j["build"]["limpid"], "1.2.3");
  EXPECT_EQ(j["settings"]["rounds"], 3);
  EXPECT_EQ(j["subjects"][0]["wet_share"], 0.5);
  ASSERT_EQ(j["looks_by_runner"].size(), 10);
  EXPECT_EQ(j["looks_by_runner"][4]["runner"], "gpu");
  EXPECT_EQ(j["looks_by_runner"][4]["simd"], "a <GPU>");
  EXPECT_EQ(j["looks_by_runner"][0]["runner"], "reference");
  EXPECT_TRUE(j["looks_by_runner"][0]["simd"].is_null());
  EXPECT_EQ(j["looks_by_runner"][1]["error"]["p99_99"], 1e-5);
  ASSERT_EQ(j["looks_beside_physical"].size(), 2);
  EXPECT_EQ(j["looks_beside_physical"][1]["differs"][0], "no prism_split");
  const json truth = j["refraction_beside_truth"]["rows"];
  ASSERT_EQ(truth.size(), 3);
  EXPECT_TRUE(truth[0]["ns_per_pixel"].is_null());  // the dry picture costs nothing to make
  EXPECT_EQ(truth[2]["relative_error_in_frame"], 0.023);
  const json traced = j["models_beside_traced_light"];
  ASSERT_EQ(traced.size(), 3);
  EXPECT_EQ(traced[1]["look"], "fast");
  EXPECT_TRUE(traced[1]["parameter"].is_null());
  EXPECT_EQ(traced[2]["parameter"], "refraction.rejection");
  EXPECT_EQ(traced[2]["offset_pixels"]["p95"], 3.5);
  const json brought = j["looks_by_what_is_brought"];
  EXPECT_EQ(brought["samples_a_pixel"], 16);
  EXPECT_EQ(brought["subjects"][0]["wave_length"], 0.66);
  EXPECT_EQ(brought["subjects"][0]["near_share_of_wet"], 0.9);
  ASSERT_EQ(brought["rows"].size(), 6);
  EXPECT_EQ(brought["rows"][0]["brought"], "color, depth");
  EXPECT_EQ(brought["rows"][2]["relative_error_near"], 0.12);
  EXPECT_TRUE(brought["rows"][1]["relative_error_far"].is_null());  // no pixel is far
  EXPECT_EQ(brought["rows"][5]["look"], "fast");
  EXPECT_EQ(brought["rows"][5]["flip_wet"], 0.15);
  const json choices = j["choices_of_physical"]["rows"];
  ASSERT_EQ(choices.size(), 2);
  EXPECT_TRUE(choices[0]["parameter"].is_null());
  EXPECT_EQ(choices[1]["value"], "0");
  EXPECT_EQ(j["figures"]["subjects"],
            json({{{"name", "pond"}, {"caption", "a caption"}, {"width", 64}, {"height", 36}}}));
  EXPECT_EQ(j["figures"].size(), 8);
  EXPECT_EQ(j["figures"]["brought"], json::array());
  EXPECT_EQ(j["heat_scale"]["decades"], 3);
  ASSERT_EQ(j["heat_scale"]["colors"].size(), 9);
  EXPECT_EQ(j["heat_scale"]["colors"][0], json({68, 1, 84}));  // viridis
  EXPECT_EQ(j["heat_scale"]["colors"][8], json({253, 231, 37}));
  ASSERT_EQ(j["error_budgets"].size(), 2);
  EXPECT_EQ(j["error_budgets"][1]["max_error"], 0.01);
  EXPECT_EQ(j["error_budgets"][1]["bound"], 0.0099);
}

TEST(ReportJson, SaysWhatIsOnTheFront) {
  Report report = made_report();
  report.truth.push_back({"slow and exact in frame", 200, 0.5, 0.001});
  report.choices.push_back({"refraction.steps", "9", 120, {0.001, 0.1, 0.2, 0.3}});
  report.choices.push_back({"refraction.steps", "8", 10, {HUGE_VAL, 0.1, 0.2, 0.3}});
  const json j = json::parse(to_json(report));
  const auto told = [](const json& rows, const char* key) {
    std::vector<bool> on;
    for (const json& row : rows) on.push_back(row[key]);
    return on;
  };
  const json truth = j["refraction_beside_truth"]["rows"];
  EXPECT_THAT(told(truth, "on_front_wet"), ElementsAre(false, true, true, false));
  EXPECT_THAT(told(truth, "on_front_in_frame"), ElementsAre(false, true, true, true));
  EXPECT_THAT(told(j["choices_of_physical"]["rows"], "on_front"),
              ElementsAre(true, true, false, false));
}

TEST(ReportJson, InfinityIsNullAndNamesAreEscaped) {
  Report report = made_report("a \"pond\"\xff");
  report.runners[1].error.max = std::numeric_limits<double>::infinity();
  const json j = json::parse(to_json(report));
  EXPECT_TRUE(j["looks_by_runner"][1]["error"]["max"].is_null());
  EXPECT_EQ(j["subjects"][0]["name"], "a \"pond\"\xef\xbf\xbd");
}

// ---- numbers to read

TEST(ShortNumber, HasThreeDigits) {
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(1), "1.00");
  EXPECT_EQ(short_number(27.154), "27.2");
  EXPECT_EQ(short_number(0.031049), "0.0310");
  EXPECT_EQ(short_number(0.00099999), "0.00100");
  EXPECT_EQ(short_number(999.6), "1000");
  EXPECT_EQ(short_number(12345), "12345");
  EXPECT_EQ(short_number(123456), "1.23·10⁵");
  EXPECT_EQ(short_number(5.864e-7), "5.86·10⁻⁷");
  EXPECT_EQ(short_number(-3.2e-12), "-3.20·10⁻¹²");
  EXPECT_EQ(short_number(std::numeric_limits<double>::infinity()), "∞");
  EXPECT_EQ(short_number(std::nan("")), "-");
}

TEST(PlainNumber, HasTheDigitsItTakes) {
  EXPECT_EQ(plain_number(0), "0");
  EXPECT_EQ(plain_number(0.0005), "0.0005");
  EXPECT_EQ(plain_number(2), "2");
}

// ---- pictures

TEST(Jpeg, Base64) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(Jpeg, BeginsAndEndsAsOne) {
  Plane grey({0, 0, 5, 3});
  grey.view().at(2, 1) = std::nanf("");
  const std::string jpeg = jpeg_of({grey.view(), grey.view(), grey.view()});
  EXPECT_TRUE(jpeg.starts_with("\xff\xd8\xff"));
  EXPECT_TRUE(jpeg.ends_with("\xff\xd9"));
}

// ---- files

TEST(WriteReport, MakesTheFolderAndBothFilesAndReplacesThem) {
  const fs::path folder = scratch_folder() / "deeper";
  for (int i = 0; i < 2; ++i) {
    write_report(folder, made_report());
    EXPECT_EQ(text_of(folder / "report.json"), to_json(made_report()));
    EXPECT_EQ(text_of(folder / "index.html"), to_html(made_report()));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2);
  fs::remove_all(folder.parent_path());
}

TEST(WriteReport, RefusesAFileInTheFoldersPlace) {
  const fs::path path = scratch_folder();
  std::ofstream(path) << "mine";
  EXPECT_THROW(make_report_folder(path), Error);
  EXPECT_THROW(make_report_folder(path / "below"), Error);
  EXPECT_EQ(text_of(path), "mine");
  fs::remove(path);
}

// ---- measuring

TEST(Rounds, GoOverAllWorkInTurn) {
  std::vector<int> order;
  std::vector<Timed> work{{[&] { order.push_back(0); }}, {[&] { order.push_back(1); }}};
  time_rounds(work, 3);
  EXPECT_THAT(order, ElementsAre(0, 1, 0, 1, 0, 1));
  EXPECT_GE(work[0].best_seconds, 0);
  EXPECT_LT(work[1].best_seconds, 10);
}

TEST(Rounds, TheThreadsClockCountsWhatTheThreadDoes) {
  volatile double sum = 0;
  std::vector<Timed> work{{[&] {
                             for (int i = 0; i < 200000; ++i) sum = sum + i;
                           },
                           Clock::kThread},
                          {[] {}, Clock::kThread},
                          {[] {}, Clock::kWall}};
  time_rounds(work, 3);
  EXPECT_GT(work[0].best_seconds, work[1].best_seconds);
  EXPECT_GE(work[2].best_seconds, 0);
}

TEST(MeasureReport, RefusesOptionsThatMeanNothing) {
  const ReportOptions good{.data = LIMPID_DATA};
  for (const Size size : {Size{0, 90}, Size{160, -1}, Size{15, 90}, Size{160, 9000}}) {
    ReportOptions options = good;
    options.size = size;
    EXPECT_THROW(measure_report(options), Error) << size.width << "x" << size.height;
  }
  for (const int rounds : {0, -1, 1001}) {
    ReportOptions options = good;
    options.rounds = rounds;
    EXPECT_THROW(measure_report(options), Error) << rounds;
  }
  ReportOptions nowhere = good;
  nowhere.data = scratch_folder();
  EXPECT_THROW(measure_report(nowhere), Error);
}

}  // namespace
}  // namespace limpid
