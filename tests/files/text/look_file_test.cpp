#include "limpid/files/text/look_file.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/exr/written.h"
#include "paths.h"

namespace limpid {
namespace {

using test::error_of;
using test::own_folder;
using test::written;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

namespace fs = std::filesystem;

std::vector<Value> values_of(const Look& look) {
  std::vector<Value> values;
  for (const Parameter& p : parameters(look)) values.push_back(p.value);
  return values;
}

/// Ends of the range, tiny numbers and numbers of all sizes between.
double random_real(std::mt19937& random, Range range) {
  const double share = std::uniform_real_distribution<double>(0, 1)(random);
  switch (random() % 5) {
    case 0:
      return range.min;
    case 1:
      return range.max;
    case 2:
      return std::clamp(1e-300 * share, range.min, range.max);
    case 3:
      return std::clamp(std::pow(10, 10 * share - 5), range.min, range.max);
    default:
      return std::clamp(range.min + share * (range.max - range.min), range.min, range.max);
  }
}

Value random_value(std::mt19937& random, const Parameter& p) {
  switch (p.kind) {
    case FieldKind::kReal:
      return random_real(random, p.range);
    case FieldKind::kColor:
      return Rgb<double>{random_real(random, p.range), random_real(random, p.range),
                         random_real(random, p.range)};
    case FieldKind::kChoice:
      return std::string(p.choices[random() % p.choices.size()]);
    case FieldKind::kText: {
      std::string path = "/";
      for (char c : {'a', '"', '\\', '\n', '\t', '\x7f', '\'', '#', ' '}) {
        if (random() % 2) path += c;
      }
      return path + "\u00e9z";
    }
    case FieldKind::kCountOrWord:
      if (random() % 2) return std::string(p.choices[random() % p.choices.size()]);
      return std::floor(random_real(random, p.range));
    case FieldKind::kTable: {
      Rows rows(random() % 4);
      for (std::vector<double>& row : rows) {
        row.resize(p.least_columns + random() % (p.columns.size() - p.least_columns + 1));
        for (double& x : row) x = random_real(random, p.range);
      }
      return rows;
    }
    case FieldKind::kDirection:  // of scenes, not of looks
    case FieldKind::kMatrix:
    case FieldKind::kFile:
      break;
  }
  return {};
}

TEST(LookFile, WhatToTomlWritesLoadsAsTheSameLook) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    Look look;
    for (const Parameter& p : parameters(look)) look.set(p.table, p.name, random_value(random, p));
    const std::string text = to_toml(look);
    const Look back = load_look(written("random.toml", text));
    EXPECT_EQ(values_of(back), values_of(look)) << text;
    EXPECT_EQ(back.name, "random");
  }
}

TEST(LookFile, EmptyFileIsTheDefaultLook) {
  EXPECT_EQ(values_of(load_look(written("empty.toml", "# nothing\n"))), values_of(Look{}));
}

TEST(LookFile, IntegersAreNumbers) {
  const Look look = load_look(
      written("integers.toml", "[sun_highlight]\npower = 64\n[depth_fog]\ncolor = [1, 0, 0.5]\n"));
  EXPECT_EQ(look.of<SunHighlight>().power, 64);
  EXPECT_EQ(look.of<DepthFog>().color, (Rgb<double>{1, 0, 0.5}));
}

TEST(LookFile, WavesAreRowsWithOrWithoutOmega) {
  const Look look = load_look(
      written("waves.toml", "[wave_normals]\nwaves = [[0.05, 3, 4, 0], [0.1, 1, 0, -2, 5.5]]\n"));
  const std::vector<SineWave>& waves = look.of<WaveNormals>().waves;
  ASSERT_EQ(waves.size(), 2u);
  EXPECT_EQ(waves[0].k_y, 4);
  EXPECT_NEAR(waves[0].omega, 7.003571, 1e-6);  // sqrt(9.81 * 5)
  EXPECT_EQ(waves[1].to_row(), (std::vector<double>{0.1, 1, 0, -2, 5.5}));
}

