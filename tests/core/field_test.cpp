#include "limpid/core/field.h"

#include <cmath>
#include <filesystem>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limpid/core/scene.h"

namespace limpid {
namespace {

using testing::HasSubstr;

enum class Shape { kRound, kFlat };
struct Params {
  Shape shape = Shape::kFlat;
  double size = 2;
  Rgb<double> tint{0.5, 0.5, 0.5};
  std::string file;
  int steps = 3;
  std::vector<SineWave> waves;
  glm::dvec3 way{0, 0, 1};
  glm::dmat4 turn{1.0};
  std::filesystem::path map = "plain.png";
  double reach = 1;
};
constexpr std::string_view kShapes[] = {"round", "flat"};
constexpr std::string_view kStepWords[] = {"march", "none"};
constexpr Field<Params> kFields[] = {
    choice<&Params::shape, kShapes>("shape", "Its shape."),
    real<&Params::size>("size", "m", {0, 10}, "Its size."),
    color<&Params::tint>("tint", "", {0, 1}, "Its color."),
    text<&Params::file>("file", "Where it lies."),
    count_or_word<&Params::steps, kStepWords>("steps", "", {0, 64}, "How many."),
    table<&Params::waves>("waves", "", {-100, 100}, "What it swims on."),
    direction<&Params::way>("way", "Where it looks."),
    matrix<&Params::turn>("turn", "How it stands."),
    file<&Params::map>("map", "What it wears."),
    real<&Params::reach>("reach", "m", kFinite, "How far it sees."),
};
constexpr std::span<const Field<Params>> kAll = kFields;

/// The message of assign(), "" when assign() takes the value.
std::string refusal(int field, const Value& value) {
  Params params;
  try {
    assign("thing", kFields[field], params, value);
  } catch (const Error& e) {
    EXPECT_EQ(kFields[field].get(params), kFields[field].get(Params{})) << "changed all the same";
    return e.what();
  }
  EXPECT_EQ(kFields[field].get(params), value);
  return "";
}

TEST(Field, TakesDirectionsMatricesFilesAndAnyFiniteNumber) {
  const double inf = std::numeric_limits<double>::infinity();
  const Rows turned{{0, -1, 0, 5}, {1, 0, 0, 6}, {0, 0, 1, 7}, {0, 0, 0, 1}};
  EXPECT_EQ(refusal(6, Rgb<double>{0, 0.6, -0.8}), "");
  EXPECT_EQ(refusal(7, turned), "");
  EXPECT_EQ(refusal(8, "a.png"), "");
  EXPECT_EQ(refusal(9, kFinite.min), "");

  Params params;
  assign("thing", kFields[6], params, Rgb<double>{3e300, 0, -4e300});
  EXPECT_NEAR(params.way.x, 0.6, 1e-15);
  EXPECT_NEAR(params.way.z, -0.8, 1e-15);
  assign("thing", kFields[7], params, turned);
  EXPECT_EQ(params.turn[3], glm::dvec4(5, 6, 7, 1));  // the last column

  EXPECT_EQ(refusal(6, Rgb<double>{0, 0, 0}),
            "thing.way = [0, 0, 0]: expected a vector that is not zero");
  EXPECT_THAT(refusal(6, Rgb<double>{0, inf, 0}), HasSubstr("[0, inf, 0]: expected"));
  EXPECT_THAT(refusal(6, 1.0), HasSubstr("thing.way = 1: expected"));
  EXPECT_EQ(refusal(7, Rows{{1, 2}}), "thing.turn = [[1, 2]]: expected 4 rows of 4 finite numbers");
  EXPECT_THAT(refusal(7, Rows(3, {1, 2, 3, 4})), HasSubstr("expected 4 rows"));
  EXPECT_THAT(refusal(7, Rows(4, {1, 2, 3, inf})), HasSubstr("expected 4 rows"));
  EXPECT_EQ(refusal(8, ""), "thing.map = : expected FILE");
  EXPECT_EQ(refusal(9, inf), "thing.reach = inf: expected a finite number (m)");
}

TEST(Field, TakesWhatIsDeclared) {
  EXPECT_EQ(refusal(0, "round"), "");
  EXPECT_EQ(refusal(1, 0.0), "");
  EXPECT_EQ(refusal(1, 10.0), "");
  EXPECT_EQ(refusal(2, Rgb<double>{0, 1, 0.25}), "");
  EXPECT_EQ(refusal(3, "waves.exr"), "");
  EXPECT_EQ(refusal(4, 0.0), "");
  EXPECT_EQ(refusal(4, 64.0), "");
  EXPECT_EQ(refusal(4, "march"), "");
  EXPECT_EQ(refusal(5, Rows{}), "");
  EXPECT_EQ(refusal(5, Rows{{0.1, 1, 2, 3, 4}, {-100, 100, 0, 0, -5}}), "");
}

/// A value that a host sets by a cast of a number.
TEST(Field, ValuesWithoutAWordReadAsNumbersThatAreRefused) {
  Params params;
  for (const int value : {2, 77, -1}) {
    params.shape = static_cast<Shape>(value);
    const Value read = kFields[0].get(params);
    EXPECT_EQ(read, Value(std::to_string(value)));
    EXPECT_THAT(refusal(0, read), HasSubstr("expected one of round, flat"));
  }
  params.steps = -3;  // the two words stand for -1 and -2
  EXPECT_EQ(kFields[4].get(params), Value(-3.0));
  EXPECT_THAT(refusal(4, -3.0), HasSubstr("expected a whole number"));
}

TEST(Field, RefusesWithOneSentence) {
  EXPECT_EQ(refusal(1, 10.5), "thing.size = 10.5: expected 0 ... 10 (m)");
  EXPECT_EQ(refusal(1, -1.0), "thing.size = -1: expected 0 ... 10 (m)");
  EXPECT_EQ(refusal(1, "big"), "thing.size = big: expected 0 ... 10 (m)");
  EXPECT_EQ(refusal(1, std::nan("")), "thing.size = nan: expected 0 ... 10 (m)");
  EXPECT_EQ(refusal(2, Rgb<double>{0, 2, 0}),
            "thing.tint = [0, 2, 0]: expected three numbers, each 0 ... 1");
  EXPECT_EQ(refusal(2, 0.5), "thing.tint = 0.5: expected three numbers, each 0 ... 1");
  EXPECT_EQ(refusal(0, "rond"),
            "thing.shape = rond: expected one of round, flat; did you mean 'round'?");
  EXPECT_EQ(refusal(0, 1.0), "thing.shape = 1: expected one of round, flat");
  EXPECT_EQ(refusal(3, 1.0), "thing.file = 1: expected a string");
  EXPECT_EQ(refusal(4, 2.5),
            "thing.steps = 2.5: expected a whole number 0 ... 64, or march or none");
  EXPECT_EQ(refusal(4, -1.0),
            "thing.steps = -1: expected a whole number 0 ... 64, or march or none");
  EXPECT_THAT(refusal(4, 65.0), HasSubstr("= 65: expected a whole number"));
  EXPECT_THAT(refusal(4, std::nan("")), HasSubstr("= nan: expected a whole number"));
  EXPECT_THAT(refusal(4, std::numeric_limits<double>::infinity()), HasSubstr("= inf: expected"));
  EXPECT_THAT(refusal(4, "marhc"), HasSubstr("or march or none; did you mean 'march'?"));
  EXPECT_EQ(refusal(5, Rows{{1, 2, 3}}),
            "thing.waves = [[1, 2, 3]]: expected a list of [amplitude, k_x, k_y, phase] or "
            "[amplitude, k_x, k_y, phase, omega], each number -100 ... 100");
  EXPECT_THAT(refusal(5, Rows{{1, 2, 3, 4, 5, 6}}), HasSubstr("expected a list of"));
  EXPECT_THAT(refusal(5, Rows{{1, 2, 3, 4}, {}}), HasSubstr("[1, 2, 3, 4], []]: expected"));
  EXPECT_THAT(refusal(5, Rows{{1, 2, 3, std::nan("")}}), HasSubstr("nan]]: expected"));
  EXPECT_THAT(refusal(5, Rows{{1, 2, 300, 4}}), HasSubstr("each number -100 ... 100"));
  EXPECT_THAT(refusal(5, 1.0), HasSubstr("thing.waves = 1: expected a list of"));
}

TEST(Field, CountsAndWordsShareAnInt) {
  Params params;
  const Field<Params>& steps = kFields[4];
  assign("thing", steps, params, 7.0);
  EXPECT_EQ(params.steps, 7);
  assign("thing", steps, params, "march");
  EXPECT_EQ(params.steps, -1);
  assign("thing", steps, params, "none");
  EXPECT_EQ(params.steps, -2);
  EXPECT_NO_THROW(validate("thing", kAll, params));
  params.steps = -3;  // no word stands for -3, which lies below the range
  EXPECT_THROW(validate("thing", kAll, params), Error);
}

TEST(Field, AConditionMayHoldForANumberAboveZeroAsWell) {
  const Field<Params> field = real<&Params::size>("size", "m", {0, 10}, "Its size.")
                                  .when("steps", {"3"})
                                  .when("shape", {"round"})
                                  .or_above_zero("height");
  EXPECT_EQ(to_string(field.used_when[0]), "steps = 3");
  EXPECT_EQ(to_string(field.used_when[1]), "shape = round or height above 0");
  EXPECT_FALSE(field.used_when[0].holds("4", 1));
  EXPECT_TRUE(field.used_when[0].holds("3"));
  EXPECT_TRUE(field.used_when[1].holds("round", 0));
  EXPECT_TRUE(field.used_when[1].holds("flat", 0.1));
  EXPECT_FALSE(field.used_when[1].holds("flat", 0));
}

// omega of deep water: sqrt(9.81 * |(3, 4)|) = sqrt(49.05).
TEST(Field, RowsOfATableMayLeaveOutTheLastColumn) {
  Params params;
  assign("thing", kFields[5], params, Rows{{0.5, 3, -4, 1}, {0.25, 1, 0, 2, -6}});
  ASSERT_EQ(params.waves.size(), 2u);
  EXPECT_EQ(params.waves[0].amplitude, 0.5);
  EXPECT_EQ(params.waves[0].k_x, 3);
  EXPECT_EQ(params.waves[0].k_y, -4);
  EXPECT_EQ(params.waves[0].phase, 1);
  EXPECT_NEAR(params.waves[0].omega, 7.003571, 1e-6);
  EXPECT_EQ(params.waves[1].omega, -6);
  assign("thing", kFields[5], params, Rows{});
  EXPECT_TRUE(params.waves.empty());
}

TEST(Field, ValidateFindsTheFirstBadParameter) {
  Params params;
  EXPECT_NO_THROW(validate("thing", kAll, params));
  params.tint.g = -0.1;
  params.size = std::numeric_limits<double>::infinity();
  try {
    validate("thing", kAll, params);
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "thing.size = inf: expected 0 ... 10 (m)");
  }
}

TEST(Value, PrintsItself) {
  EXPECT_EQ(to_string(Value(0.03)), "0.03");
  EXPECT_EQ(to_string(Value("snap")), "snap");
  EXPECT_EQ(to_string(Value(Rgb<double>{1, 0.5, 0})), "[1, 0.5, 0]");
  EXPECT_EQ(to_string(Value(Rows{})), "[]");
  EXPECT_EQ(to_string(Value(Rows{{1, 0.5}, {-2}})), "[[1, 0.5], [-2]]");
}

}  // namespace
}  // namespace limpid
