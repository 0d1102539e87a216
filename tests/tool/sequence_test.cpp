#include <cstdio>
#include <cstdlib>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <unistd.h>

#include "limpid/files/exr/exr_file.h"
#include "limpid/files/text/frame_range.h"
#include "limpid/files/text/scene_file.h"

#include "paths.h"
#include "tool/made_plate.h"
#include "tool/tool.h"

namespace limpid::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class SequenceTest : public ToolTest {
 protected:
  /// Plates of frames that differ: depths grow, some frames have NaN pixels, one frame is smaller.
  void write_plates(const std::string& pattern, const std::vector<int>& frames) const {
    for (const int frame : frames) {
      PlateOptions options;
      options.depth_code = [=](double z, double) { return z * (1 + 0.02 * frame); };
      options.broken = frame % 2 == 0;
      if (frame == 3) options.data = {8, 0, 60, 36};
      write_plate(folder_ / name_of_frame(pattern, frame), options);
    }
  }
  Words sequence(const std::string& plates, const std::string& output, const Words& more) const {
    Words words{"composite", plates, "--scene", "scene.toml", "--look", "look.toml", "-o", output};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  double time_of(const std::string& file) const {
    const auto text = ExrFile::open(folder_ / file).text_attribute(0, "limpid/scene");
    return text ? scene_from_toml(*text, file).scene.time : -1;
  }
  bool same_bytes(const std::string& a, const std::string& b) const {
    return text_of(a) != "" && text_of(a) == text_of(b);
  }
  std::vector<std::string> unfinished() const {
    std::vector<std::string> found;
    for (const std::string& name : files()) {
      if (name.starts_with(".limpid")) found.push_back(name);
    }
    return found;
  }
};

std::string exact(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", number);
  return text;
}

TEST_F(SequenceTest, GivesTheBytesOfFrameByFrame) {
  const Words all{"--aov", "all", "--preview", "wet.%d.png", "--deep", "deep.%d.exr", "-q"};
  const auto made = [&](Words words) {
    words.insert(words.end(), all.begin(), all.end());
    const Ran ran = limpid(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out + ran.err, "");
    std::vector<std::string> bytes;
    for (int frame = 1; frame <= 6; ++frame) {
      for (const std::string name : {"wet.%d.exr", "wet.%d.png", "deep.%d.exr"}) {
        bytes.push_back(text_of(name_of_frame(name, frame)));
        std::filesystem::remove(folder_ / name_of_frame(name, frame));
      }
    }
    return bytes;
  };
  write_plates("plate.%d.exr", {1, 2, 3, 4, 5, 6});
  std::vector<std::string> alone;
  for (int frame = 1; frame <= 6; ++frame) {
    // One frame is a sequence, too, but takes over no buffers of an earlier frame.
    const std::string number = std::to_string(frame);
    const std::vector<std::string> bytes =
        made(sequence("plate." + number + ".exr", "wet.%d.exr",
                      {"--frames", number, "--time", "0", "--fps", "24", "--threads", "1"}));
    const auto first = bytes.begin() + 3 * (frame - 1);
    alone.insert(alone.end(), first, first + 3);
  }
  EXPECT_EQ(std::count(alone.begin(), alone.end(), ""), 0);
  for (const std::string n : {"1", "2", "3", "16"}) {
    for (const std::string threads : {"1", "2"}) {
      const std::vector<std::string> together =
          made(sequence("plate.%d.exr", "wet.%d.exr",
                        {"--frames", "1-6", "--frames-in-flight", n, "--threads", threads}));
      EXPECT_TRUE(together == alone) << n << " in flight, threads " << threads;
    }
  }
}

/// A sequence of one frame equals composite() without --frames.
TEST_F(SequenceTest, GivesTheBytesOfASingleFrame) {
  write_plates("plate.%d.exr", {4, 5});
  EXPECT_EQ(limpid(sequence("plate.%d.exr", "wet.%d.exr", {"--frames", "4-5", "-q"})).code, 0);
  for (const std::string frame : {"4", "5"}) {
    const Words one = sequence("plate." + frame + ".exr", "one.exr",
                               {"--time", exact(std::stoi(frame) / 24.0), "-q"});
    EXPECT_EQ(limpid(one).code, 0);
    EXPECT_TRUE(same_bytes("one.exr", "wet." + frame + ".exr")) << frame;
  }
}

TEST_F(SequenceTest, NumbersMayBePaddedOrNotAndStepped) {
  write_plates("a.%d.exr", {8, 9, 10, 12});
  const Ran ran =
      limpid(sequence("a.%d.exr", "b.@@@.exr", {"--frames", "8-12x2", "--frames-in-flight", "2"}));
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, ContainsRegex("^b.008.exr: .*\nb.010.exr: .*\nb.012.exr: .*\n$"));
  EXPECT_EQ(text_of("b.009.exr"), "");
  EXPECT_EQ(limpid(sequence("a.@.exr", "c.%02d.exr", {"--frames", "12,8", "-q"})).code, 0);
  EXPECT_TRUE(same_bytes("c.08.exr", "b.008.exr"));
  EXPECT_TRUE(same_bytes("c.12.exr", "b.012.exr"));
}