TEST(LookFile, MapIsRelativeToTheFile) {
  const auto map_of = [](const std::string& map) {
    const fs::path path = written("map.toml", "[wave_normals]\nmap = \"" + map + "\"\n");
    return load_look(path).of<WaveNormals>().map;
  };
  EXPECT_EQ(map_of("waves.png"), (own_folder() / "waves.png").lexically_normal());
  EXPECT_EQ(map_of("../maps/waves.png"),
            (own_folder().parent_path() / "maps/waves.png").lexically_normal());
  EXPECT_EQ(map_of("/maps/waves.png"), "/maps/waves.png");
  EXPECT_EQ(map_of(""), "");
}

TEST(LookFile, LooksBesideTheWorkingFolderLoad) {
  written("here.toml", "[wave_normals]\nmap = \"waves.png\"\n");
  const fs::path before = fs::current_path();
  fs::current_path(own_folder());
  const std::string map = load_look("here.toml").of<WaveNormals>().map;
  fs::current_path(before);
  EXPECT_EQ(map, fs::canonical(own_folder()) / "waves.png");
}

TEST(LookFile, ErrorsGivePlaceAndWhatWasExpected) {
  struct Case {
    const char* text;
    const char* place;
    const char* says;
  };
  const Case cases[] = {
      {"[refracton]\nstrength = 1\n", ":1:", "did you mean 'refraction'?"},
      {"[refracton]\n", ":1:", "unknown table 'refracton'"},
      {"strength = 1\n", ":1:1: ", "unknown table 'strength'"},
      {"[refraction]\n  strenght = 1\n", ":2:3: ", "did you mean 'strength'?"},
      {"[refraction]\ncaustics = 1\n", ":2:1: ", "unknown key 'refraction.caustics'"},
      {"[refraction]\nstrength = 11\n", ":2:12: ", "refraction.strength = 11: expected -10 ... 10"},
      {"[refraction]\nstrength = nan\n", ":2:12: ", "refraction.strength = nan: expected -10"},
      {"[refraction]\nstrength = -inf\n", ":2:12: ", "refraction.strength = -inf: expected -10"},
      {"[refraction]\nstrength = \"1\"\n", ":2:12: ", "= \"1\": expected a number"},
      {"[refraction]\nstrength = true\n", ":2:12: ", "= true: expected a number"},
      {"[refraction]\nstrength = 1979-05-27\n", ":2:12: ", "= a date or time: expected a number"},
      {"[refraction]\nstrength = [1]\n", ":2:12: ", "= [1]: expected a number"},
      {"[refraction]\nstrength = {a = 1}\n", ":2:12: ", "= a table: expected a number"},
      {"[refraction]\nrejection = 1\n", ":2:13: ", "= 1: expected one of none, snap"},
      {"[refraction]\nrejection = \"snpa\"\n", ":2:13: ", "refraction.rejection = snpa: expected"},
      {"[depth_fog]\ncolor = 1\n", ":2:9: ", "expected three numbers [r, g, b]"},
      {"[depth_fog]\ncolor = [1, 2]\n", ":2:9: ", "= [1, 2]: expected three numbers"},
      {"[depth_fog]\ncolor = [1, 2, nan]\n", ":2:9: ", "= [1, 2, nan]: expected three numbers"},
      {"[depth_fog]\ncolor = [1, 2, -3]\n", ":2:9: ", "= [1, 2, -3]: expected three numbers, each"},
      {"[depth_fog]\ncolor = [1, 2, \"x\"]\n", ":2:9: ", "expected three numbers [r, g, b]"},
      {"[wave_normals]\nmap = 3\n", ":2:7: ", "wave_normals.map = 3: expected a string"},
      {"[wave_normals]\nwaves = 3\n", ":2:9: ", "= 3: expected a list of [amplitude, k_x, k_y,"},
      {"[wave_normals]\nwaves = [1, 2, 3, 4]\n", ":2:9: ", "expected a list of [amplitude,"},
      {"[wave_normals]\nwaves = [[1, 2, 3, \"4\"]]\n", ":2:9: ", "expected a list of [amplitude"},
      {"[wave_normals]\nwaves = [[1, 2, 3]]\n", ":2:9: ", "wave_normals.waves = [[1, 2, 3]]: exp"},
      {"[wave_normals]\nwaves = [[1, 2, 3, nan]]\n", ":2:9: ", "each number -1000000 ... 1000000"},
      {"refraction = 3\n", ":1:14: ", "refraction = 3: expected a table"},
      {"[[refraction]]\nstrength = 1\n", ":1:", "refraction = a list of 1: expected a table"},
      {"[refraction]\nstrength = 1\nstrength = 2\n", ":3:", "strength"},
      {"[refraction\n", ":1:", "Error"},
  };
  for (const Case& c : cases) {
    const fs::path path = written("bad.toml", c.text);
    const std::string sentence = error_of([&] { load_look(path); });
    EXPECT_THAT(sentence, StartsWith(path.string() + c.place)) << c.text;
    EXPECT_THAT(sentence, HasSubstr(c.says)) << c.text;
  }
}

