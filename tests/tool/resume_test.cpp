#include <map>

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "limpid/files/exr/exr_file.h"
#include "limpid/files/text/frame_range.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/version.h"

#include "paths.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

/// Resumed sequences, and sequences with missing plates.

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ResumeTest : public ToolTest {
 protected:
  void write_plates(const std::vector<int>& frames) const {
    for (const int frame : frames) {
      PlateOptions options;
      options.depth_code = [=](double z, double) { return z * (1 + 0.02 * frame); };
      write_plate(folder_ / name_of_frame("plate.%d.exr", frame), options);
    }
  }
  Words words(const Words& more) const {
    Words all{"composite", "plate.%d.exr", "--scene",  "scene.toml", "--look", "look.toml",
              "-o",        "wet.%d.exr",   "--frames", "1-4",        "--deep", "deep.%d.exr"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// The stderr of a run that succeeds.
  std::string said_by(const Words& words) const {
    const Ran ran = limpid(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.err;
  }
  std::string resumed(const Words& more = {}) const {
    Words all = words(more);
    all.push_back("--resume");
    return said_by(all);
  }
  /// The inode of a file: a replaced file has another number.
  ino_t file_number(const std::string& name) const {
    struct stat status {};
    EXPECT_EQ(::stat((folder_ / name).c_str(), &status), 0) << name;
    return status.st_ino;
  }
  /// All outputs with their contents.
  std::map<std::string, std::string> outputs() const {
    std::map<std::string, std::string> all;
    for (const std::string& name : files()) {
      if (name.starts_with("wet.") || name.starts_with("deep.")) all[name] = text_of(name);
    }
    return all;
  }
};

TEST_F(ResumeTest, WholeFramesAreLeftAloneAndTheOthersMade) {
  const Words preview{"--preview", "wet.%d.png"};
  write_plates({1, 2, 3, 4});
  EXPECT_EQ(said_by(words(preview)), "");
  const auto all = outputs();
  ASSERT_EQ(all.size(), 12u);
  fs::remove(folder_ / "wet.2.exr");
  fs::remove(folder_ / "wet.3.exr");
  fs::remove(folder_ / "deep.3.exr");
  const ino_t first = file_number("wet.1.exr"), deep = file_number("deep.4.exr");
  write_text(".limpid-4194305-0.exr", "half of a frame");  // larger than any process number
  EXPECT_EQ(resumed(preview), "limpid: 2 of 4 frames are kept\n");
  EXPECT_TRUE(outputs() == all);
  EXPECT_EQ(file_number("wet.1.exr"), first);
  EXPECT_EQ(file_number("deep.4.exr"), deep);

  // A run that has no frame to make only removes leftover temporary files.
  EXPECT_FALSE(fs::exists(folder_ / ".limpid-4194305-0.exr"));
  write_text(".limpid-4194305-0.png", "half of a frame");
  const ino_t second = file_number("wet.2.exr");
  EXPECT_EQ(resumed(preview), "limpid: 4 of 4 frames are kept\n");
  EXPECT_EQ(file_number("wet.2.exr"), second);
  EXPECT_FALSE(fs::exists(folder_ / ".limpid-4194305-0.png"));
  EXPECT_EQ(resumed({"-q", "--preview", "wet.%d.png"}), "");
  // Without --resume every frame is made again.
  EXPECT_EQ(said_by(words(preview)), "");
  EXPECT_NE(file_number("wet.2.exr"), second);
}

TEST_F(ResumeTest, WhereFilesLieAndWhenTheyWereMadeDoesNotMatter) {
  write_plates({1, 2, 3, 4});
  said_by(words({}));
  fs::create_directory(folder_ / "moved");
  for (int frame = 1; frame <= 4; ++frame) {
    const std::string name = name_of_frame("plate.%d.exr", frame);
    fs::copy_file(folder_ / name, folder_ / "moved" / name);
    fs::remove(folder_ / name);
  }
  Words moved = words({"--resume", "--threads", "1"});
  moved[1] = "moved/plate.%d.exr";
  EXPECT_EQ(said_by(moved), "limpid: 4 of 4 frames are kept\n");
}

/// An OpenColorIO config is unchanged, but a lookup table that the config names has changed.
TEST_F(ResumeTest, SeesAnotherTableOfAConfig) {
  const auto write_table = [&](const std::string& white) {
    write_text("table.spi1d",
               "Version 1\nFrom 0.0 1.0\nLength 2\nComponents 1\n{\n  0.0\n  " + white + "\n}\n");
  };
  write_text("table.ocio", R"(ocio_profile_version: 1
search_path: ""
roles: {default: lin_rec709, scene_linear: lin_rec709}
displays:
  screen:
    - !<View> {name: table, colorspace: table}
colorspaces:
  - !<ColorSpace> {name: lin_rec709}
  - !<ColorSpace>
    name: table
    from_reference: !<FileTransform> {src: table.spi1d, interpolation: linear}
)");
  write_plates({1, 2, 3, 4});
  const Words shown{"--preview", "wet.%d.png", "--ocio", "table.ocio"};
  write_table("1.0");
  said_by(words(shown));
  const std::string bright = text_of("wet.2.png");
  EXPECT_EQ(resumed(shown), "limpid: 4 of 4 frames are kept\n");
  write_table("0.5");
  EXPECT_THAT(resumed(shown), HasSubstr("limpid: 0 of 4 frames are kept\n"));
  EXPECT_NE(text_of("wet.2.png"), bright);
  EXPECT_EQ(resumed(shown), "limpid: 4 of 4 frames are kept\n");
}

TEST_F(ResumeTest, WhatWasMadeOtherwiseIsMadeAgainAndSaid) {
  write_plates({1, 2, 3, 4});
  said_by(words({}));
  const auto all = outputs();
  const std::string none =
      "limpid: 0 of 4 frames are kept\n"
      "limpid: 4 existing frames are made again; frame 1: wet.1.exr was made "
      "differently ";
  EXPECT_EQ(resumed({"--set", "depth_fog.density=0.3"}), none + "(look)\n");
  EXPECT_EQ(resumed({"--set", "depth_fog.density=0.3", "--float"}), none + "(options)\n");
  EXPECT_EQ(resumed({"--set", "depth_fog.density=0.3", "--float", "--layer", "shadow=none"}),
            none + "(inputs, plan, scene_hash)\n");
  EXPECT_EQ(resumed(), none + "(inputs, look, options, plan, scene_hash)\n");
  EXPECT_TRUE(outputs() == all);
  EXPECT_EQ(resumed({"--time", "1"}), none + "(scene, scene_hash)\n");
  EXPECT_THAT(resumed({"-v"}),
              HasSubstr("\nlimpid: frame 4: wet.4.exr was made differently (scene"));
  EXPECT_TRUE(outputs() == all);
}

/// One fault of frame 2 in each run.
TEST_F(ResumeTest, WhatIsNotWholeOrNotOursIsMadeAgain) {
  write_plates({1, 2, 3, 4});
  said_by(words({}));
  const auto all = outputs();
  const auto expect_again = [&](const std::string& why) {
    EXPECT_EQ(resumed(),
              "limpid: 3 of 4 frames are kept\n"
              "limpid: 1 existing frame is made again; frame 2: " +
                  why + "\n");
    EXPECT_TRUE(outputs() == all) << why;
  };
  for (const std::string name : {"wet.2.exr", "deep.2.exr"}) {
    fs::resize_file(folder_ / name, fs::file_size(folder_ / name) - 1);
    expect_again(name + ": is incomplete");
    write_text(name, "not one of ours");
    expect_again(name + ": is not an OpenEXR file");
  }
  fs::copy_file(folder_ / "plate.2.exr", folder_ / "wet.2.exr",
                fs::copy_options::overwrite_existing);
  expect_again("wet.2.exr does not record how it was made");
  fs::remove(folder_ / "deep.2.exr");
  expect_again("deep.2.exr is missing");
  std::string older = text_of("wet.2.exr");
  const std::size_t version = older.find(kVersion, older.find("limpid/version"));
  older[version] += 1;
  write_text("wet.2.exr", older);
  expect_again("wet.2.exr was made differently (version)");
}

/// Changes one byte of frame 2: in its pixels, in the hash, in an attribute copied from the plate.
TEST_F(ResumeTest, VerifySeesAnyByteThatChanges) {
  const Words preview{"--preview", "wet.%d.png"};
  write_plates({1, 2, 3, 4});
  said_by(words(preview));
  const auto all = outputs();
  const std::string head = "limpid: 3 of 4 frames are kept\n";
  const auto verified = [&] { return resumed({"--verify", "--preview", "wet.%d.png"}); };
  EXPECT_EQ(verified(), "limpid: 4 of 4 frames are kept\n");
  for (const std::string name : {"wet.2.exr", "deep.2.exr"}) {
    const std::string whole = text_of(name);
    const std::size_t digits = whole.find("limpid_file_hash") + 30;
    const std::size_t studio = whole.find("shallow end");
    for (const std::size_t at : {whole.size() - 1, digits, studio}) {
      std::string other = whole;
      other[at] = static_cast<char>(other[at] ^ 1);
      write_text(name, other);
      EXPECT_EQ(verified(), head + "limpid: 1 existing frame is made again; frame 2: " + name +
                                " has changed since it was written (its hash differs)\n")
          << at;
      EXPECT_TRUE(outputs() == all) << name << " " << at;
    }
    // A byte among the pixels is seen by --verify only.
    std::string other = whole;
    other.back() = static_cast<char>(other.back() ^ 1);
    write_text(name, other);
    EXPECT_EQ(resumed(preview), "limpid: 4 of 4 frames are kept\n");
    write_text(name, whole);
    fs::resize_file(folder_ / name, whole.size() - 1);
    EXPECT_THAT(verified(), HasSubstr("frame 2: " + name + ": is incomplete\n"));
    EXPECT_TRUE(outputs() == all);
  }
  std::string png = text_of("wet.2.png");
  char& pixel = png[png.find("IDAT") + 20];
  pixel = static_cast<char>(pixel ^ 1);
  write_text("wet.2.png", png);
  EXPECT_THAT(verified(), HasSubstr("frame 2: wet.2.png: is damaged: wrong checksum"));
  EXPECT_TRUE(outputs() == all);
  // Other programs remove the hash, or keep the old hash.
  ASSERT_EQ(oiiotool({"wet.2.exr", "--attrib", "copyright", "ours", "-o", "wet.2.exr"}).code, 0);
  EXPECT_THAT(verified(), HasSubstr("frame 2: wet.2.exr has changed since it was written"));
  EXPECT_TRUE(outputs() == all);
}

TEST_F(ResumeTest, PreviewsSayHowTheyWereMade) {
  write_plates({1, 2});
  const auto run = [&](const Words& more) {
    Words all{"composite", "plate.%d.exr", "--scene",   "scene.toml", "--look",   "look.toml",
              "-o",        "wet.%d.exr",   "--preview", "wet.%d.png", "--frames", "1-2"};
    all.insert(all.end(), more.begin(), more.end());
    return said_by(all);
  };
  run({});
  const auto all = outputs();
  fs::resize_file(folder_ / "wet.1.png", fs::file_size(folder_ / "wet.1.png") - 12);
  EXPECT_THAT(run({"--resume"}), HasSubstr("frame 1: wet.1.png: ends too early"));
  EXPECT_TRUE(outputs() == all);
  fs::copy_file(folder_ / "wet.1.png", folder_ / "wet.2.png", fs::copy_options::overwrite_existing);
  EXPECT_THAT(run({"--resume"}),
              HasSubstr("frame 2: wet.2.png was made differently (inputs, scene, scene_hash)"));
  EXPECT_TRUE(outputs() == all);
}

TEST_F(ResumeTest, OtherPixelsAreOtherInputs) {
  write_plates({1, 2, 3, 4});
  said_by(words({}));
  write_plate(folder_ / "plate.3.exr", {.broken = true});
  EXPECT_THAT(resumed(), HasSubstr("3 of 4 frames are kept\nlimpid: 1 existing frame is "
                                   "made again; frame 3: wet.3.exr was made differently (inputs, "
                                   "scene_hash)\n"));
  write_waves(folder_ / "waves.exr");
  EXPECT_THAT(resumed(), StartsWith("limpid: 4 of 4"));
  fs::copy_file(folder_ / "plate.exr", folder_ / "waves.exr", fs::copy_options::overwrite_existing);
  EXPECT_THAT(resumed(), HasSubstr("0 of 4 frames are kept\nlimpid: 4 existing frames are "
                                   "made again; frame 1: wet.1.exr was made differently (inputs, "
                                   "scene_hash)\n"));
}

/// A frame whose plate is missing is not kept: its provenance cannot be checked.
TEST_F(ResumeTest, AFrameWithoutItsInputIsNotKept) {
  write_plates({1, 2, 3, 4});
  said_by(words({}));
  fs::remove(folder_ / "plate.3.exr");
  expect_refused(limpid(words({"--resume", "-q"})),
                 {"frame 3: plate.3.exr: cannot be opened", "use --missing skip or hold"});
  EXPECT_EQ(resumed({"--missing", "skip"}),
            "limpid: 1 of 4 frames have no plate and are left out: 3\n"
            "limpid: 3 of 3 frames are kept\n");
}

TEST_F(ResumeTest, RendersWatersAndTruthsResumeToo) {
  fs::create_directory(folder_ / "pool");
  for (const auto& entry : fs::directory_iterator(LIMPID_DATA "/scenes")) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("pool")) fs::copy_file(entry.path(), folder_ / "pool" / name);
  }
  for (const std::string verb : {"render", "water", "truth"}) {
    const auto with = [&](const Words& more, const std::string& size = "32x18") {
      Words all{verb, "pool/pool.toml", "--size", size, "-o", verb + ".%d.exr", "--frames", "1-3"};
      all.insert(all.end(), more.begin(), more.end());
      return said_by(all);
    };
    with({});
    const std::string second = text_of(verb + ".2.exr");
    fs::remove(folder_ / (verb + ".2.exr"));
    const ino_t first = file_number(verb + ".1.exr");
    EXPECT_EQ(with({"--resume"}), "limpid: 2 of 3 frames are kept\n");
    EXPECT_TRUE(text_of(verb + ".2.exr") == second);
    std::string other = second;
    other.back() = static_cast<char>(other.back() ^ 1);
    write_text(verb + ".2.exr", other);
    EXPECT_THAT(with({"--resume", "--verify"}),
                HasSubstr("frame 2: " + verb + ".2.exr has changed"));
    EXPECT_TRUE(text_of(verb + ".2.exr") == second);
    EXPECT_EQ(file_number(verb + ".1.exr"), first);
    EXPECT_EQ(with({"--resume"}), "limpid: 3 of 3 frames are kept\n");
    EXPECT_THAT(with({"--resume"}, "32x16"), HasSubstr(" differently (inputs, scene"));
    EXPECT_THAT(with({"--resume", "--fps", "12"}), HasSubstr(" differently ("));
  }
  std::string vertices = text_of("pool/pool.bin");
  vertices[0] ^= 4;  // in the mantissa of a coordinate
  write_text("pool/pool.bin", vertices);
  EXPECT_THAT(said_by({"water", "pool/pool.toml", "--size", "32x18", "-o", "water.%d.exr",
                       "--frames", "1-3", "--fps", "12", "--resume"}),
              HasSubstr("water.1.exr was made differently (inputs, scene_hash)\n"));
}

TEST_F(ResumeTest, SkippedFramesHaveNoOutput) {
  write_plates({2, 4});
  EXPECT_EQ(said_by(words({"--missing", "skip"})),
            "limpid: 2 of 4 frames have no plate and are left out: 1, 3\n");
  EXPECT_EQ(outputs().size(), 4u);
  EXPECT_EQ(text_of("wet.1.exr"), "");
  EXPECT_THAT(said_by(words({"--missing", "skip", "-v"})),
              HasSubstr("\nlimpid: frame 3: plate.3.exr is missing\n"));
}

TEST_F(ResumeTest, HeldFramesHaveTheirOwnTime) {
  write_plates({2, 3});
  EXPECT_EQ(said_by(words({"--missing", "hold"})),
            "limpid: 2 of 4 frames have no plate and are made from other plates: 1, 4\n");
  EXPECT_THAT(said_by(words({"--missing", "hold", "-v"})),
              HasSubstr("\nlimpid: frame 1: plate.1.exr is missing: made from frame 2\n"
                        "limpid: frame 4: plate.4.exr is missing: made from frame 3\n"));
  const Words alone{"composite", "plate.3.exr",         "--scene", "scene.toml",
                    "--look",    "look.toml",           "-o",      "one.exr",
                    "--time",    "0.16666666666666666", "-q"};
  EXPECT_EQ(limpid(alone).code, 0);
  EXPECT_TRUE(same("wet.4.exr", "one.exr"));
  EXPECT_FALSE(same("wet.4.exr", "wet.3.exr"));
}

/// Plates by `limpid render`, at 24 frames per second.
TEST_F(ResumeTest, HeldPlatesThatKnowTheirTimeAreMovedOn) {
  Words words{"render",   std::string(LIMPID_DATA) + "/scenes/pool.toml",
              "--size",   "32x18",
              "-o",       "plate.%d.exr",
              "--frames", "1-3"};
  EXPECT_EQ(said_by(words), "");
  fs::remove(folder_ / "plate.2.exr");
  EXPECT_NE(said_by({"composite", "plate.%d.exr", "-o", "wet.%d.exr", "--frames", "1-3",
                     "--missing", "hold"}),
            "");
  const auto text = ExrFile::open(folder_ / "wet.2.exr").text_attribute(0, "limpid/scene");
  EXPECT_NEAR(scene_from_toml(text.value_or(""), "").scene.time, 2 / 24.0, 1e-15);
}

TEST_F(ResumeTest, WhatIsThereButDamagedIsNotMissing) {
  write_plates({1, 3, 4});
  write_text("plate.2.exr", "no picture");
  for (const std::string how : {"skip", "hold"}) {
    expect_refused(limpid(words({"--missing", how})), {"frame 2: plate.2.exr: is not an OpenEXR"});
  }
}

TEST_F(ResumeTest, RefusesWhatMakesNoSense) {
  const auto refused = [&](Words more, const Words& parts) {
    Words all{"composite", "plate.exr", "--scene", "scene.toml", "-o", "wet.%d.exr"};
    all.insert(all.end(), more.begin(), more.end());
    expect_refused(limpid(all), parts, 2);
  };
  refused({"--resume"}, {"--resume: expected --frames beside it"});
  refused({"--verify", "--frames", "1"}, {"--verify: expected --resume beside it"});
  refused({"--missing", "skip"}, {"--missing: expected --frames beside it"});
  refused({"--missing", "guess", "--frames", "1"}, {"--missing guess", "error, skip or hold"});
  refused({"--resume", "-n", "--frames", "1"}, {"--resume and -n: expected one of them"});
  refused({"--missing", "hold", "-n", "--frames", "1"}, {"--missing and -n"});
  refused({"--resume", "--frames", "1", "--preview", "p.%d.jpg"}, {"p.%d.jpg: expected a .png"});
  for (const std::string verb : {"composite", "water", "render", "truth"}) {
    EXPECT_THAT(limpid({"help", verb}).out, HasSubstr("--resume")) << verb;
  }
}

}  // namespace
}  // namespace limpid::test
