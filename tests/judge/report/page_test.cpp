#include "judge/report/page.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "judge/report/browser.h"
#include "judge/report/made_report.h"
#include "judge/report/numbers.h"

/// Pages of invented reports in a browser, and calls of the page's own functions.

namespace limpid {
namespace {

using nlohmann::json;
using test::asked;
using test::made_report;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// Values on the page of an invented report, for tests of its script functions.
json called(const std::string& expression) { return asked(to_html(made_report()), expression); }

// ---- numbers

TEST(PageNumbers, AreWrittenAsTheToolWritesThem) {
  const std::vector<double> values = {0,        1,      27.154, 0.031049,  0.00099999,
                                      999.6,    12345,  99999,  123456,    5.864e-7,
                                      -3.2e-12, -0.021, 1e100,  0.0009999, 0.5};
  std::vector<std::string> written;
  for (const double value : values) written.push_back(short_number(value));
  EXPECT_EQ(called(json(values).dump() + ".map(shortNumber)"), written);
  EXPECT_EQ(called("[Infinity, -Infinity, NaN, null].map(shortNumber)"),
            json({"∞", "-∞", "-", "-"}));
}

TEST(PageNumbers, ForThePlotAndForWhatWasWrittenByHand) {
  EXPECT_EQ(called("[[12, 12.5, 100, 1 / 3, -0.001].map(coordinate),"
                   " [0, 0.0005, 2, 1e-7].map(plainNumber)]"),
            json({{"12", "12.5", "100", "0.33", "0"}, {"0", "0.0005", "2", "0.0000001"}}));
}

// ---- tables

TEST(PageTable, ShowsNumbersMarksRowsAndSorts) {
  const json seen = called(R"js((() => {
    const made = table("a & <b>", [word("name"), number("time", "ns"), long("why")], [
      {cells: ["x", 0.25, "<i>"], marked: true}, {cells: ["z", null, ""], first: true},
      {cells: ["y", percent(0.125, 1), ""], first: true}]);
    document.body.append(made);
    const names = () => Array.from(made.querySelectorAll("tbody tr")).map((r) => r.firstChild.textContent).join("");
    const html = made.innerHTML, orders = [];
    for (const i of [1, 1, 0, 0]) {
      made.querySelectorAll("button")[i].click();
      orders.push(names());
    }
    return {html, orders, sorted: made.querySelector("th").getAttribute("aria-sort"),
            apart: made.querySelectorAll("tr.first").length};
  })())js");
  const std::string html = seen["html"];
  EXPECT_THAT(html, HasSubstr("<caption>a &amp; &lt;b&gt;</caption>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\" class=\"n\"><button type=\"button\">time "
                              "<span class=\"unit\">ns</span></button></th>"));
  EXPECT_THAT(html, HasSubstr("<tr class=\"marked\"><td>x</td><td class=\"n\" data-v=\"0.25\">"
                              "0.250</td><td class=\"wrap\">&lt;i&gt;</td></tr>"));
  EXPECT_THAT(html, HasSubstr("<tr class=\"first\"><td>z</td><td class=\"n\">-</td>"));
  EXPECT_THAT(html, HasSubstr("data-v=\"0.125\">12.5 %</td>"));
  EXPECT_EQ(seen["orders"][0], "zyx");  // '-' before all numbers
  EXPECT_EQ(seen["orders"][1], "xyz");
  EXPECT_EQ(seen["orders"][2], "xyz");
  EXPECT_EQ(seen["orders"][3], "zyx");
  EXPECT_EQ(seen["sorted"], "descending");
  EXPECT_EQ(seen["apart"], 0);
}

// ---- axes

TEST(PageAxis, BeginsAndEndsAtRoundNumbersBeyondTheValues) {
  const json seen = called(R"js((() => {
    const axis = logAxis([168, 21.5, 30]);
    return {ticks: axis.ticks.map((t) => t.value), labels: axis.ticks.map((t) => t.label).filter((l) => l),
            places: [10, 200, Math.sqrt(2000)].map(axis.place)};
  })())js");
  EXPECT_EQ(seen["ticks"], json({10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 200}));
  EXPECT_EQ(seen["labels"], json({"10", "20", "50", "100", "200"}));
  EXPECT_EQ(seen["places"][0], 0);
  EXPECT_EQ(seen["places"][1], 1);
  EXPECT_DOUBLE_EQ(seen["places"][2], 0.5);
}

TEST(PageAxis, LeavesAirAndNumbersWhatThereIsRoomFor) {
  EXPECT_EQ(
      called("[[10, 20], [3e-8, 2e-3], [1]].map((values) =>"
             " logAxis(values).ticks.map((t) => t.label).filter((l) => l))"),
      json(
          {{"5", "10", "20", "50"}, {"10⁻⁷", "10⁻⁶", "10⁻⁵", "10⁻⁴", "0.001"}, {"0.5", "1", "2"}}));
}

