#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include <gmock/gmock.h>

#include "limpid/ops/chain.h"
#include "limpid/run/target.h"

#include "paths.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// The other verbs, and wrong usage.

namespace limpid::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

using VerbsTest = ToolTest;

TEST_F(VerbsTest, InspectTellsWhatIsThereAndWhatIsFound) {
  const Ran ran = limpid({"inspect", "plate.exr"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, StartsWith("plate.exr\n  part 0: 64x36, piz, scan lines\n"));
  EXPECT_THAT(ran.out, ContainsRegex("\n  depth +depth\\.Z +\\(plate\\.exr\\) +- layer"));
  EXPECT_THAT(ran.out, ContainsRegex("\nnot found\n  surface_depth"));
  const Ran without = limpid({"inspect", "plate.exr", "--layer", "depth=none"});
  EXPECT_THAT(without.out, ContainsRegex("\nnot found\n  depth"));
  expect_refused(limpid({"inspect"}), {"nothing to inspect: expected plates"}, 2);
  expect_refused(limpid({"inspect", "absent.exr"}), {"absent.exr: cannot be opened"});
}

TEST_F(VerbsTest, OperatorsListsTheChain) {
  const Ran ran = limpid({"operators"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  Chain::for_each([&]<class Op, int>() {
    EXPECT_THAT(ran.out, HasSubstr("\n" + std::string(Op::kName) + " "));
    for (const auto& field : Op::fields()) {
      EXPECT_THAT(ran.out, ContainsRegex("\n  " + std::string(field.name) + " +="));
    }
  });
}

/// The names follow the enum: a missing name would shift all names after it.
TEST_F(VerbsTest, OperatorsNamesTheStateThatEachUsesAndMakes) {
  const Ran ran = limpid({"operators"});
  EXPECT_THAT(ran.out, HasSubstr("taps -; uses -; makes normal, slope_variance\n"));
  EXPECT_THAT(ran.out, HasSubstr("makes position, path, dry_bottom, transmitted, confidence\n"));
  EXPECT_THAT(ran.out, ContainsRegex("makes [a-z_, ]*reflected, mirror_sources"));
}

TEST_F(VerbsTest, OperatorsListsScenesLayersAndAovsAsThePageHasThem) {
  std::ifstream page(std::filesystem::path(LIMPID_DATA) / "../docs/files.md");
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  const std::pair<const char*, const char*> tables[] = {
      {"--scene", "\n| `radiance` | required | 0 ... 1e+09 |"},
      {"--layers", "\n| `depth` | the whole layer | `depth` | `Z` | limpid, Nuke, Natron |\n"},
      {"--aovs", "\n| `path` | Z | float | middle sample |"}};
  for (const auto& [option, row] : tables) {
    const Ran ran = limpid({"operators", option});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr(row));
    EXPECT_THAT(text, HasSubstr("\n" + ran.out + "\n"))
        << "docs/files.md has what `limpid operators " << option << "` prints";
    expect_refused(limpid({"operators", option, "depth_fog"}),
                   {"name excludes " + std::string(option)}, 2);
  }
  expect_refused(limpid({"operators", "--scene", "--aovs"}), {"--scene excludes --aovs"}, 2);
}

TEST_F(VerbsTest, OperatorsListsTheParametersOfOne) {
  const Ran ran = limpid({"operators", "depth_fog"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, StartsWith("[depth_fog]\n"));
  EXPECT_THAT(ran.out, ContainsRegex("\n  density +="));
  EXPECT_THAT(ran.out, Not(HasSubstr("rejection")));
  const Ran look = limpid({"operators", "refraction", "--look", "look.toml"});
  EXPECT_THAT(look.out, ContainsRegex("\n  rejection +=.*snap"));
  EXPECT_EQ(limpid({"help", "depth_fog"}).out, ran.out);
  expect_refused(limpid({"operators", "depth_frog"}),
                 {"'depth_frog' is not an operator: ", "did you mean 'depth_fog'?"}, 2);
}

TEST_F(VerbsTest, HelpAndVersion) {
  const Ran help = limpid({"help"});
  EXPECT_EQ(help.code, 0);
  for (const std::string verb :
       {"composite", "plan", "view", "truth", "inspect", "operators", "compare", "help"}) {
    EXPECT_THAT(help.out, HasSubstr("\n  " + verb + " "));
    EXPECT_THAT(limpid({"help", verb}).out, HasSubstr("Usage: limpid " + verb + " [OPTIONS]"));
    EXPECT_EQ(limpid({"help", verb}).out, limpid({verb, "--help"}).out);
  }
  EXPECT_EQ(limpid({"--help"}).out, help.out);
  EXPECT_EQ(limpid({"-h"}).code, 0);
  const Ran version = limpid({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_THAT(version.out, ContainsRegex("^limpid [0-9]+\\.[0-9]+\\.[0-9]+\n$"));
  const Ran bare = limpid({});
  EXPECT_EQ(bare.code, 2);
  EXPECT_EQ(bare.out, help.out);
}

TEST_F(VerbsTest, HelpNamesEachAov) {
  for (const std::string verb : {"composite", "water"}) {
    const std::string help = limpid({"help", verb}).out;
    const std::string list = help.substr(std::min(help.find("--aov"), help.size()));
    const std::string line = list.substr(0, list.find('\n')) + ",";
    for (const AovInfo& info : aovs()) {
      EXPECT_THAT(line, HasSubstr(" " + std::string(info.name) + ",")) << verb;
    }
  }
}

TEST_F(VerbsTest, AMisspeltVerbOrOptionIsWrongUsage) {
  expect_refused(
      limpid({"compsite", "plate.exr", "-o", "wet.exr"}),
      {"'compsite' is not a verb: expected one of composite, ", "did you mean 'composite'?"}, 2);
  expect_refused(limpid({"composite", "plate.exr", "--prevew", "wet.png", "-o", "wet.exr"}),
                 {"limpid composite has no option '--prevew'", "did you mean '--preview'?"}, 2);
  expect_refused(limpid({"plan", "plate.exr", "--lok=calm"}),
                 {"limpid plan has no option '--lok'", "did you mean '--look'?"}, 2);
  expect_refused(limpid({"--verison"}), {"no option '--verison'", "did you mean '--version'?"}, 2);
  expect_refused(limpid({"compare", "a.exr", "b.exr", "c.exr"}),
                 {"limpid compare: unexpected argument 'c.exr'"}, 2);
  expect_refused(limpid({"help", "inspct"}),
                 {"'inspct' is neither a verb nor an operator", "did you mean 'inspect'?"}, 2);
}

TEST_F(VerbsTest, AWrongValueIsWrongUsage) {
  const Words plate = {"plate.exr", "--scene", "scene.toml"};
  const auto expect_wrong = [&](const Words& words, const Words& parts) {
    Words all = plate;
    all.insert(all.end(), words.begin(), words.end());
    expect_no_composite(all, parts, 2);
  };
  expect_wrong({"--time", "soon"}, {"--time = soon: expected a number"});
  expect_wrong({"--threads", "-3"}, {"--threads -3: expected a whole number, 0 ... 1024"});
  expect_wrong({"--aov", "fresnell"}, {"'fresnell' is not an AOV", "did you mean 'fresnel'?"});
  expect_wrong({"--aov", "all,fresnell"}, {"'fresnell' is not an AOV", "did you mean 'fresnel'?"});
  expect_wrong({"--runner", "fast"},
               {"'fast' is not a runner: expected one of fused, reference, gpu"});
  expect_wrong({"--max-error", "-0.001"}, {"--max-error -0.001: expected a finite number from 0"});
  expect_wrong({"--max-error", "nan"}, {"--max-error nan: expected a finite number from 0 up"});
  expect_wrong({"--max-error", "inf"}, {"--max-error inf: expected a finite number from 0 up"});
  expect_wrong({"--max-error", "little"}, {"--max-error = little: expected a number"});
  expect_wrong({"--max-error", "0.1", "--runner", "reference"},
               {"--max-error 0.1: the reference runner leaves nothing out"});
  expect_wrong({"--layer", "depht=none"}, {"'depht' is not a buffer", "did you mean 'depth'?"});
  expect_wrong({"--layer", "depth"}, {"--layer depth: expected ROLE=LAYER"});
  expect_wrong({"--compression", "pitz"}, {"compression 'pitz': ", "did you mean 'piz'?"});
  expect_wrong({"--compression", "piz:3"}, {"piz has no level"});
  expect_wrong({"--set", "depth_fog.densty=1"}, {"densty", "did you mean 'density'?"});
  expect_wrong({"--set", "depth_fog.density=much"},
               {"depth_fog.density = much: expected a number"});
  expect_wrong({"--set", "depth_fog.density=nan"}, {"depth_fog.density = nan: expected "});
  expect_wrong({"--set", "depth_fog.density=-1"}, {"depth_fog.density = -1: expected 0 ... "});
  const Ran png = limpid({"composite", "plate.exr", "--scene", "scene.toml", "-o", "wet.png"});
  expect_refused(png, {"-o wet.png: expected a name that ends in .exr"}, 2);
  expect_refused(limpid({"composite", "plate.exr"}), {"no output: expected -o OUT.exr"}, 2);
  expect_refused(limpid({"composite", "-o", "wet.exr"}), {"nothing to put water into"}, 2);
}

using CompareTest = ToolTest;

TEST_F(CompareTest, FusedIsAsGoodAsReference) {
  composed("fused.exr", {"--float", "--aov", "all"});
  composed("reference.exr", {"--float", "--aov", "all", "--runner", "reference"});
  const Ran ran = limpid({"compare", "fused.exr", "reference.exr", "--channels", "R,G,B,A",
                          "--tolerance", "3e-4", "--allowed-percent", "0.01"});
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("Relative MSE"));
}

TEST_F(CompareTest, ADifferenceIsExitOneAndAMap) {
  composed("wet.exr");
  composed("clear.exr", {"--set", "depth_fog.density=0"});
  const Ran ran = limpid({"compare", "wet.exr", "clear.exr", "--diff", "map.png"});
  EXPECT_EQ(ran.code, 1);
  EXPECT_EQ(ran.err, "");
  EXPECT_THAT(ran.out, HasSubstr("map.png"));
  EXPECT_THAT(iinfo("map.png"), HasSubstr("3 channel, uint8 png"));
  EXPECT_EQ(limpid({"compare", "wet.exr", "wet.exr"}).code, 0);
}

TEST_F(CompareTest, QuietlyTheExitCodeTells) {
  composed("wet.1.exr");
  composed("clear.1.exr", {"--set", "depth_fog.density=0"});
  for (const Words& frames : {Words{}, Words{"--frames", "1", "--metrics", "all"}}) {
    const auto compared = [&](const std::string& a, const std::string& b) {
      const std::string number = frames.empty() ? ".1" : ".%d";
      Words words{"compare", a + number + ".exr", b + number + ".exr", "-q"};
      words.insert(words.end(), frames.begin(), frames.end());
      return limpid(words);
    };
    const Ran same = compared("wet", "wet"), other = compared("wet", "clear");
    EXPECT_EQ(same.code, 0);
    EXPECT_EQ(other.code, 1);
    EXPECT_EQ(same.out + same.err + other.out + other.err, "");
    expect_refused(compared("wet", "absent"), {"absent.1.exr: cannot be opened"});
  }
  EXPECT_EQ(limpid({"compare", "wet.1.exr", "clear.1.exr", "--diff", "map.png", "-q"}).out, "");
  EXPECT_THAT(iinfo("map.png"), HasSubstr("3 channel, uint8 png"));
}

TEST_F(CompareTest, RefusesWhatCannotBeCompared) {
  composed("wet.exr");
  composed("aovs.exr", {"--aov", "path"});
  expect_refused(limpid({"compare", "wet.exr", "absent.exr"}), {"absent.exr: cannot be opened"});
  expect_refused(limpid({"compare", "wet.exr", "aovs.exr"}),
                 {"wet.exr has the channels", "--channels"});
  expect_refused(limpid({"compare", "wet.exr", "aovs.exr", "--channels", "R,Q"}),
                 {"wet.exr has no channel or layer 'Q': there is A, B, G, R"});
  expect_refused(limpid({"compare", "wet.exr", "waves.exr", "--channels", "R"}),
                 {"64x36", "16x16"});
  expect_refused(limpid({"compare", "wet.exr"}), {"b is required"}, 2);
}

}  // namespace
}  // namespace limpid::test
