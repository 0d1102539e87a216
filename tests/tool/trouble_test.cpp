#include <csignal>
#include <map>

#include <gmock/gmock.h>

#include "limpid/core/error.h"
#include "limpid/files/text/frame_range.h"
#include "limpid/files/text/look_file.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/job/sequence.h"

#include "paths.h"
#include "tool/made_plate.h"
#include "tool/new_files.h"
#include "tool/own_mounts.h"
#include "tool/running.h"
#include "tool/tool.h"

/// A sequence under faults of the system: finished outputs are whole, old files stay, and one
/// sentence names the fault.

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr int kFrames = 6;

/// With -v four frames print more than the pipe of Running holds: their outputs have long names.
const std::string kLong = "out/" + std::string(240, 'x') + "/" + std::string(240, 'y');

class TroubleTest : public ToolTest {
 protected:
  TroubleTest() {
    for (int frame = 1; frame <= kFrames; ++frame) {
      PlateOptions options;
      options.depth_code = [=](double z, double) { return z * (1 + 0.02 * frame); };
      // The third file is the first large one.
      if (frame < 3) options.data = {8, 0, 60, 12};
      write_plate(folder_ / name_of_frame("plate.%d.exr", frame), options);
    }
    fs::create_directory(folder_ / "out");
  }