TEST(PageAxis, RefusesWhatHasNoLogarithm) {
  const json seen = called(
      "[[0, 1], [-1, 1], [1, Infinity], [NaN, 1], [1, NaN], []].map((values) => {"
      " try { logAxis(values); } catch (error) { return error.name; } })");
  ASSERT_EQ(seen.size(), 6);
  EXPECT_THAT(seen.get<std::vector<std::string>>(), Each("RangeError"));
}

// ---- labels

TEST(PageLabels, NeitherMeetNorCoverMarkers) {
  const json seen = called(R"js((() => {
    // A dense group: 24 points in a small part of the frame.
    const wishes = Array.from({length: 24}, (_, i) => (
        {x: 200 + 23 * (i % 6), y: 150 + 19 * Math.floor(i / 6) + 3 * (i % 2), width: 90, height: 14}));
    const frame = {x0: 0, y0: 0, x1: 640, y1: 360};
    const places = placeLabels(wishes, frame), boxes = places.filter((p) => p).map((p) => p.box);
    // The comparison is written independently of the page's own code.
    const overlap = (a, b) => Math.min(a.x1, b.x1) > Math.max(a.x0, b.x0) && Math.min(a.y1, b.y1) > Math.max(a.y0, b.y0);
    return {places: places.length, placed: boxes.length,
            meeting: boxes.filter((a, i) => boxes.some((b, j) => j < i && overlap(a, b))).length,
            outside: boxes.filter((b) => b.x0 < 0 || b.y0 < 0 || b.x1 > 640 || b.y1 > 360).length,
            covering: boxes.filter((b) => wishes.some((w) =>
                overlap(b, {x0: w.x - 4, y0: w.y - 4, x1: w.x + 4, y1: w.y + 4}))).length};
  })())js");
  EXPECT_EQ(seen["places"], 24);
  EXPECT_GT(seen["placed"], 8);
  EXPECT_EQ(seen["meeting"], 0);
  EXPECT_EQ(seen["outside"], 0);
  EXPECT_EQ(seen["covering"], 0);
}

TEST(PageLabels, ALonelyOneStandsRightBesideItsMarker) {
  const json places = called(
      "[...placeLabels([{x: 100, y: 100, width: 50, height: 14}, {x: 100, y: 200, width: 0, "
      "height: 14},"
      " {x: 630, y: 100, width: 50, height: 14}], {x0: 0, y0: 0, x1: 640, y1: 360}),"
      " ...placeLabels([{x: 5, y: 5, width: 50, height: 14}], {x0: 0, y0: 0, x1: 40, y1: 10})]");
  EXPECT_EQ(places[0], json({{"box", {{"x0", 109}, {"y0", 93}, {"x1", 159}, {"y1", 107}}},
                             {"lead", nullptr}}));
  EXPECT_TRUE(places[1].is_null());               // this point asks for no label
  EXPECT_DOUBLE_EQ(places[2]["box"]["x1"], 621);  // no room to the right
  EXPECT_TRUE(places[3].is_null());               // no room at all
}

// ---- the plot

/// The number of matches of each selector in the plot of two points, after `change`.
json plotted(const std::string& change, const std::vector<std::string>& selectors) {
  return called(
      "(() => { const plot = {title: 'time & error', errorAxis: 'mean error', hasFront: true, "
      "points: ["
      "{time: 20, error: 0.1, series: 'a', label: 'cheap <model>', about: '20 ns', onFront: true},"
      "{time: 100, error: 0, series: 'a', label: 'exact', about: '100 ns', onFront: true}]};" +
      change + "; const svg = scatter(plot); return svg && " + json(selectors).dump() +
      ".map((s) => s[0] === '=' ? Array.from(svg.querySelectorAll('text')).filter((t) =>"
      " t.textContent === s.slice(1)).length : svg.querySelectorAll(s).length); })()");
}

TEST(PagePlot, HasAxesLabelsAndTheFront) {
  EXPECT_EQ(plotted("", {"=cheap <model>", "=exact", "=time, ns/pixel, one thread", "=mean error",
                         "=0", ".m.s0.on", ".front", ".link", "g > title"}),
            json({1, 1, 1, 1, 1, 2, 1, 0, 2}));  // 0: the band of exact choices
  EXPECT_EQ(called("scatter({title: 'time & error', errorAxis: '', points: [{time: 1, error: 1,"
                   " series: '', label: '', about: ''}]}).getAttribute('aria-label')"),
            "time & error");
}

TEST(PagePlot, BeatenPointsAreHollow) {
  EXPECT_EQ(
      plotted("plot.points.push({time: 150, error: 0.2, series: 'a', label: 'worse', about: '',"
              " onFront: false})",
              {".m.s0.on", ".m.s0:not(.on)", "=worse"}),
      json({2, 1, 1}));
}

