// The output of the desk: saved looks and command lines.
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>

#include "limpid/files/text/look_file.h"

#include "desk/desk.h"
#include "desk/pond_desk.h"
#include "desk/saved_look.h"
#include "paths.h"

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

void expect_same(const Look& a, const Look& b, const std::string& after) {
  const std::vector<Parameter> of_a = parameters(a), of_b = parameters(b);
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    EXPECT_EQ(of_a[i].value, of_b[i].value)
        << after << ": " << of_a[i].table << "." << of_a[i].name;
  }
}

/// A valid value of the field, for most kinds another than the present value.
Value other_value(const Parameter& p) {
  const double middle = p.range.max < 1e9 ? 0.25 * p.range.min + 0.75 * p.range.max : 3.125;
  if (p.kind == FieldKind::kReal) return middle;
  if (p.kind == FieldKind::kColor) return Rgb<double>{middle, p.range.min, middle};
  if (p.kind == FieldKind::kChoice) return std::string(p.choices.back());
  if (p.kind == FieldKind::kCountOrWord) return std::string(p.choices.front());
  return p.value;
}

TEST(SavedLookTest, ReadsBackWhateverIsChanged) {
  std::size_t changed = 0;
  const fs::path data(LIMPID_DATA), folders[] = {data / "looks", data / "presets"};
  for (const char* name : {"physical", "realistic", "fast", "monogame", "rito", "harbour"}) {
    const DeskLook of{name, look_named(name, folders)};
    for (const Parameter& p : parameters(of.look)) {
      Look look = of.look;
      look.set(p.table, p.name, other_value(p));
      const std::string text = saved_look(look, of, "/else");
      expect_same(look_from_toml(text, "saved"), look,
                  std::string(name) + " with " + std::string(p.table) + "." + std::string(p.name));
      ++changed;
    }
  }
  EXPECT_GT(changed, 250u);
}

class SaveTest : public PondDesk {
 protected:
  DeskOptions options_ = options();
  Desk desk_{options_, *executor_};
  DeskChoice murky_{"pond", {"depth_fog.density=3"}};
};

TEST_F(SaveTest, WritesALookOfTheSamePicture) {
  const fs::path file = desk_.save(murky_, "murky.toml", false);
  EXPECT_EQ(file, folder_ / "saved/murky.toml");
  const Look look = load_look(file);
  expect_same(look, desk_.look_of(murky_), "saved");
  PictureRequest request;
  static_cast<DeskChoice&>(request) = murky_;
  EXPECT_EQ(colors(desk_.paint(request).shown), previewed(options_, look));
}

TEST_F(SaveTest, SaysWhatIsChangedAndWhatItMeans) {
  const std::string text = text_of(desk_.save(murky_, "murky.toml", false));
  EXPECT_THAT(text, HasSubstr("# From the look pond."));
  EXPECT_THAT(text, HasSubstr("density = 3.0\n"));
  EXPECT_THAT(text, HasSubstr("In pond "));
  EXPECT_THAT(text, HasSubstr("map = \"" + (folder_ / "waves.exr").string() + "\""));
  EXPECT_THAT(text, Not(HasSubstr("[prism_split]\n\n")));
}

TEST_F(SaveTest, NamesAWaveMapOfItsFolderFromThere) {
  options_.folder = folder_;
  Desk desk(options_, *executor_);
  const fs::path file = desk.save(murky_, "murky.toml", false);
  EXPECT_THAT(text_of(file), HasSubstr("map = \"waves.exr\""));
  expect_same(load_look(file), desk.look_of(murky_), "saved");
}

TEST_F(SaveTest, ReplacesWhenItIsToldTo) {
  desk_.save(murky_, "mine.toml", false);
  const std::string before = text_of(folder_ / "saved/mine.toml");
  DeskChoice other = murky_;
  other.settings = {"depth_fog.density=5"};
  EXPECT_THROW(desk_.save(other, "mine.toml", false), NameTaken);
  EXPECT_EQ(text_of(folder_ / "saved/mine.toml"), before);
  desk_.save(other, "mine.toml", true);
  EXPECT_THAT(text_of(folder_ / "saved/mine.toml"), HasSubstr("density = 5.0"));
}

TEST_F(SaveTest, RefusesNamesThatLeadElsewhere) {
  const std::vector<std::string> names = {
      "",      ".toml",        "..",      "../x.toml", "a/x.toml", "x",
      "x.exr", "/else/x.toml", ".x.toml", "x.toml/",   "x\n.toml", std::string("x\0.toml", 7)};
  for (const std::string& name : names) {
    EXPECT_THAT(refusal([&] { desk_.save(murky_, name, true); }), HasSubstr("name = '")) << name;
  }
  fs::create_symlink(folder_ / "pond.toml", folder_ / "saved/link.toml");
  EXPECT_THAT(refusal([&] { desk_.save(murky_, "link.toml", true); }), HasSubstr("is a link"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "saved"), {}), 1);
}

TEST_F(SaveTest, NeverWritesAnInput) {
  options_.folder = folder_;
  Desk desk(options_, *executor_);
  for (const char* name : {"pond.toml", "scene.toml"}) {
    const std::string before = text_of(folder_ / name);
    EXPECT_THAT(refusal([&] { desk.save(murky_, name, true); }), HasSubstr("is an input, too"));
    EXPECT_EQ(text_of(folder_ / name), before);
  }
}

TEST_F(SaveTest, RefusesALookThatIsWrong) {
  EXPECT_THAT(refusal([&] {
                desk_.save({"pond", {"depth_fog.density=-1"}}, "x.toml", false);
              }),
              HasSubstr("depth_fog.density = -1"));
  EXPECT_FALSE(fs::exists(folder_ / "saved/x.toml"));
}

TEST_F(SaveTest, GivesTheCommandLine) {
  EXPECT_EQ(desk_.command(murky_),
            "limpid composite plate.exr --look pond --set depth_fog.density=3 -o wet.exr");
  murky_.time = 1.5;
  murky_.settings.push_back("depth_fog.color=[0.1, 0.2, 0.3]");
  EXPECT_EQ(desk_.command(murky_),
            "limpid composite plate.exr --look pond --set depth_fog.density=3 --set "
            "'depth_fog.color=[0.1, 0.2, 0.3]' --time 1.5 -o wet.exr");
  murky_.settings = {"depth_fog.densty=3"};
  EXPECT_THAT(refusal([&] { desk_.command(murky_); }), HasSubstr("did you mean 'density'?"));
}

TEST_F(SaveTest, GivesTheCommandLineOfASequenceFromTheShownFramesTime) {
  options_.frames = {24, 48};
  options_.range = "24-48x24";
  Desk desk(options_, *executor_);
  murky_.frame = 48;
  murky_.time = 5;
  EXPECT_EQ(desk.command(murky_),
            "limpid composite plate.exr --look pond --set depth_fog.density=3 --time 3.0 --frames "
            "24-48x24 -o 'wet.####.exr'");
}

}  // namespace
}  // namespace limpid::test