TEST(LookFile, TheFirstMistakeOfTheFileIsNamed) {
  const fs::path path = written("two.toml", "[water]\nior = 1.3\nzeta = 1\nalpha = 1\n");
  EXPECT_THAT(error_of([&] { load_look(path); }), HasSubstr(":3:1: unknown key 'water.zeta'"));
}

TEST(LookFile, RefusesWhatIsNoTomlFile) {
  EXPECT_THAT(error_of([] { load_look(own_folder() / "absent.toml"); }),
              HasSubstr("absent.toml: cannot be opened (No such file or directory)"));
  EXPECT_THAT(error_of([] { load_look(own_folder()); }), HasSubstr("is a folder"));
  const fs::path large = written("large.toml", std::string((1 << 20) + 1, '#'));
  EXPECT_THAT(error_of([&] { load_look(large); }), HasSubstr("larger than 256 KiB"));
  const fs::path binary = written("plate.toml", std::string("v/1\x01\x02\0\0\0channels\0\xff", 18));
  EXPECT_THAT(error_of([&] { load_look(binary); }), StartsWith(binary.string() + ":1:"));
}

TEST(LookNamed, SearchesTheFoldersInOrder) {
  fs::create_directories(own_folder() / "a");
  fs::create_directories(own_folder() / "b");
  written("a/calm.toml", "[refraction]\nstrength = 0.25\n");
  written("b/calm.toml", "[refraction]\nstrength = 0.5\n");
  written("b/stormy.toml", "[refraction]\nstrength = 0.75\n");
  const fs::path folders[] = {own_folder() / "absent", own_folder() / "a", own_folder() / "b"};
  EXPECT_EQ(look_named("calm", folders).of<Refraction>().strength, 0.25);
  EXPECT_EQ(look_named("stormy", folders).of<Refraction>().strength, 0.75);
  EXPECT_EQ(look_named("stormy", folders).name, "stormy");
  const std::string file = (own_folder() / "b/calm.toml").string();
  EXPECT_EQ(look_named(file, folders).of<Refraction>().strength, 0.5);
  EXPECT_EQ(error_of([&] { look_named("stromy", folders); }),
            "no look is named 'stromy': expected one of calm, stormy; did you mean 'stormy'?");
  EXPECT_EQ(error_of([&] { look_named("calm", std::span(folders, 1)); }),
            "no look is named 'calm': expected the path of a look file, or looks in one of " +
                folders[0].string());
  EXPECT_THAT(error_of([&] { look_named("", folders); }), HasSubstr("no look is named ''"));
}

TEST(LoadLook, TakesTheRestFromItsBase) {
  fs::create_directories(own_folder() / "far");
  const fs::path base = written("far/base.toml",
                                "about = \"Its own.\"\n[wave_normals]\nmap = \"m.png\"\nstrength = "
                                "0.25\nspeed = 7\n[depth_fog]\nwater_type = \"IB\"\n");
  const fs::path look =
      written("upon.toml",
              "about = \"A sentence.\"\nbase = \"far/base.toml\"\n[wave_normals]\n"
              "strength = 0.75\n[depth_fog]\nmurkiness = 0.5\n");
  const Look upon = load_look(look);
  EXPECT_EQ(upon.name, "upon");
  EXPECT_EQ(upon.about, "A sentence.");
  EXPECT_EQ(upon.file, look.string());
  EXPECT_EQ(upon.bases, std::vector<std::string>{base.string()});
  EXPECT_EQ(upon.of<WaveNormals>().map, own_folder() / "far/m.png");
  EXPECT_EQ(upon.of<WaveNormals>().strength, 0.75);
  EXPECT_EQ(upon.of<WaveNormals>().speed, 7);
  EXPECT_EQ(upon.of<DepthFog>().water_type, WaterType::kCase1) << "a murkiness is that of case_1";
  EXPECT_EQ(load_look(base).about, "Its own.");
  EXPECT_TRUE(load_look(base).bases.empty());

  const Look third = load_look(written("third.toml", "base = \"upon.toml\"\n"));
  EXPECT_EQ(values_of(third), values_of(upon));
  EXPECT_EQ(third.about, "") << "a sentence is of one look alone";
  EXPECT_EQ(third.bases, (std::vector<std::string>{look.string(), base.string()}));
}