TEST(PagePlot, SeveralSeriesHaveALegendAndMayBeConnected) {
  // In the legend and in the plot.
  EXPECT_EQ(plotted("plot.points[1].series = 'b'; plot.hasFront = false; plot.connected = true",
                    {".m.s1.on", ".link", ".front", "=b"}),
            json({2, 2, 0, 1}));
}

TEST(PagePlot, TheEighthSeriesLooksAsTheFirst) {
  EXPECT_EQ(plotted("plot.points = [...'abcdefgh'].map((series, i) => ({...plot.points[0], time: i "
                    "+ 1, series}))",
                    {"circle.m.s0.on"}),
            json({4}));
}

TEST(PagePlot, OfExactChoicesAlone) {
  EXPECT_EQ(plotted("plot.points[0].error = 0", {"=0", ".m.on"}), json({1, 2}));
}

TEST(PagePlot, WhatCannotBeDrawnIsLeftToTheTable) {
  EXPECT_EQ(
      plotted(
          "for (const [time, error] of [[0, 1], [-1, 1], [Infinity, 1], [1, -1], [1, Infinity], "
          "[1, NaN],"
          " [NaN, 1], [null, 1], [1, null]]) plot.points.push({...plot.points[0], time, error})",
          {".m"}),
      json({2}));
  EXPECT_TRUE(plotted("plot.points = [{...plot.points[0], error: Infinity}]", {".m"}).is_null());
  EXPECT_TRUE(plotted("plot.points = []", {".m"}).is_null());
}

// ---- the page

TEST(ReportPage, NamesNothingOutsideItself) {
  const std::string html = to_html(made_report());
  EXPECT_THAT(html, Not(HasSubstr("://")));
  EXPECT_THAT(html, Not(HasSubstr("@import")));
  EXPECT_THAT(html, Not(HasSubstr("<link")));
  EXPECT_THAT(html, Not(HasSubstr(".css\"")));
  EXPECT_THAT(html, Not(HasSubstr(".js\"")));
  EXPECT_THAT(html, HasSubstr("<noscript>"));
  const json seen = asked(html, R"js(({
    sources: Array.from(document.querySelectorAll("[src]")).map((e) => e.getAttribute("src")),
    links: Array.from(document.querySelectorAll("[href]")).map((e) => e.getAttribute("href")),
    fills: Array.from(document.querySelectorAll("[fill]")).map((e) => e.getAttribute("fill")),
    sections: Array.from(document.querySelectorAll("main > section")).map((s) => "#" + s.id),
    headings: document.querySelectorAll("main > section > h2").length,
    plots: document.querySelectorAll("svg.plot").length, tables: document.querySelectorAll("table").length,
    places: document.querySelectorAll("div[data-slot], span[data-slot]").length,
    picture: document.querySelector("#subjects img").outerHTML,
  }))js");
  EXPECT_EQ(seen["sources"].size(), 1);
  EXPECT_THAT(seen["sources"].get<std::vector<std::string>>(),
              Each(StartsWith("data:image/jpeg;base64,")));
  EXPECT_EQ(seen["sections"], json({"#subjects", "#runners", "#looks", "#truth", "#traced",
                                    "#brought", "#choices", "#budgets", "#method", "#machine"}));
  EXPECT_EQ(seen["links"], seen["sections"]);
  EXPECT_EQ(seen["headings"], 10);
  EXPECT_THAT(seen["fills"].get<std::vector<std::string>>(), Each(StartsWith("url(#")));
  EXPECT_EQ(seen["plots"], 8);
  EXPECT_EQ(seen["tables"], 10);
  EXPECT_EQ(seen["places"], 0) << "a place in the page that no script fills";
  EXPECT_EQ(
      seen["picture"],
      "<img alt=\"a caption\" width=\"64\" height=\"36\" src=\"data:image/jpeg;base64,/9j/AA==\">");
}

TEST(ReportPage, NamesAreTextAndNotMarkup) {
  const std::string name = "</script ><b id='x'>&\"']]>", page = to_html(made_report(name));
  EXPECT_THAT(page, Not(HasSubstr(name)));
  const json seen = asked(page,
                          "[report.subjects[0].name, document.getElementById('x'),"
                          " document.querySelector('#subjects td').textContent,"
                          " document.querySelector('#machine dd').textContent]");
  EXPECT_EQ(seen, json({name, nullptr, name, "an <abacus>"}));
}

