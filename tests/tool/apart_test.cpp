#include <map>

#include <gmock/gmock.h>

#include "limpid/core/error.h"
#include "limpid/files/gltf/gltf.h"
#include "limpid/files/text/frame_range.h"
#include "limpid/files/text/look_file.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/job/job_files.h"
#include "limpid/job/sequence.h"

#include "paths.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// A job that would write over its inputs, or twice into one file, is refused before any file is
/// written.

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ApartTest : public ToolTest {
 protected:
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> all;
    for (const std::string& name : files()) {
      all[name] = fs::is_regular_file(folder_ / name) ? text_of(name) : "";
    }
    return all;
  }
  /// Expects exit code 2, a message with these parts, and unchanged files.
  void expect_untouched(const Words& words, const Words& parts) const {
    const auto before = contents();
    expect_refused(limpid(words), parts, 2);
    EXPECT_TRUE(contents() == before) << "a file has changed";
  }
  void expect_composite_refused(const Words& more, const Words& parts) const {
    Words words{"composite", "--scene", "scene.toml", "--look", "look.toml"};
    words.insert(words.end(), more.begin(), more.end());
    expect_untouched(words, parts);
  }
  void write_plates(const std::string& pattern, int count) const {
    for (int frame = 1; frame <= count; ++frame) {
      fs::copy_file(folder_ / "plate.exr", folder_ / name_of_frame(pattern, frame));
    }
  }
  /// The pool in a folder of its own.
  void copy_pool() const {
    fs::create_directory(folder_ / "pool");
    for (const auto& entry : fs::directory_iterator(LIMPID_DATA "/scenes")) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("pool")) fs::copy_file(entry.path(), folder_ / "pool" / name);
    }
  }
};

TEST_F(ApartTest, APlateIsNotWrittenOverByAnyName) {
  const std::string sentence = ": is an input, too";
  expect_composite_refused({"plate.exr", "-o", "plate.exr"}, {"plate.exr" + sentence});
  expect_composite_refused(
      {"plate.exr", "-o", "./plate.exr"},
      {"./plate.exr" + sentence + ", named plate.exr: expected a separate file"});
  expect_composite_refused({"plate.exr", "-o", (folder_ / "plate.exr").string()}, {sentence});
  fs::create_symlink("plate.exr", folder_ / "soft.exr");
  expect_composite_refused({"plate.exr", "-o", "soft.exr"}, {"soft.exr" + sentence});
  expect_composite_refused({"soft.exr", "-o", "plate.exr"}, {"plate.exr" + sentence});
  fs::create_hard_link(folder_ / "plate.exr", folder_ / "hard.exr");
  expect_composite_refused({"plate.exr", "-o", "hard.exr"}, {"hard.exr" + sentence});
  fs::create_directory_symlink(".", folder_ / "here");
  expect_composite_refused({"plate.exr", "-o", "here/plate.exr"}, {"plate.exr" + sentence});
}

TEST_F(ApartTest, NoOutputIsAnInput) {
  expect_composite_refused({"plate.exr", "-o", "wet.exr", "--deep", "plate.exr"},
                           {"plate.exr: is an input, too"});
  fs::create_symlink("look.toml", folder_ / "look.png");
  expect_composite_refused({"plate.exr", "-o", "wet.exr", "--preview", "look.png"},
                           {"look.png: is an input, too, named ", "look.toml"});
  fs::create_symlink("scene.toml", folder_ / "scene.exr");
  expect_composite_refused({"plate.exr", "-o", "scene.exr"},
                           {"scene.exr: is an input, too, named ", "scene.toml"});
  expect_composite_refused({"plate.exr", "-o", "waves.exr"},
                           {"waves.exr: is an input, too, named ", "/waves.exr"});
  write_plate(folder_ / "depth.exr");
  expect_composite_refused({"plate.exr", "--layer", "depth=depth.exr:depth.Z", "-o", "depth.exr"},
                           {"depth.exr: is an input, too"});
  write_text("around.toml", "[plates]\nenvironment = \"sky.exr\"\n" + scene_toml());
  ASSERT_EQ(oiiotool({"--pattern", "constant:color=1,1,1", "32x16", "3", "-o", "sky.exr"}).code, 0);
  expect_untouched({"composite", "plate.exr", "--scene", "around.toml", "-o", "sky.exr"},
                   {"sky.exr: is an input, too, named ", "/sky.exr"});
  const Ran picture = oiiotool({"plate.exr", "--ch", "R,G,B", "-d", "uint8", "-o", "color.png"});
  ASSERT_EQ(picture.code, 0) << picture.err;
  expect_composite_refused({"--layer", "color=color.png", "--layer", "depth=plate.exr:depth.Z",
                            "-o", "wet.exr", "--preview", "color.png"},
                           {"color.png: is an input, too"});
}