TEST(LoadLook, FindsABaseByNameInTheFolders) {
  fs::create_directories(own_folder() / "looks");
  written("looks/calm.toml", "[wave_normals]\nstrength = 0\n");
  const fs::path mine = written("mine.toml", "base = \"calm\"\n");
  const fs::path folders[] = {own_folder() / "looks"};
  EXPECT_EQ(load_look(mine, folders).of<WaveNormals>().strength, 0);
  EXPECT_EQ(look_named(mine.string(), folders).of<WaveNormals>().strength, 0);
  EXPECT_THAT(error_of([&] { load_look(mine); }),
              AllOf(StartsWith(mine.string() + ":1:8: "), HasSubstr("no look is named 'calm'")));
}

TEST(LoadLook, RefusesABaseThatCannotBe) {
  const fs::path look = written("look.toml", "base = \"other.toml\"\n");
  written("other.toml", "base = \"./look.toml\"\n");
  EXPECT_EQ(error_of([&] { load_look(look); }),
            (own_folder() / "other.toml").string() +
                ":1:8: base = \"./look.toml\": expected a look that is not based on this one");
  written("other.toml", "base = \"other.toml\"\n");
  EXPECT_THAT(error_of([&] { load_look(look); }), HasSubstr("not based on this one"));
  written("other.toml", "[water]\nior = 0\n");
  EXPECT_THAT(error_of([&] { load_look(look); }),
              StartsWith((own_folder() / "other.toml:2:").string()));
  const fs::path absent = written("absent.toml", "base = \"nowhere.toml\"\n");
  EXPECT_THAT(error_of([&] { load_look(absent); }), HasSubstr("nowhere.toml"));
  const fs::path number = written("number.toml", "base = 3\n");
  EXPECT_THAT(error_of([&] { load_look(number); }), StartsWith(number.string() + ":1:8: base = 3"));
  EXPECT_THAT(error_of([&] { look_from_toml("base = \"look.toml\"\n", "text"); }),
              StartsWith("text:1:8: base = \"look.toml\": expected none"));
  EXPECT_THAT(error_of([&] { look_from_toml("about = \"a\\nb\"\n", "text"); }),
              HasSubstr("expected a sentence on one line"));
  EXPECT_THAT(error_of([&] { look_from_toml("bases = \"a\"\n", "text"); }),
              HasSubstr("did you mean 'base'?"));
}

TEST(LookNamed, RealisticIsTheLookOfTheArticle) {
  const fs::path folders[] = {fs::path(LIMPID_DATA) / "looks"};
  const Look look = look_named("realistic", folders);
  EXPECT_EQ(look.of<WaveNormals>().model, WaveNormals::Model::kFourMaps);
  EXPECT_EQ(look.of<WaveNormals>().map, fs::path(LIMPID_DATA) / "maps/water_normals.png");
  EXPECT_EQ(look.of<Refraction>().model, Refraction::Model::kNormalOffset);
  EXPECT_EQ(look.of<Refraction>().strength, 0.03);
  EXPECT_EQ(look.of<Refraction>().rejection, Refraction::Rejection::kSnap);
  EXPECT_EQ(look.of<PrismSplit>().strength, 0.004);
  EXPECT_EQ(look.of<DepthFog>().distance, DepthFog::Distance::kEye);
  EXPECT_EQ(look.of<DepthFog>().density, 0.15);
  EXPECT_EQ(look.of<DepthFog>().offset, 0);
  EXPECT_EQ(look.of<DepthFog>().color, (Rgb<double>{0.02, 0.10, 0.12}));
  EXPECT_EQ(look.of<DepthFog>().alpha, 0.9);
  EXPECT_EQ(look.of<WaterShadow>().strength, 0.5);
  EXPECT_EQ(look.of<FresnelReflection>().reflectance, FresnelReflection::Reflectance::kRim);
  EXPECT_EQ(look.of<FresnelReflection>().power, 3);
  EXPECT_EQ(look.of<FresnelReflection>().strength, 0.02);
  EXPECT_EQ(look.of<SunHighlight>().model, SunHighlight::Model::kBlinnPhong);
  EXPECT_EQ(look.of<SunHighlight>().power, 200);
  EXPECT_EQ(look.of<SunHighlight>().strength, 1);
}