TEST(ReportPage, TellsTheMostImportantNumbersFirst) {
  const json seen =
      called("Array.from(document.querySelectorAll('header li')).map((i) => i.textContent)");
  EXPECT_EQ(
      seen,
      json({"The look physical takes 100 ns per pixel on the plate pond (64x36, 50 % wet, one "
            "thread, avx2), 50.0 ns on 2 threads: 104 ms for 1920x1080 pixels.",
            "The look fast takes 50 % of that; its picture differs from that of physical by "
            "0.0100 in the mean (white = 1).",
            "The fused runner is 10.0 to 10.0 times as fast as the reference in double, both "
            "on one thread; its mean error is at most 1.00·10⁻⁷ over all looks and subjects.",
            "Against a path-traced picture of the same water, the march along refracted rays "
            "reduces the error from 13.0 % to 3.1 %, at 8.00 times the time."}));
}

TEST(ReportPage, WhatWasNotMeasuredHasNoSection) {
  Report report = made_report();
  report.truth.clear();
  report.choices.clear();
  report.brought.clear();
  EXPECT_EQ(asked(to_html(report),
                  "['truth', 'choices', 'brought', 'looks'].map((id) => document.querySelectorAll("
                  "`#${id}, a[href='#${id}']`).length)"),
            json({0, 0, 0, 2}));
}

TEST(ReportPage, EachRowHasABufferMore) {
  const json seen = called(
      "Array.from(document.querySelector('#brought table').tBodies[0].rows).map((r) =>"
      " [r.children[2].className, r.children[2].textContent, r.children[6].textContent])");
  ASSERT_EQ(seen.size(), 6);
  for (int look = 0; look < 2; ++look) {
    EXPECT_EQ(seen[3 * look], json({"wrap", "color, depth", "0.410"}));
    EXPECT_EQ(seen[3 * look + 1], json({"wrap", "and shadow", "-"}));  // no pixel is far
    EXPECT_EQ(seen[3 * look + 2], json({"wrap", "and reflection", "0.400"}));
  }
}

TEST(ReportPage, BudgetsThatChangeNothingAreSaidAndNotDrawn) {
  Report report = made_report();
  report.budgets[1].error = {};
  const json seen = asked(to_html(report),
                          "[document.querySelectorAll('svg.plot').length,"
                          " document.getElementById('budgets').textContent]");
  EXPECT_EQ(seen[0], 7);
  EXPECT_THAT(std::string(seen[1]), HasSubstr("physical: no budget changed a pixel."));
}

TEST(ReportPage, AnInfiniteErrorStandsInTheTableAlone) {
  Report report = made_report();
  report.choices[1].error.mean = std::numeric_limits<double>::infinity();
  EXPECT_EQ(asked(to_html(report),
                  "[document.querySelectorAll('#choices tbody tr')[1].children[3].textContent,"
                  " document.querySelectorAll('#choices svg g > .m').length]"),
            json({"∞", 1}));
}

TEST(ReportPage, WhatIsOnTheFrontIsSetOff) {
  Report report = made_report();
  report.choices.push_back({"refraction.steps", "9", 120, {0.001, 0.1, 0.2, 0.3}});
  EXPECT_EQ(asked(to_html(report),
                  "['#truth', '#choices'].map((id) => Array.from(document.querySelectorAll("
                  "id + ' tbody tr')).map((r) => r.className + ' ' + r.lastChild.textContent))"),
            json({{" -", "marked all wet, in frame", "marked all wet, in frame"},
                  {"marked 0", "marked 0.300", " 0.300"}}));
}

// ---- the hard cases

TEST(HardPage, HasARowACase) {
  const json rows = {{{"group", "a"},
                      {"name", "b <c>"},
                      {"quantity", "frogs"},
                      {"reason", "none"},
                      {"bound", 2},
                      {"measured", 1.5},
                      {"margin", 0.25},
                      {"values", 7},
                      {"worst", ""},
                      {"passed", true}},
                     {{"group", "d"},
                      {"name", "e"},
                      {"quantity", "newts"},
                      {"reason", "some"},
                      {"bound", 2},
                      {"measured", nullptr},
                      {"margin", nullptr},
                      {"values", 7},
                      {"worst", "there"},
                      {"passed", false}}};
  const json hard{{"limpid", "1.2.3"},
                  {"compiler", "GNU"},
                  {"processor", "an <abacus>"},
                  {"simd", {"avx2", "scalar"}},
                  {"rows", rows}};
  const json seen = asked(to_hard_html(hard.dump()), R"js([
    ...Array.from(document.querySelectorAll("tbody tr")).map((r) =>
        r.className + "|" + Array.from(r.children).map((c) => c.textContent).join("|")),
    document.querySelector(".sub").textContent, document.querySelector("header b").textContent])js");
  EXPECT_EQ(seen, json({"|a: b <c>|frogs|2.00|1.50|25.0 %|7|none|-",
                        "marked|d: e|newts|2.00|not finite|-|7|some|there",
                        "limpid 1.2.3, GNU, an <abacus>, avx2, scalar", "1 of 2"}));
}

}  // namespace
}  // namespace limpid
