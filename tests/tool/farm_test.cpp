#include <csignal>
#include <fstream>
#include <map>

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "limpid/files/text/frame_range.h"

#include "paths.h"
#include "tool/made_plate.h"
#include "tool/running.h"
#include "tool/tool.h"

/// limpid farm, with tasks on this machine and with a Slurm made of scripts; tools/check_farm tests
/// it with a real Slurm.

namespace limpid::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kWhole = " frames are complete, by the hashes in their headers\n";

class FarmTest : public ToolTest {
 protected:
  FarmTest() {
    // sbatch prints the job numbers 11, 12 ...; squeue prints the text of the file `queue`.
    slurm("sbatch",
          "echo \"$*\" >>submitted; [ ! -e refuse-\"$(wc -l <submitted)\" ] || "
          "{ echo 'sbatch: error: no such partition' >&2; exit 1; }; "
          "echo $((10 + $(wc -l <submitted)))");
    slurm("squeue",
          "[ ! -e down ] || { echo 'slurm_load_jobs error: Unable to contact slurm "
          "controller (connect failure)' >&2; exit 1; }; cat queue 2>/dev/null; exit 0");
    slurm("sacct", "echo 'Slurm accounting storage is disabled' >&2; exit 1");
    slurm("scancel", "echo \"$*\" >>cancelled; rm -f queue");
    slurm("scontrol", "echo 'MaxArraySize            = 5'");
    fs::create_directory(folder_ / "it's wet");
  }
  void slurm(const std::string& program, const std::string& script) const {
    fs::create_directory(folder_ / "bin");
    write_text("bin/" + program, "#!/bin/bash\n" + script + "\n");
    fs::permissions(folder_ / "bin" / program, fs::perms::owner_all);
  }
  void write_plates(int last) const {
    for (int frame = 1; frame <= last; ++frame) {
      PlateOptions options;
      options.depth_code = [=](double z, double) { return z * (1 + 0.02 * frame); };
      write_plate(folder_ / name_of_frame("plate.%d.exr", frame), options);
    }
  }
  /// Damages the pixels of a file and leaves its header whole: the checksum of a zlib stream fails.
  void break_plate(int frame) const {
    const std::string name = name_of_frame("plate.%d.exr", frame);
    oiiotool({name, "--compression", "zips", "-o", name});
    std::string bytes = text_of(name);
    bytes.replace(bytes.size() / 2, 512, 512, '\0');
    write_text(name, bytes);
  }
  static Words command(const std::string& into, const std::string& frames, const Words& more = {}) {
    Words words{"composite", "plate.%d.exr", "--scene",   "scene.toml",
                "--look",    "look.toml",    "-o",        into + "/wet.%d.exr",
                "--frames",  frames,         "--preview", into + "/wet.%d.png"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// limpid farm WORDS.
  Ran farm(const Words& words) const {
    Words all{"/usr/bin/env", "PATH=" + (folder_ / "bin").string() + ":/usr/bin:/bin", LIMPID_TOOL,
              "farm"};
    all.insert(all.end(), words.begin(), words.end());
    return run(folder_, all);
  }
  /// limpid farm OPTIONS -- composite ... --frames FRAMES MORE.
  Ran farm(Words options, const std::string& frames, const Words& more = {}) const {
    options.push_back("--");
    for (const std::string& word : command("it's wet", frames, more)) options.push_back(word);
    return farm(options);
  }
  std::map<std::string, std::string> outputs(const std::string& folder) const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_ / folder)) {
      if (!entry.is_regular_file()) continue;
      const std::string name = entry.path().filename().string();
      all[name] = text_of(folder + "/" + name);
    }
    return all;
  }
  std::string failed(int frame) const {
    return text_of("it's wet/wet.farm/failed/" + std::to_string(frame) + ".txt");
  }
};