TEST(ApplySetting, TakesNumbersColorsWordsAndTexts) {
  Look look;
  apply_setting(look, "refraction.strength=-0.25");
  EXPECT_EQ(look.of<Refraction>().strength, -0.25);
  apply_setting(look, " refraction.strength = +2.5e-2 ");
  EXPECT_EQ(look.of<Refraction>().strength, 0.025);
  apply_setting(look, "depth_fog.color=[0.5,0.25, 1]");
  EXPECT_EQ(look.of<DepthFog>().color, (Rgb<double>{0.5, 0.25, 1}));
  apply_setting(look, "depth_fog.color=1,2,3");
  EXPECT_EQ(look.of<DepthFog>().color, (Rgb<double>{1, 2, 3}));
  apply_setting(look, "refraction.rejection=none");
  EXPECT_EQ(look.of<Refraction>().rejection, Refraction::Rejection::kNone);
  apply_setting(look, "refraction.rejection=\"snap\"");
  EXPECT_EQ(look.of<Refraction>().rejection, Refraction::Rejection::kSnap);
  apply_setting(look, "wave_normals.waves=[[0.05,1,0,0,2], [0.1, 0, 2, 1, 3]]");
  ASSERT_EQ(look.of<WaveNormals>().waves.size(), 2u);
  EXPECT_EQ(look.of<WaveNormals>().waves[1].to_row(), (std::vector<double>{0.1, 0, 2, 1, 3}));
  apply_setting(look, "wave_normals.waves=[]");
  EXPECT_TRUE(look.of<WaveNormals>().waves.empty());
  apply_setting(look, "wave_normals.map=/maps/a=b.png");
  EXPECT_EQ(look.of<WaveNormals>().map, "/maps/a=b.png");
  apply_setting(look, "wave_normals.map=waves.png");
  EXPECT_EQ(look.of<WaveNormals>().map, fs::current_path() / "waves.png");
  apply_setting(look, "wave_normals.map=");
  EXPECT_EQ(look.of<WaveNormals>().map, "");
}

// A look with a map, then without waves of a map: the map is not the settings' fault, unless a
// setting names it.
TEST(ApplySettings, ForgetsWhatTheyLeaveUnread) {
  Look base;
  base.of<WaveNormals>().map = "/maps/waves.png";
  base.of<WaveNormals>().tile_size = 7;
  base.of<PrismSplit>().gain = 2;
  Look look = base;
  apply_settings(look, std::vector<std::string>{"wave_normals.model=sines", "prism_split.gain=3"});
  EXPECT_EQ(look.of<WaveNormals>().map, "");
  EXPECT_EQ(look.of<WaveNormals>().tile_size, 4);
  EXPECT_EQ(look.of<PrismSplit>().gain, 3);
  EXPECT_EQ(unread_settings(look), std::vector<std::string>{});
  look = base;
  apply_settings(look,
                 std::vector<std::string>{"wave_normals.model=sines", "wave_normals.map=/a.png"});
  EXPECT_EQ(unread_settings(look).size(), 1u);
  base.of<WaveNormals>().model = WaveNormals::Model::kSines;  // the look itself is at fault
  look = base;
  apply_settings(look, std::vector<std::string>{"prism_split.gain=3"});
  EXPECT_EQ(unread_settings(look).size(), 2u);
}