TEST_F(ApartTest, EachOutputIsAFileOfItsOwn) {
  const std::string sentence = ": is another output, too";
  expect_composite_refused({"plate.exr", "-o", "wet.exr", "--deep", "./wet.exr"},
                           {"./wet.exr" + sentence + ", named wet.exr: expected a separate file"});
  write_text("old.exr", "old");
  fs::create_symlink("old.exr", folder_ / "old.png");
  fs::create_symlink("new.exr", folder_ / "new.png");
  expect_composite_refused({"plate.exr", "-o", "old.exr", "--preview", "old.png"},
                           {"old.png" + sentence});
  expect_composite_refused({"plate.exr", "-o", "new.exr", "--preview", "new.png"},
                           {"new.png" + sentence});
}

TEST_F(ApartTest, ASequenceIsRefusedBeforeItsFirstFrame) {
  write_plates("q.%04d.exr", 3);
  expect_composite_refused({"q.####.exr", "-o", "q.####.exr", "--frames", "1-3"},
                           {"frame 1: q.0001.exr: is an input, too"});
  // A still plate, which the last frame would overwrite.
  for (const Words& more : {Words{}, Words{"--resume"}}) {
    Words words{"q.0003.exr", "-o", "q.####.exr", "--frames", "2-3"};
    words.insert(words.end(), more.begin(), more.end());
    expect_composite_refused(words, {"frame 3: q.0003.exr: is an input"});
  }
  expect_composite_refused(
      {"q.####.exr", "-o", "wet.####.exr", "--deep", "q.%04d.exr", "--frames", "1-3"},
      {"frame 1: q.0001.exr: is an input, too"});
  fs::create_symlink("q.0003.exr", folder_ / "wet.0001.exr");
  expect_composite_refused({"q.####.exr", "-o", "wet.####.exr", "--frames", "1-3"},
                           {"frame 1: wet.0001.exr: is an input of frame 3, too, named q.0003"});
  fs::remove(folder_ / "wet.0001.exr");
  fs::create_symlink("wet.0002.exr", folder_ / "wet.0003.exr");
  expect_composite_refused({"q.####.exr", "-o", "wet.####.exr", "--frames", "1-3"},
                           {"frame 3: wet.0003.exr: is another output of frame 2, too"});
  // The same frame twice is one frame.
  fs::remove(folder_ / "wet.0003.exr");
  const Ran twice = limpid({"composite", "q.####.exr", "--scene", "scene.toml", "--look",
                            "look.toml", "-o", "wet.####.exr", "--frames", "1-2,2"});
  EXPECT_EQ(twice.code, 0) << twice.err;
}

TEST_F(ApartTest, RenderedScenesStay) {
  copy_pool();
  fs::create_symlink("pool.bin", folder_ / "pool/bin.exr");
  fs::create_symlink("pool.gltf", folder_ / "pool/gltf.exr");
  fs::create_hard_link(folder_ / "pool/pool.toml", folder_ / "pool/toml.exr");
  std::string image;
  for (const std::string& name : files()) {
    if (name.starts_with("pool/") && name.ends_with(".png")) image = name;
  }
  for (const std::string verb : {"render", "water", "truth"}) {
    for (const std::string name : {"bin", "gltf", "toml"}) {
      for (const Words& more : {Words{}, Words{"--frames", "7"}}) {
        Words words{verb, "pool/pool.toml", "--size", "32x18", "-o", "pool/" + name + ".exr"};
        words.insert(words.end(), more.begin(), more.end());
        expect_untouched(words, {"pool/" + name + ".exr: is an input, too, named "});
      }
    }
    if (verb == "render" || image.empty()) continue;
    expect_untouched(
        {verb, "pool/pool.toml", "--size", "32x18", "-o", "wet.exr", "--preview", image},
        {image + ": is an input, too"});
  }
}

TEST_F(ApartTest, ComparedPicturesAndDataStay) {
  ASSERT_EQ(oiiotool({"plate.exr", "--ch", "R,G,B", "-d", "uint8", "-o", "a.png"}).code, 0);
  const Words pictures{"compare", "a.png", "plate.exr", "--channels", "R,G,B"};
  for (const std::string option : {"--diff", "--flip-map"}) {
    Words words = pictures;
    words.insert(words.end(), {option, "./a.png"});
    expect_untouched(words, {"./a.png: is an input, too, named a.png"});
  }
  Words both = pictures;
  both.insert(both.end(), {"--diff", "map.png", "--flip-map", "map.png"});
  expect_untouched(both, {"map.png: is another output, too"});
  fs::copy_file(folder_ / "a.png", folder_ / "a.7.png");
  expect_untouched({"compare", "a.%d.png", "a.%d.png", "--frames", "7", "--diff", "a.%d.png"},
                   {"frame 7: a.7.png: is an input, too"});

  fs::create_directories(folder_ / "data");
  fs::copy(LIMPID_DATA "/looks", folder_ / "data/looks");
  for (const std::string name : {"scenes", "plates", "maps"}) {
    fs::create_directory_symlink(LIMPID_DATA "/" + name, folder_ / "data" / name);
  }
  fs::create_directory(folder_ / "report");
  for (const std::string name : {"report.json", "hard.json"}) {
    fs::create_symlink(folder_ / "data/looks/physical.toml", folder_ / "report" / name);
    const auto before = contents();
    const Ran ran = run(folder_, {"/usr/bin/env", "LIMPID_DATA=data", LIMPID_TOOL, "report", "-o",
                                  "report", name[0] == 'h' ? "--hard" : "--quick"});
    expect_refused(ran, {"report/" + name + ": is an input, too, named data/looks/physical.toml"},
                   2);
    EXPECT_TRUE(contents() == before);
    fs::remove(folder_ / "report" / name);
  }
}