  Words words(const std::string& folder, const Words& more = {}) const {
    Words all{LIMPID_TOOL,
              "composite",
              "plate.%d.exr",
              "--scene",
              "scene.toml",
              "--look",
              "look.toml",
              "-o",
              folder + "/wet.%d.exr",
              "--deep",
              folder + "/deep.%d.exr",
              "--float",
              "--compression",
              "none",
              "--frames",
              "1-6"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  std::map<std::string, std::string> in(const std::string& folder) const {
    std::map<std::string, std::string> all;
    for (const std::string& name : files()) {
      if (name.starts_with(folder + "/")) all[name.substr(folder.size() + 1)] = text_of(name);
    }
    return all;
  }
  /// The files of a run without a fault.
  std::map<std::string, std::string> undisturbed() const {
    fs::create_directory(folder_ / "good");
    EXPECT_EQ(run(folder_, words("good", {"-q"})).code, 0);
    const auto all = in("good");
    EXPECT_EQ(all.size(), std::size_t{2 * kFrames});
    return all;
  }
  /// Every file is a correct output or still holds "old", and the first frames are complete.
  void expect_whole(const std::string& folder, int first_frames) const {
    const auto good = undisturbed();
    const auto found = in(folder);
    for (const auto& [name, bytes] : found) {
      const bool whole = good.contains(name) && bytes == good.at(name);
      EXPECT_TRUE(whole || bytes == "old") << name;
    }
    for (int frame = 1; frame <= first_frames; ++frame) {
      for (const char* pattern : {"wet.%d.exr", "deep.%d.exr"}) {
        const std::string name = name_of_frame(pattern, frame);
        EXPECT_TRUE(found.contains(name) && found.at(name) != "old") << name;
      }
    }
  }

  /// The same frames by the library, one frame after the other.
  CompositeJob job(int frame) const {
    CompositeJob job;
    job.scene = load_scene(folder_ / "scene.toml");
    job.plate.files = {folder_ / name_of_frame("plate.%d.exr", frame)};
    job.look = load_look(folder_ / "look.toml");
    job.time.fallback = frame / 24.0;
    job.output.picture = folder_ / name_of_frame("out/wet.%d.exr", frame);
    job.output.deep = folder_ / name_of_frame("out/deep.%d.exr", frame);
    job.output.compression = "none";
    job.output.store_float = true;
    return job;
  }
  /// The Error of a sequence in which `event` happens after frame 3.
  template <class Event>
  Error error_after_third(const Event& event) const {
    const auto executor = make_executor(1);
    const auto on_frame = [&](const SequenceProgress& at, const CompositeReport&) {
      if (at.frame == 3) event();
    };
    try {
      composite_sequence(
          {{1, 2, 3, 4, 5, 6}, 1}, [&](int frame) { return job(frame); }, on_frame, *executor);
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << "no error";
    return Error("");
  }
};

TEST_F(TroubleTest, AFileSizeLimitInTheMiddle) {
  write_text("out/wet.3.exr", "old");
  Words limited{"/bin/sh", "-c", "ulimit -f 72; exec \"$@\"", "sh"};
  for (const std::string& word : words("out", {"--frames-in-flight", "1"})) limited.push_back(word);
  const Ran ran = run(folder_, limited);
  expect_refused(ran, {"frame 3: out/", ".3.exr: cannot be written (file too large)"}, 75);
  expect_whole("out", 2);
  EXPECT_EQ(text_of("out/wet.3.exr"), "old");
}

/// The preview, which is small, is written first, and appears with the rest.
TEST_F(TroubleTest, AFrameThatFailsLeavesNoneOfItsFiles) {
  Words limited{"/bin/sh", "-c", "ulimit -f 72; exec \"$@\"", "sh"};
  for (const std::string& word :
       words("out", {"--frames-in-flight", "1", "--preview", "out/wet.%d.png"})) {
    limited.push_back(word);
  }
  EXPECT_EQ(run(folder_, limited).code, 75);
  const auto found = in("out");
  EXPECT_EQ(found.size(), 6u);
  EXPECT_TRUE(found.contains("wet.2.png"));
  EXPECT_FALSE(found.contains("wet.3.png"));
}

/// On a file system of a few hundred kilobytes, if the test may mount one.
TEST_F(TroubleTest, AFullDisk) {
  const std::string script =
      "mount -t tmpfs -o size=240k limpid out || exit 99; echo -n old > out/wet.4.exr; \"$@\"; "
      "code=$?; cp -a out copy; exit $code";
  const Words full = with_own_mounts(script, words("out"));
  if (full.empty()) {
    GTEST_SKIP() << "no disk of our own can be mounted here, as root or otherwise: of a failed "
                    "write only AFileSizeLimitInTheMiddle is checked";
  }
  const Ran ran = run(folder_, full);
  expect_refused(ran, {"cannot be written (no space left on device)"}, 75);
  expect_whole("copy", 2);
  EXPECT_THAT(text_of("copy/wet.4.exr"), AnyOf("old", undisturbed().at("wet.4.exr")));
}

TEST_F(TroubleTest, AReadOnlyFolder) {
  write_text("out/wet.1.exr", "old");
  const std::string script =
      "mount --bind out out && mount -o remount,ro,bind out || exit 99; exec \"$@\"";
  const Words locked = with_own_mounts(script, words("out"));
  if (locked.empty()) {
    GTEST_SKIP() << "no folder can be mounted read-only here, as root or otherwise: only "
                    "AtomicFile.NamesTheFolderThatCannotBeWritten checks one";
  }
  const Ran ran = run(folder_, locked);
  expect_refused(ran, {"frame 1: out/wet.1.exr: the folder 'out' cannot be written to (read-only"});
  EXPECT_EQ(in("out").size(), 1u);
  EXPECT_EQ(text_of("out/wet.1.exr"), "old");
}

/// Leftover temporary files of a killed process are removed where file locks are reliable. A ramfs
/// represents the other file systems, because it is not on the list of local file systems.
TEST_F(TroubleTest, AFolderThatOthersMayShare) {
  for (const std::string kind : {"tmpfs", "ramfs"}) {
    const std::string script = "mount -t " + kind +
                               " limpid out || exit 99; touch out/.limpid-7-0.exr; \"$@\"; "
                               "code=$?; cp -a out " +
                               kind + "; exit $code";
    const Words mounted = with_own_mounts(script, words("out", {"-q"}));
    if (mounted.empty()) {
      GTEST_SKIP() << "nothing can be mounted here, as root or otherwise: only "
                      "LocalFiles.AreThoseThatAreKnown checks where files are locked";
    }
    const Ran ran = run(folder_, mounted);
    EXPECT_EQ(ran.code, 0) << ran.err;
    auto found = in(kind);
    EXPECT_EQ(found.erase(".limpid-7-0.exr"), kind == "ramfs" ? 1u : 0u) << kind;
    EXPECT_TRUE(found == undisturbed()) << kind;
  }
}

TEST_F(TroubleTest, AFolderThatGoes) {
  const Error error = error_after_third([&] { fs::rename(folder_ / "out", folder_ / "kept"); });
  EXPECT_THAT(error.what(), HasSubstr("frame 4: "));
  EXPECT_THAT(error.what(), HasSubstr("out' cannot be written to (no such file or directory)"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  expect_whole("kept", 3);
  EXPECT_EQ(in("kept").size(), 6u);
}

TEST_F(TroubleTest, AFolderUnderThePicturesName) {
  const Error error = error_after_third([&] { fs::create_directory(folder_ / "out/wet.5.exr"); });
  EXPECT_THAT(error.what(),
              HasSubstr("wet.5.exr: exists and is not a file: expected a file to replace"));
  fs::remove(folder_ / "out/wet.5.exr");
  expect_whole("out", 4);
  EXPECT_EQ(in("out").size(), 8u);
}

TEST_F(TroubleTest, APlateThatGoes) {
  const Error error = error_after_third([&] { fs::remove(folder_ / "plate.5.exr"); });
  EXPECT_THAT(error.what(), HasSubstr("plate.5.exr: cannot be opened (no such file or directory)"));
  fs::copy_file(folder_ / "plate.6.exr", folder_ / "plate.5.exr");
  expect_whole("out", 4);
  EXPECT_EQ(in("out").size(), 8u);
}

/// Reads until that many frames are reported; the next frames are in progress then.
void read_frames(Running& running, int count) {
  while (count > 0) {
    const auto line = running.line();
    ASSERT_TRUE(line) << "it ended, " << count << " frames too early";
    if (line->starts_with(kLong + "/wet.")) --count;
  }
}

/// Waits until that many temporary files exist.
void await_files(NewFiles& begun, const Running& running, int count) {
  while (count > 0) {
    const auto name = begun.next(running);
    ASSERT_TRUE(name) << "it ended, " << count << " files too early";
    if (name->starts_with(".limpid-")) --count;
  }
}

class TroubleSignal : public TroubleTest, public ::testing::WithParamInterface<int> {};

/// The test reads only to the second frame, so that the sequence cannot end by itself.
TEST_P(TroubleSignal, EndsASequenceCleanly) {
  fs::create_directories(folder_ / kLong);
  write_text(kLong + "/wet.6.exr", "old");
  Running running(folder_, words(kLong, {"-v"}));
  ASSERT_NO_FATAL_FAILURE(read_frames(running, 2));
  running.send(GetParam());
  EXPECT_EQ(running.wait(), -GetParam());
  expect_whole(kLong, 2);
  EXPECT_EQ(text_of(kLong + "/wet.6.exr"), "old");
}

INSTANTIATE_TEST_SUITE_P(All, TroubleSignal, ::testing::Values(SIGINT, SIGTERM, SIGHUP));

/// The progress of a sequence when it is killed: reported frames, or temporary files.
struct Moment {
  int frames, files;
};
void PrintTo(const Moment& moment, std::ostream* out) {
  *out << moment.frames << " frames, " << moment.files << " files";
}

class TroubleKill : public TroubleTest, public ::testing::WithParamInterface<Moment> {};

/// tools/check_kill kills a sequence at random moments.
TEST_P(TroubleKill, LeavesWholeFramesAndResumes) {
  fs::create_directories(folder_ / kLong);
  NewFiles begun(folder_ / kLong);
  Running running(folder_, words(kLong, {"-v"}));
  ASSERT_NO_FATAL_FAILURE(read_frames(running, GetParam().frames));
  ASSERT_NO_FATAL_FAILURE(await_files(begun, running, GetParam().files));
  running.send(SIGKILL);
  EXPECT_EQ(running.wait(), -SIGKILL);

  // Files with a final name are whole; the next run removes all other files and makes the missing
  // frames.
  const auto good = undisturbed();
  int whole = 0;
  for (const auto& [name, bytes] : in(kLong)) {
    if (name.starts_with(".limpid-")) continue;
    ++whole;
    EXPECT_TRUE(good.contains(name) && bytes == good.at(name)) << name;
  }
  EXPECT_GE(whole, 2 * GetParam().frames);
  EXPECT_LT(whole, 2 * kFrames);
  const Ran ran = run(folder_, words(kLong, {"--resume"}));
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, ::testing::MatchesRegex("limpid: [0-5] of 6 frames are kept\n"));
  EXPECT_TRUE(in(kLong) == good);
}

INSTANTIATE_TEST_SUITE_P(All, TroubleKill,
                         ::testing::Values(Moment{1, 0}, Moment{2, 0}, Moment{0, 1}, Moment{0, 5}));

TEST_F(TroubleTest, AReaderThatGoesStopsNothing) {
  Running running(folder_, words("out", {"-v"}));
  EXPECT_TRUE(running.line());
  running.close_stdout();
  EXPECT_EQ(running.wait(), -SIGPIPE);
  expect_whole("out", kFrames);
}

/// Printed text must not go into files that have the descriptors of the closed streams.
TEST_F(TroubleTest, ClosedStreams) {
  Words closed{"/bin/sh", "-c", "exec \"$@\" <&- >&- 2>&-", "sh"};
  for (const std::string& word : words("out", {"-v"})) closed.push_back(word);
  EXPECT_EQ(run(folder_, closed).code, 0);
  expect_whole("out", kFrames);
  fs::rename(folder_ / "plate.4.exr", folder_ / "elsewhere.exr");
  EXPECT_EQ(run(folder_, closed).code, 1);
  fs::rename(folder_ / "elsewhere.exr", folder_ / "plate.4.exr");
  expect_whole("out", kFrames);
}

TEST_F(TroubleTest, AFullDiskUnderStdout) {
  Words full{"/bin/sh", "-c", "exec \"$@\" > /dev/full", "sh"};
  for (const std::string& word : words("out")) full.push_back(word);
  expect_refused(run(folder_, full), {"standard output: cannot be written to"}, 75);
  expect_whole("out", kFrames);
  expect_refused(run(folder_, {"/bin/sh", "-c", "exec \"$0\" operators > /dev/full", LIMPID_TOOL}),
                 {"standard output: cannot be written to"}, 75);
}

}  // namespace
}  // namespace limpid::test
