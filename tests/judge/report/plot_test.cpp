#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/error.h"

#include "judge/report/labels.h"
#include "judge/report/log_axis.h"
#include "judge/report/markup.h"
#include "judge/report/scatter.h"

namespace limpid {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// ---- text

TEST(Markup, EscapesWhatMeansSomethingInXml) {
  EXPECT_EQ(escaped("a < b && c > \"d\" 'e'"),
            "a &lt; b &amp;&amp; c &gt; &quot;d&quot; &#39;e&#39;");
  EXPECT_EQ(escaped("two\nlines\x1b[1m"), "two?lines?[1m");
  EXPECT_EQ(escaped("10⁻⁵ · µs"), "10⁻⁵ · µs");
}

TEST(Markup, Coordinates) {
  EXPECT_EQ(coordinate(12), "12");
  EXPECT_EQ(coordinate(12.5), "12.5");
  EXPECT_EQ(coordinate(100), "100");
  EXPECT_EQ(coordinate(1 / 3.0), "0.33");
  EXPECT_EQ(coordinate(-0.001), "0");
}

TEST(Markup, NumbersHaveThreeDigits) {
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

TEST(Markup, PlainNumbersHaveTheDigitsTheyTake) {
  EXPECT_EQ(plain_number(0), "0");
  EXPECT_EQ(plain_number(0.0005), "0.0005");
  EXPECT_EQ(plain_number(2), "2");
}

// ---- axes

std::vector<std::string> labels(const LogAxis& axis) {
  std::vector<std::string> list;
  for (const Tick& tick : axis.ticks()) {
    if (!tick.label.empty()) list.push_back(tick.label);
  }
  return list;
}

TEST(LogAxis, BeginsAndEndsAtRoundNumbersBeyondTheValues) {
  const LogAxis axis(21.5, 168);
  EXPECT_DOUBLE_EQ(axis.first(), 10);
  EXPECT_DOUBLE_EQ(axis.last(), 200);
  EXPECT_EQ(axis.place(axis.first()), 0);
  EXPECT_EQ(axis.place(axis.last()), 1);
  EXPECT_DOUBLE_EQ(axis.place(std::sqrt(2000.0)), 0.5);
  EXPECT_THAT(labels(axis), ElementsAre("10", "20", "50", "100", "200"));
  EXPECT_EQ(axis.ticks().size(), 11);  // 10 20 ... 90 100 200
}

TEST(LogAxis, LeavesAirBesideTheValues) {
  EXPECT_THAT(labels(LogAxis(10, 20)), ElementsAre("5", "10", "20", "50"));
}

TEST(LogAxis, ManyDecadesHaveNumbersAtPowersOfTen) {
  EXPECT_THAT(labels(LogAxis(3e-8, 2e-3)), ElementsAre("10⁻⁷", "10⁻⁶", "10⁻⁵", "10⁻⁴", "0.001"));
}

TEST(LogAxis, OneValueIsEnough) {
  const LogAxis axis(1, 1);
  EXPECT_LT(axis.first(), 1);
  EXPECT_GT(axis.last(), 1);
  EXPECT_GE(labels(axis).size(), 2);
}

TEST(LogAxis, RefusesWhatHasNoLogarithm) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(LogAxis(0, 1), Error);
  EXPECT_THROW(LogAxis(-1, 1), Error);
  EXPECT_THROW(LogAxis(2, 1), Error);
  EXPECT_THROW(LogAxis(1, inf), Error);
  EXPECT_THROW(LogAxis(nan, 1), Error);
  EXPECT_THROW(LogAxis(1, nan), Error);
}

// ---- labels

TEST(Labels, NeitherMeetNorCoverMarkers) {
  // A crowd: 24 points in a small part of the frame.
  std::vector<LabelWish> wishes;
  for (int i = 0; i < 24; ++i) {
    wishes.push_back({200.0 + 23 * (i % 6), 150.0 + 19 * (i / 6) + 3 * (i % 2), 90, 14});
  }
  const Box frame{0, 0, 640, 360};
  const auto places = place_labels(wishes, frame);
  ASSERT_EQ(places.size(), wishes.size());
  std::size_t placed = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    ++placed;
    EXPECT_TRUE(frame.contains(places[i]->box));
    for (std::size_t j = 0; j < i; ++j) {
      if (places[j]) {
        EXPECT_FALSE(places[i]->box.meets(places[j]->box)) << i << " and " << j;
      }
    }
    for (const LabelWish& w : wishes) {
      EXPECT_FALSE(places[i]->box.meets({w.x - 4, w.y - 4, w.x + 4, w.y + 4})) << i;
    }
  }
  EXPECT_GT(placed, 8);
}