/// As TOML has them, or without the digit that it asks for.
TEST(ApplySetting, NumbersNeedNoDigitBesideThePointAndMayBeginWithZeros) {
  const std::pair<const char*, double> cases[] = {
      {".5", 0.5},      {"-.5", -0.5}, {"+.5", 0.5},    {"2.", 2},
      {"-2.e-1", -0.2}, {"007", 7},    {"-01.5", -1.5}, {"0.25", 0.25},
      {"1e-05", 1e-5},  {"00.", 0},    {"1_0", 10},     {"100e-3", 0.1}};
  for (const auto& [text, number] : cases) {
    Look look;
    apply_setting(look, "refraction.strength=" + std::string(text));
    EXPECT_EQ(look.of<Refraction>().strength, number) << text;
    apply_setting(look, "wave_normals.waves=[[1, " + std::string(text) + ", 2, 3, 4]]");
    EXPECT_EQ(look.of<WaveNormals>().waves.at(0).k_x, number) << text;
  }
  Look look;
  apply_setting(look, "depth_fog.color=.5,0., 01");
  EXPECT_EQ(look.of<DepthFog>().color, (Rgb<double>{0.5, 0, 1}));
  apply_setting(look, "refraction.steps=02");
  EXPECT_EQ(look.of<Refraction>().steps, 2);
  apply_setting(look, "refraction.steps=\"march\"");
  EXPECT_LT(look.of<Refraction>().steps, 0);
  apply_setting(look, "wave_normals.map=/a\xff.5\"\\b.png");  // no UTF-8, nothing is escaped
  EXPECT_EQ(look.of<WaveNormals>().map, "/a\xff.5\"\\b.png");
  for (const char* text : {".", "-.", "1.2.3", "0.1.", ".e5", "true", "1979-05-27", "\"1\""}) {
    EXPECT_THAT(error_of([&] { apply_setting(look, "refraction.strength=" + std::string(text)); }),
                HasSubstr(": expected a number"))
        << text;
  }
}

TEST(ApplySetting, ErrorsSayWhatWasExpectedAndLeaveTheLookAlone) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "setting '': expected operator.parameter=value"},
      {"refraction.strength", "expected operator.parameter=value"},
      {"strength=0.1", "setting 'strength=0.1': expected operator.parameter=value"},
      {"refracton.strength=1", "did you mean 'refraction'?"},
      {"refraction.strenght=1", "did you mean 'strength'?"},
      {"refraction.strength=", "refraction.strength = : expected a number"},
      {"refraction.strength=0.1x", "refraction.strength = 0.1x: expected a number"},
      {"refraction.strength=+-1", "expected a number"},
      {"refraction.strength=0.1 0.2", "expected a number"},
      {"refraction.strength=11", "refraction.strength = 11: expected -10 ... 10"},
      {"refraction.strength=nan", "refraction.strength = nan: expected -10 ... 10"},
      {"refraction.strength=inf", "refraction.strength = inf: expected -10 ... 10"},
      {"refraction.rejection=1", "refraction.rejection = 1: expected one of none, snap"},
      {"refraction.rejection=snp", "did you mean 'snap'?"},
      {"depth_fog.color=1", "depth_fog.color = 1: expected three numbers [r, g, b]"},
      {"wave_normals.waves=", "wave_normals.waves = : expected a list of [amplitude, k_x, k_y, ph"},
      {"wave_normals.waves=[1,2,3,4]", "expected a list of [amplitude, k_x, k_y, phase] or ["},
      {"wave_normals.waves=[[1,2,3,4]", "expected a list of [amplitude, k_x, k_y, phase] or ["},
      {"wave_normals.waves=[[1,2,3]]", "wave_normals.waves = [[1, 2, 3]]: expected a list of"},
      {"wave_normals.waves=[]\nx=1", "expected a list of [amplitude, k_x, k_y, phase] or ["},
      {"wave_normals.waves=[[1,2,3,inf]]", "inf]]: expected a list of"},
      {"depth_fog.color=[1,2]", "expected three numbers"},
      {"depth_fog.color=[1,2,3,4]", "expected three numbers"},
      {"depth_fog.color=[1,2,]", "expected three numbers"},
      {"depth_fog.color=[1,2,3", "expected three numbers"},
      {"depth_fog.color=[1,nan,3]", "depth_fog.color = [1, nan, 3]: expected three numbers, each"},
  };
  for (const auto& [setting, says] : cases) {
    Look look;
    try {
      apply_setting(look, setting);
      ADD_FAILURE() << setting;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(says)) << setting;
      EXPECT_EQ(error.fault(), Fault::kUsage);
    }
    EXPECT_EQ(values_of(look), values_of(Look{})) << setting;
  }
}

}  // namespace
}  // namespace limpid