TEST_F(FarmTest, TasksHereGiveTheBytesOfOneProcess) {
  write_plates(7);
  fs::create_directory(folder_ / "one");
  ASSERT_EQ(limpid(command("one", "1-7x2")).code, 0);
  const Ran ran = farm({"--local", "2", "--chunk", "3"}, "1-7x2");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out, "4 of 4" + std::string(kWhole));
  EXPECT_THAT(ran.err, HasSubstr("limpid: 4 of 4 frames are done\n"));
  EXPECT_EQ(text_of("it's wet/wet.farm/chunks.txt"), "1,3,5\n7\n");
  EXPECT_EQ(text_of("it's wet/wet.farm/summary.txt"), ran.out);
  EXPECT_TRUE(outputs("it's wet") == outputs("one"));
  EXPECT_EQ(outputs("one").size(), 8u);
  const Ran status = farm({"status", "it's wet/wet.farm"});
  EXPECT_EQ(status.code, 0);
  EXPECT_EQ(status.out, "4 of 4 frames are done\n");
  EXPECT_EQ(farm({"--local", "2", "--chunk", "3"}, "1-7x2").err,
            "limpid: 4 of 4 frames are kept\n");
}

TEST_F(FarmTest, AFrameIsMadeFirstToSeeHowLongATaskIs) {
  write_plates(3);
  const Ran ran = farm({"--local", "1"}, "1-3");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("limpid: frame 1 took "));
  EXPECT_THAT(ran.err, HasSubstr(" MB: 2 frames per task\n"));
  EXPECT_EQ(text_of("it's wet/wet.farm/chunks.txt"), "2,3\n");
  EXPECT_THAT(text_of("it's wet/wet.farm/task.sh"),
              AllOf(HasSubstr("#SBATCH --mem="), HasSubstr("#SBATCH --time=6\n")));
}

TEST_F(FarmTest, AFrameThatFailsIsNamedAndTheOthersAreMade) {
  write_plates(5);
  break_plate(2);
  const std::string says = limpid(command("it's wet", "2")).err;
  ASSERT_THAT(says, StartsWith("limpid ERROR: frame 2: "));
  const std::string sentence = says.substr(std::string("limpid ERROR: ").size());
  const Ran ran = farm({"--local", "1", "--chunk", "3"}, "1-5");
  EXPECT_EQ(ran.code, 1);
  EXPECT_EQ(ran.out, "4 of 5" + std::string(kWhole) + sentence);
  const Ran status = farm({"status", "it's wet/wet.farm"});
  EXPECT_EQ(status.code, 1);
  EXPECT_EQ(status.out, "4 of 5 frames are done\nno task waits or runs\n" + sentence);
  // After the repair only that frame is missing.
  write_plates(5);
  EXPECT_EQ(farm({"--local", "1", "--chunk", "3"}, "1-5").code, 0);
  EXPECT_EQ(text_of("it's wet/wet.farm/chunks.txt"), "2\n");
  EXPECT_FALSE(fs::exists(folder_ / "it's wet/wet.farm/failed/2.txt"));
}

TEST_F(FarmTest, AnotherLookMakesAllFramesAgain) {
  write_plates(2);
  ASSERT_EQ(farm({"--local", "1", "--chunk", "2"}, "1-2").code, 0);
  const Ran dry = farm({"--chunk", "2"}, "1-2", {"--set", "depth_fog.density=0.3"});
  EXPECT_EQ(dry.code, 0) << dry.err;
  // Both pictures exist, but were made by the earlier run.
  EXPECT_THAT(farm({"status", "it's wet/wet.farm"}).out, StartsWith("0 of 2 frames are done\n"));
}

TEST_F(FarmTest, NothingIsSubmittedWhenAnInputIsWrong) {
  write_plates(4);
  fs::remove(folder_ / "plate.3.exr");
  expect_refused(farm({}, "1-4"), {"frame 3: plate.3.exr: cannot be opened"});
  fs::remove(folder_ / "plate.4.exr");
  expect_refused(farm({}, "1-4"), {"frame 3: ", "(and errors in 1 more frame: 4)"});
  expect_refused(farm({}, "1-2", {"--set", "depth_fog.nothing=1"}), {"nothing"}, 2);
  expect_refused(farm({}, "1-2", {"--layer", "depth=nothing.Z"}), {"frame 1: ", "nothing.Z"});
  write_plates(4);
  fs::remove(folder_ / "waves.exr");
  expect_refused(farm({}, "1-2"), {"frame 1: ", "waves.exr"});
  EXPECT_FALSE(fs::exists(folder_ / "submitted"));
  EXPECT_FALSE(fs::exists(folder_ / "it's wet/wet.farm"));
}