TEST_F(SequenceTest, LayersScenesAndPlatesOfTheSceneHaveNumbersToo) {
  write_plates("plate.%04d.exr", {1, 2});
  write_plates("depth.%04d.exr", {1, 2});
  for (const int frame : {1, 2}) {
    write_text(name_of_frame("scene.%d.toml", frame),
               "[plates]\nshadow = \"depth.####.exr:shadow.Y\"\n" +
                   scene_toml("near = 0.1\nfar = " + std::to_string(100 + frame) + ".0\n"));
  }
  const Ran ran = limpid({"composite", "plate.#.exr", "--scene", "scene.%d.toml", "--layer",
                          "depth=depth.#.exr:depth.Z", "--look", "look.toml", "--frames", "1-2",
                          "-o", "wet.#.exr"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_FALSE(same("wet.0001.exr", "wet.0002.exr"));
  // One plate for all frames: only the waves move.
  EXPECT_EQ(limpid(sequence("plate.exr", "still.#.exr", {"--frames", "1,2", "-q"})).code, 0);
  EXPECT_FALSE(same("still.0001.exr", "still.0002.exr"));
}

TEST_F(SequenceTest, FramesHaveTheirTime) {
  write_plates("plate.%d.exr", {1, 2});
  EXPECT_EQ(limpid(sequence("plate.%d.exr", "a.%d.exr", {"--frames", "1-2", "-q"})).code, 0);
  EXPECT_EQ(time_of("a.2.exr"), 2 / 24.0);
  EXPECT_EQ(limpid(sequence("plate.%d.exr", "b.%d.exr",
                            {"--frames", "1-2", "--time", "3", "--fps", "8", "-q"}))
                .code,
            0);
  EXPECT_EQ(time_of("b.2.exr"), 3.25);
  // An output of composite is a plate with a time attribute, which is used unless an option sets
  // the time.
  const auto again = [&](const std::string& output, const Words& more) {
    Words words{"composite", "b.%d.exr",  "--layer", "depth=plate.%d.exr:depth.Z",
                "--look",    "look.toml", "-o",      output,
                "--frames",  "1-2",       "-q"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = limpid(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
  };
  again("c.%d.exr", {});
  EXPECT_EQ(time_of("c.2.exr"), 3.25);
  again("d.%d.exr", {"--fps", "16"});
  EXPECT_EQ(time_of("d.2.exr"), 2 / 16.0);
}

TEST_F(SequenceTest, AnErrorNamesTheFrameAndLeavesTheOthersWhole) {
  write_plates("plate.%04d.exr", {1, 2, 3, 5, 6, 7, 8});
  write_text("wet.0004.exr", "old");
  for (const std::string broken : {"no file", "no picture"}) {
    if (broken == "no picture") {
      std::string half = text_of("plate.0003.exr");
      write_text("plate.0004.exr", half.substr(0, half.size() / 2));
    }
    for (const std::string threads : {"1", "2"}) {
      const Ran ran = limpid(
          sequence("plate.####.exr", "wet.####.exr", {"--frames", "1-8", "--threads", threads}));
      EXPECT_EQ(ran.code, 1);
      EXPECT_THAT(ran.err, ContainsRegex("^limpid ERROR: frame 4: plate.0004.exr: [^\n]*\n$"));
      EXPECT_THAT(ran.out, ContainsRegex("^wet.0001[^\n]*\n[^\n]*wet.0002.*wet.0003"));
      EXPECT_THAT(ran.out, Not(HasSubstr("wet.0004")));
      for (const std::string done : {"1", "2", "3"}) {
        const Words one = sequence("plate.000" + done + ".exr", "one.exr",
                                   {"--time", exact(std::stoi(done) / 24.0), "-q"});
        ASSERT_EQ(limpid(one).code, 0);
        EXPECT_TRUE(same_bytes("wet.000" + done + ".exr", "one.exr"));
      }
      EXPECT_EQ(text_of("wet.0004.exr"), "old");
      EXPECT_EQ(text_of("wet.0008.exr"), "") << "more than three were in flight";
      EXPECT_EQ(unfinished(), Words{});
    }
  }
}

TEST_F(SequenceTest, RefusesWhatMakesNoSequence) {
  const auto refused = [&](const Words& more, const Words& parts, const std::string& output) {
    expect_refused(limpid(sequence("plate.exr", output, more)), parts, 2);
  };
  refused({"--frames", "1-2"}, {"wet.exr", "%04d or #", "2 frames"}, "wet.exr");
  refused({"--frames", "1-2", "--preview", "p.png"}, {"p.png", "%04d or #"}, "wet.#.exr");
  refused({"--frames", "1-2", "--frames-in-flight", "0"}, {"--frames-in-flight 0", "1 ... 64"},
          "wet.#.exr");
  refused({"--frames", "1-2", "--frames-in-flight", "65"}, {"65", "1 ... 64"}, "wet.#.exr");
  refused({"--frames-in-flight", "2"}, {"--frames-in-flight", "expected --frames"}, "wet.exr");
  refused({"--fps", "12"}, {"--fps", "expected --frames"}, "wet.exr");
  refused({"--frames", "1-2", "--fps", "0"}, {"--fps 0", "1e-06 ... 1e+06"}, "wet.#.exr");
  refused({"--frames", "one"}, {"'one'", "1-100x33"}, "wet.#.exr");
  const Ran one = limpid(sequence("plate.exr", "wet.exr", {"--frames", "7", "-q"}));
  EXPECT_EQ(one.code, 0) << one.err;
  EXPECT_NE(text_of("wet.exr"), "");
}

TEST_F(SequenceTest, ThePlanIsThatOfTheFirstFrame) {
  write_plates("plate.%d.exr", {5});
  const Words words{"plate.%d.exr", "--scene",  "scene.toml", "--look",
                    "look.toml",    "--frames", "5-9"};
  Words plan{"plan"}, dry{"composite", "-n"};
  plan.insert(plan.end(), words.begin(), words.end());
  dry.insert(dry.end(), words.begin(), words.end());
  const Ran planned = limpid(plan);
  EXPECT_EQ(planned.code, 0) << planned.err;
  EXPECT_THAT(planned.out, HasSubstr("refraction"));
  EXPECT_EQ(limpid(dry).out, planned.out);
}

TEST_F(SequenceTest, RenderedSequencesAreThoseOfTheirFrames) {
  const std::string pool = LIMPID_DATA "/scenes/pool.toml";
  const auto made = [&](const std::string& verb, const std::string& output, const Words& more) {
    Words words{verb, pool, "--size", "48x27", "-o", output, "-q"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = limpid(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out + ran.err, "");
  };
  for (const std::string verb : {"water", "render"}) {
    made(verb, verb + ".@.exr", {"--frames", "1-4", "--fps", "2", "--frames-in-flight", "2"});
    for (int frame = 1; frame <= 4; ++frame) {
      made(verb, "one.exr", {"--time", exact(frame / 2.0)});
      EXPECT_TRUE(same_bytes("one.exr", verb + "." + std::to_string(frame) + ".exr"))
          << verb << " " << frame;
    }
  }
  // A rendered sequence composites without options; its EXR files have the times.
  const Ran ran = limpid({"composite", "render.@.exr", "-o", "wet.@.exr", "--frames", "1-4"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(time_of("wet.3.exr"), 1.5);
}

TEST_F(SequenceTest, HelpTellsOfIt) {
  for (const std::string verb : {"composite", "water", "render", "plan"}) {
    const Ran ran = limpid({"help", verb});
    for (const char* option : {"--frames RANGE", "--fps N", "--frames-in-flight N"}) {
      EXPECT_THAT(ran.out, HasSubstr(option)) << verb;
    }
  }
}

/// Runs a command with a terminal for stdout and stderr; returns the printed text.
std::string on_terminal(const std::filesystem::path& folder, Words command) {
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  EXPECT_TRUE(terminal >= 0 && ::grantpt(terminal) == 0 && ::unlockpt(terminal) == 0);
  const std::string other_end = ::ptsname(terminal);
  const int held = ::open(other_end.c_str(), O_RDWR | O_NOCTTY);  // keeps the written text readable
  Words words{"/bin/sh", "-c", "exec \"$@\" > \"$0\" 2>&1", other_end};
  words.insert(words.end(), command.begin(), command.end());
  EXPECT_EQ(run(folder, words).code, 0);
  std::string shown;
  pollfd ready{terminal, POLLIN, 0};
  char bytes[4096];
  while (::poll(&ready, 1, 0) == 1 && (ready.revents & POLLIN) != 0) {
    const ssize_t count = ::read(terminal, bytes, sizeof bytes);
    if (count <= 0) break;
    shown.append(bytes, static_cast<std::size_t>(count));
  }
  ::close(held);
  ::close(terminal);
  return shown;
}

TEST_F(SequenceTest, ATerminalShowsOneLineThatIsKeptUpToDate) {
  write_plates("plate.%d.exr", {1, 3, 5});
  Words words{LIMPID_TOOL};
  for (const std::string& word :
       sequence("plate.%d.exr", "wet.%d.exr", {"--frames", "1-5x2", "--time", "0"})) {
    words.push_back(word);
  }
  const std::string shown = on_terminal(folder_, words);
  EXPECT_THAT(shown, ContainsRegex("^1/3 frames, [0-9.e+]+ a second, [0-9:]+ left\r\033\\[K2/3"));
  EXPECT_THAT(shown,
              ContainsRegex("\r\033\\[K3/3 frames, [0-9.e+]+ a second, [0-9:]+ in all\r\n$"));
  EXPECT_THAT(shown, Not(HasSubstr("wet.")));
  words.push_back("-q");
  EXPECT_EQ(on_terminal(folder_, words), "");
}

}  // namespace
}  // namespace limpid::test