/// An output that is a link stays a link, and the file that the link names is written.
TEST_F(ApartTest, OutputsGoWhereLinksLead) {
  fs::create_directory(folder_ / "disk");
  write_text("disk/old.exr", "old");
  fs::create_symlink("disk/old.exr", folder_ / "wet.exr");
  fs::create_symlink("disk/new.png", folder_ / "wet.png");
  composed("wet.exr", {"--preview", "wet.png"});
  EXPECT_TRUE(fs::is_symlink(folder_ / "wet.exr"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "wet.png"));
  composed("plain.exr");
  EXPECT_TRUE(same("disk/old.exr", "plain.exr"));
  EXPECT_THAT(iinfo("disk/new.png"), HasSubstr("64 x   36"));
}

/// The library refuses the same jobs as the tool; these jobs are built in C++.
class ApartJobs : public ApartTest {
 protected:
  CompositeJob job() const {
    CompositeJob job;
    job.scene = load_scene(folder_ / "scene.toml");
    job.plate.files = {folder_ / "plate.exr"};
    job.look = load_look(folder_ / "look.toml");
    job.output.picture = folder_ / "wet.exr";
    return job;
  }
  /// The message of the refusal; all files must be unchanged.
  template <class Work>
  std::string refusal(const Work& work) const {
    const auto before = contents();
    std::string text;
    try {
      work();
    } catch (const Error& error) {
      text = error.what();
      EXPECT_EQ(error.fault(), Fault::kUsage);
    }
    EXPECT_TRUE(contents() == before);
    return text;
  }
};

TEST_F(ApartJobs, AreRefusedByTheLibraryToo) {
  const auto executor = make_executor(1);
  for (const char* input : {"plate.exr", "waves.exr", "look.toml", "scene.toml"}) {
    fs::remove(folder_ / "wet.exr");
    fs::create_hard_link(folder_ / input, folder_ / "wet.exr");
    EXPECT_THAT(refusal([&] { ::limpid::composite(job(), *executor); }),
                HasSubstr("is an input, too"))
        << input;
    const std::string sequence = refusal([&] {
      composite_sequence(
          {{3, 4}, 1}, [&](int) { return job(); }, {}, *executor);
    });
    EXPECT_THAT(sequence, StartsWith("frame 3: ")) << input;
    EXPECT_THAT(sequence, HasSubstr("wet.exr: is an input, too")) << input;
  }
  fs::remove(folder_ / "wet.exr");
  // One output name for all frames of a sequence.
  EXPECT_THAT(refusal([&] {
                composite_sequence(
                    {{3, 4}, 1}, [&](int) { return job(); }, {}, *executor);
              }),
              HasSubstr("wet.exr: is another output of frame 3, too: expected a separate file"));
}

TEST_F(ApartJobs, ModelsKnowTheirFiles) {
  copy_pool();
  const SceneFile scene = load_scene(folder_ / "pool/pool.toml");
  const Model model = load_gltf(scene.geometry);
  const auto executor = make_executor(1);
  RenderJob plate;
  plate.scene = scene;
  plate.render.size = {32, 18};
  WaterJob wet;
  wet.scene = scene;
  wet.render = plate.render;
  wet.look = load_look(folder_ / "look.toml");
  ASSERT_GE(model.files.size(), 2u);
  for (const fs::path& file : model.files) {
    plate.output.plate = wet.output.picture = file;
    EXPECT_THAT(refusal([&] { render(model, plate, *executor); }), HasSubstr("is an input, too"));
    EXPECT_THAT(refusal([&] { water(model, wet, *executor); }), HasSubstr("is an input, too"));
    EXPECT_THAT(refusal([&] {
                  water_sequence(
                      model, {{1}, 1}, [&](int) { return wet; }, {}, *executor);
                }),
                HasSubstr("frame 1: "));
  }
  wet.output.picture = folder_ / "look.toml";
  EXPECT_THAT(refusal([&] { water(model, wet, *executor); }), HasSubstr("is an input, too"));
}

/// Other faults of a frame are reported when the sequence reaches the frame.
TEST_F(ApartJobs, FramesWithoutAJobArePassedOver) {
  const std::vector<int> frames{1, 2, 3};
  std::vector<int> asked;
  expect_apart(frames, [&](int frame) {
    asked.push_back(frame);
    if (frame == 2) throw Error("no scene");
    return JobFiles{{"in.exr"}, {name_of_frame("out.%d.exr", frame)}};
  });
  EXPECT_EQ(asked, frames);
}

}  // namespace
}  // namespace limpid::test