TEST_F(FarmTest, CommandsThatCannotBeCutAreRefused) {
  write_plates(2);
  expect_refused(farm({}), {"expected -- and a command after it"}, 2);
  expect_refused(farm({"--", "inspect", "plate.1.exr"}), {"expected composite, water or truth"}, 2);
  expect_refused(farm({"--", "composite", "plate.1.exr", "-o", "wet.exr"}), {"expected --frames"},
                 2);
  expect_refused(farm({"--", "compsite"}), {"did you mean 'composite'"}, 2);
  expect_refused(farm({}, "1-2", {"--missing", "hold"}), {"--missing hold: expected error or skip"},
                 2);
  expect_refused(farm({}, "1-2", {"-n"}), {"--dry-run"}, 2);
  expect_refused(farm({}, "1-2", {"--resume", "--verify"}), {"--verify: expected none"}, 2);
  expect_refused(farm({"--sbatch", "--comment=a b"}, "1-2"), {"--sbatch --comment=a b"}, 2);
  expect_refused(farm({"--local", "1", "--sbatch=--partition=x"}, "1-2"), {"--local"}, 2);
  expect_refused(farm({"--chunk", "0"}, "1-2"), {"--chunk 0"}, 2);
  expect_refused(farm({"--dry-run"}, "1-2"), {"--dry-run: expected --chunk N"}, 2);
  expect_refused(farm({"stats", "wet.farm"}), {"did you mean 'status'"}, 2);
  expect_refused(farm({"status"}), {"expected one folder of a farm"}, 2);
  expect_refused(farm({"status", "it's wet"}), {"it's wet: not a farm"});
  EXPECT_THAT(outputs("it's wet"), IsEmpty());
}

TEST_F(FarmTest, ADryRunPrintsTheScriptsAndDoesNothing) {
  write_plates(4);
  const Ran ran = farm({"--dry-run", "--chunk", "3"}, "1-4", {"--threads", "2"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, AllOf(HasSubstr("wet.farm/chunks.txt\n1,2,3\n4\n"),
                             HasSubstr("wet.farm/task.sh\n#!/bin/bash\n"),
                             HasSubstr("#SBATCH --array=1-2\n#SBATCH --cpus-per-task=2\n"),
                             HasSubstr("wet.farm/verify.sh\n#!/bin/bash\n"),
                             HasSubstr(" -o 'it'\\''s wet/wet.%d.exr' --preview ")));
  EXPECT_FALSE(fs::exists(folder_ / "it's wet/wet.farm"));
  EXPECT_FALSE(fs::exists(folder_ / "submitted"));
}

TEST_F(FarmTest, TasksAndALastJobAreSubmitted) {
  write_plates(4);
  const Ran ran = farm({"--chunk", "2", "--sbatch=--partition=render", "--time-limit", "9"}, "1-4");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, StartsWith("job 11: 4 frames in 2 tasks; limpid farm watch "));
  const std::string farm_folder = (fs::canonical(folder_) / "it's wet/wet.farm").string();
  EXPECT_EQ(text_of("submitted"), "--parsable " + farm_folder + "/task.sh\n" +
                                      "--parsable --dependency=afterany:11 " + farm_folder +
                                      "/verify.sh\n");
  for (const char* script : {"task.sh", "verify.sh"}) {
    const std::string text = text_of(std::string("it's wet/wet.farm/") + script);
    EXPECT_THAT(text, HasSubstr("#SBATCH --partition=render\n")) << script;
    EXPECT_THAT(text, HasSubstr("#SBATCH --time=9\n")) << script;
  }
  EXPECT_FALSE(fs::exists(folder_ / "it's wet/wet.farm/lock"));
}

TEST_F(FarmTest, ThatOfAJobWhichIsAtWorkIsNotSubmittedAgain) {
  write_plates(4);
  ASSERT_EQ(farm({"--chunk", "2"}, "1-4").code, 0);
  write_text("queue",
             "11|1|RUNNING|None|n1\n11|2|PENDING|Resources|\n12|N/A|PENDING|Dependency|\n");
  expect_refused(farm({"--chunk", "2"}, "1-4"),
                 {"its job 11 makes these frames", "limpid farm cancel"});
  expect_refused(farm({"--local", "2"}, "1-4"), {"its job 11 makes these frames"});
  const Ran status = farm({"status", "it's wet/wet.farm"});
  EXPECT_EQ(status.code, 0);
  EXPECT_EQ(status.out, "0 of 4 frames are done\n1 tasks run, 1 wait (Resources)\n");
  write_text("down", "");
  expect_refused(farm({"--chunk", "2"}, "1-4"), {"the state of its job 11 is unknown"}, 75);
  EXPECT_EQ(farm({"status", "it's wet/wet.farm"}).code, 75);
  fs::remove(folder_ / "down");
  const Ran cancelled = farm({"cancel", "it's wet/wet.farm"});
  EXPECT_EQ(cancelled.code, 0);
  EXPECT_EQ(text_of("cancelled"), "11 12\n");
  EXPECT_THAT(cancelled.out, HasSubstr("no task waits or runs"));
  EXPECT_THAT(farm({"--chunk", "2", "-q"}, "1-4").out, "13\n");
}