TEST(Labels, ALonelyOneStandsRightBesideItsMarker) {
  const LabelWish wishes[] = {{100, 100, 50, 14}, {100, 200, 0, 14}, {630, 100, 50, 14}};
  const auto places = place_labels(wishes, {0, 0, 640, 360});
  ASSERT_TRUE(places[0]);
  EXPECT_DOUBLE_EQ(places[0]->box.x0, 109);
  EXPECT_DOUBLE_EQ(places[0]->box.y0, 93);
  EXPECT_FALSE(places[0]->led);
  EXPECT_FALSE(places[1]);  // wants none
  ASSERT_TRUE(places[2]);   // no room to the right
  EXPECT_DOUBLE_EQ(places[2]->box.x1, 621);
}

TEST(Labels, NoRoomNoLabel) {
  const LabelWish wish{5, 5, 50, 14};
  EXPECT_FALSE(place_labels({&wish, 1}, {0, 0, 40, 10})[0]);
}

// ---- the plot

Scatter two_points() {
  Scatter scatter;
  scatter.title = "time & error";
  scatter.time_axis = "ns/pixel";
  scatter.error_axis = "mean error";
  scatter.series = {"models"};
  scatter.points = {{20, 0.1, 0, "cheap <model>", "20 ns"}, {100, 0, 0, "exact", "100 ns"}};
  return scatter;
}

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Scatter, HasAxesLabelsAndTheFront) {
  const std::string svg = to_svg(two_points());
  EXPECT_THAT(svg, HasSubstr("aria-label=\"time &amp; error\""));
  EXPECT_THAT(svg, HasSubstr(">cheap &lt;model&gt;</text>"));
  EXPECT_THAT(svg, HasSubstr(">ns/pixel</text>"));
  EXPECT_THAT(svg, HasSubstr(">mean error</text>"));
  EXPECT_THAT(svg, HasSubstr(">0</text>"));  // the band of exact choices
  EXPECT_EQ(count(svg, "class=\"m s0 on\""), 2);
  EXPECT_EQ(count(svg, "class=\"front\""), 1);
  EXPECT_EQ(count(svg, "class=\"link"), 0);
}

TEST(Scatter, BeatenPointsAreHollow) {
  Scatter scatter = two_points();
  scatter.points.push_back({150, 0.2, 0, "worse", ""});
  const std::string svg = to_svg(scatter);
  EXPECT_EQ(count(svg, "class=\"m s0 on\""), 2);
  EXPECT_EQ(count(svg, "class=\"m s0\""), 1);
}

TEST(Scatter, SeveralSeriesHaveALegendAndMayBeConnected) {
  Scatter scatter = two_points();
  scatter.series = {"a", "b"};
  scatter.points[1].series = 1;
  scatter.connected = true;
  scatter.front = false;
  const std::string svg = to_svg(scatter);
  EXPECT_EQ(count(svg, "class=\"m s1 on\""), 2);  // in the legend and in the plot
  EXPECT_EQ(count(svg, "class=\"link"), 2);
  EXPECT_THAT(svg, Not(HasSubstr("class=\"front\"")));
}

TEST(Scatter, TheEighthSeriesLooksAsTheFirst) {
  Scatter scatter = two_points();
  scatter.series = {"a", "b", "c", "d", "e", "f", "g", "h"};
  scatter.points[1].series = 7;
  EXPECT_EQ(count(to_svg(scatter), "<circle class=\"m s0 on\""), 4);
}

TEST(Scatter, OfExactChoicesAlone) {
  Scatter scatter = two_points();
  for (ScatterPoint& p : scatter.points) p.error = 0;
  EXPECT_THAT(to_svg(scatter), HasSubstr(">0</text>"));
}

TEST(Scatter, RefusesWhatCannotBeDrawn) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const auto& [time, error] : std::vector<std::pair<double, double>>{
           {0, 1}, {-1, 1}, {inf, 1}, {1, -1}, {1, inf}, {1, std::nan("")}, {std::nan(""), 1}}) {
    Scatter scatter = two_points();
    scatter.points[0].time = time;
    scatter.points[0].error = error;
    EXPECT_THROW(to_svg(scatter), Error) << time << ", " << error;
  }
  Scatter none = two_points();
  none.points.clear();
  EXPECT_THROW(to_svg(none), Error);
  Scatter stray = two_points();
  stray.points[0].series = 1;
  EXPECT_THROW(to_svg(stray), Error);
}

}  // namespace
}  // namespace limpid
