#include "judge/report/report.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "limpid/core/error.h"

#include "judge/report/html_parts.h"
#include "judge/report/jpeg.h"
#include "judge/report/made_report.h"
#include "judge/report/page.h"
#include "judge/report/report_json.h"
#include "judge/report/rounds.h"

namespace limpid {
namespace {

using nlohmann::json;
using test::made_report;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

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

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
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
  ASSERT_EQ(j["looks_by_runner"].size(), 8);
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
  ASSERT_EQ(j["error_budgets"].size(), 2);
  EXPECT_EQ(j["error_budgets"][1]["max_error"], 0.01);
  EXPECT_EQ(j["error_budgets"][1]["bound"], 0.0099);
}

TEST(ReportJson, InfinityIsNullAndNamesAreEscaped) {
  Report report = made_report("a \"pond\"\xff");
  report.runners[1].error.max = std::numeric_limits<double>::infinity();
  const json j = json::parse(to_json(report));
  EXPECT_TRUE(j["looks_by_runner"][1]["error"]["max"].is_null());
  EXPECT_EQ(j["subjects"][0]["name"], "a \"pond\"\xef\xbf\xbd");
}

// ---- the page

TEST(ReportPage, NamesNothingOutsideItself) {
  const std::string html = to_html(made_report());
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("@import")));
  EXPECT_THAT(html, Not(HasSubstr("<link")));
  EXPECT_EQ(count(html, "src="), count(html, "src=\"data:image/jpeg;base64,"));
  EXPECT_EQ(count(html, "href="), count(html, "href=\"#"));
  EXPECT_EQ(count(html, "url("), count(html, "url(#"));
  for (const char* id : {"subjects", "runners", "looks", "truth", "brought", "choices", "budgets",
                         "method", "machine"}) {
    EXPECT_THAT(html, HasSubstr("<section id=\"" + std::string(id) + "\">"));
    EXPECT_THAT(html, HasSubstr("href=\"#" + std::string(id) + "\""));
  }
  EXPECT_EQ(count(html, "<svg class=\"plot\""), 8);
}

TEST(ReportPage, NamesAreTextAndNotMarkup) {
  const std::string html = to_html(made_report("<b>&\"'"));
  EXPECT_THAT(html, HasSubstr("&lt;b&gt;&amp;&quot;&#39;"));
  EXPECT_THAT(html, Not(HasSubstr("<b>&")));
  EXPECT_THAT(html, HasSubstr("an &lt;abacus&gt;"));
}

TEST(ReportPage, WhatWasNotMeasuredHasNoSection) {
  Report report = made_report();
  report.truth.clear();
  report.choices.clear();
  report.brought.clear();
  const std::string html = to_html(report);
  EXPECT_THAT(html, Not(HasSubstr("id=\"truth\"")));
  EXPECT_THAT(html, Not(HasSubstr("href=\"#truth\"")));
  EXPECT_THAT(html, Not(HasSubstr("id=\"choices\"")));
  EXPECT_THAT(html, Not(HasSubstr("id=\"brought\"")));
}

TEST(ReportPage, EachRowHasABufferMore) {
  const std::string html = to_html(made_report());
  const std::string rows = html.substr(html.find("<section id=\"brought\">"));
  EXPECT_THAT(rows, HasSubstr("<td class=\"wrap\">color, depth</td>"));
  EXPECT_THAT(rows, HasSubstr("<td class=\"wrap\">and shadow</td>"));
  EXPECT_EQ(count(rows, "<td class=\"wrap\">and "), 4);    // of two looks
  EXPECT_THAT(rows, HasSubstr("<td class=\"n\">-</td>"));  // no pixel is far
}

TEST(ReportPage, BudgetsThatChangeNothingAreSaidAndNotDrawn) {
  Report report = made_report();
  report.budgets[1].error = {};
  const std::string html = to_html(report);
  EXPECT_EQ(count(html, "<svg class=\"plot\""), 7);
  EXPECT_THAT(html, HasSubstr("physical: no error that was allowed changed a pixel."));
}

TEST(ReportPage, AnInfiniteErrorStandsInTheTableAlone) {
  Report report = made_report();
  report.choices[1].error.mean = std::numeric_limits<double>::infinity();
  EXPECT_THAT(to_html(report), HasSubstr(">∞</td>"));
}

TEST(HtmlTable, SortsByNumbersAndMarksRows) {
  HtmlTable table("a & b", {{"name", "", false}, {"time", "ns"}});
  table.add({"x", Cell(0.25)}, true);
  table.add({"y", percent(0.125, 1)});
  const std::string html = table.html();
  EXPECT_THAT(html, HasSubstr("<caption>a &amp; b</caption>"));
  EXPECT_THAT(html, HasSubstr("<tr class=\"marked\"><td>x</td><td class=\"n\" "
                              "data-v=\"0.25\">0.250</td></tr>"));
  EXPECT_THAT(html, HasSubstr("data-v=\"0.125\">12.5 %</td>"));
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