TEST_F(FarmTest, TasksWithoutTheirLastJobAreTakenBack) {
  write_plates(2);
  write_text("refuse-2", "");
  expect_refused(farm({"--chunk", "2", "-q"}, "1-2"), {"sbatch: sbatch: error: no such partition"});
  EXPECT_EQ(text_of("cancelled"), "11\n");
  // The next farm starts: no lock is left.
  EXPECT_EQ(farm({"--chunk", "2", "-q"}, "1-2").out, "13\n");
}

TEST_F(FarmTest, ThereAreNoMoreTasksThanSlurmTakes) {
  write_plates(6);
  expect_refused(farm({"--chunk", "1", "-q"}, "1-6"), {"6 tasks, expected at most 4"}, 2);
  EXPECT_EQ(farm({"--chunk", "2", "-q"}, "1-6").code, 0);
}

TEST_F(FarmTest, WithoutASlurmNothingIsBegun) {
  write_plates(2);
  slurm("scontrol",
        "echo 'slurm_load_ctl_conf error: Unable to contact slurm controller (connect "
        "failure)' >&2; exit 1");
  expect_refused(farm({}, "1-2"),
                 {"Slurm does not answer: scontrol: slurm_load_ctl_conf error", "--local N"}, 75);
  EXPECT_THAT(outputs("it's wet"), IsEmpty());
  EXPECT_FALSE(fs::exists(folder_ / "it's wet/wet.farm"));
}

/// A stand-in for bash tells by a pipe when it has begun; the pipe hangs up when all tasks ended.
TEST_F(FarmTest, ASignalEndsTheTasksHere) {
  write_plates(2);
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  slurm("bash", "exec 9>pipe; echo begun >&9; sleep 1000; :");
  Words words{"/usr/bin/env", "PATH=" + (folder_ / "bin").string() + ":/usr/bin:/bin",
              LIMPID_TOOL,    "farm",
              "--local",      "1",
              "--chunk",      "2",
              "-q",           "--"};
  for (const std::string& word : command("it's wet", "1-2")) words.push_back(word);
  Running running(folder_, words);
  std::ifstream pipe(folder_ / "pipe");
  std::string line;
  ASSERT_TRUE(std::getline(pipe, line));
  running.send(SIGTERM);
  EXPECT_EQ(running.wait(), -SIGTERM);
  EXPECT_FALSE(std::getline(pipe, line));
  // The lock of the ended farm is taken over.
  slurm("bash", "exec /bin/bash \"$@\"");
  EXPECT_EQ(farm({"--local", "1", "--chunk", "2"}, "1-2").code, 0);
}

TEST_F(FarmTest, FramesOfARenderedSceneAreFarmedLikewise) {
  const std::string pool = LIMPID_DATA "/scenes/pool.toml";
  const auto words = [&](const std::string& verb, const std::string& output, const Words& more) {
    Words all{verb, pool, "--size", "32x18", "--frames", "1-2", "-o", output};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  for (const auto& [verb, more] :
       {std::pair<std::string, Words>{"water", {}}, {"truth", {"--light", "once"}}}) {
    ASSERT_EQ(limpid(words(verb, verb + ".one.%d.exr", more)).code, 0) << verb;
    Words all{"--local", "2", "--chunk", "1", "--"};
    for (const std::string& word : words(verb, verb + ".farm.%d.exr", more)) all.push_back(word);
    const Ran ran = farm(all);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out.substr(ran.out.find("2 of 2")), "2 of 2" + std::string(kWhole));
    for (const char* frame : {"1", "2"}) {
      EXPECT_TRUE(text_of(verb + ".one." + frame + ".exr") ==
                  text_of(verb + ".farm." + frame + ".exr"));
    }
  }
}

}  // namespace
}  // namespace limpid::test
