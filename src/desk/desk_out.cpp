// Results of the desk: saved looks, and command lines.
#include <set>
#include <system_error>

#include "limpid/job/job_files.h"

#include "core/shell_words.h"
#include "core/toml_text.h"
#include "desk/desk.h"
#include "desk/saved_look.h"
#include "files/atomic_file.h"
#include "job/composite_inputs.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

/// Throws Error for a name that a look file of the folder cannot have.
void expect_file_name(const std::string& name) {
  const fs::path path(name);
  const bool alone = path.filename() == path && path.has_stem() && name.front() != '.';
  const bool plain = name.find_first_of(std::string_view("\0\n\r", 3)) == std::string::npos;
  if (alone && plain && path.extension() == ".toml") return;
  throw Error("name = '" + name +
              "': expected the name of a file that ends in .toml, without a folder");
}

/// The inputs of the pictures of all frames; for frames with errors, as far as they are known.
std::vector<fs::path> inputs_of(const DeskOptions& options) {
  std::set<fs::path> inputs;
  const auto add = [&](std::optional<int> frame) {
    try {
      const JobFiles files = files_of(options.job_of(frame));
      inputs.insert(files.inputs.begin(), files.inputs.end());
    } catch (const Error&) {
      // Reported when the frame is shown.
    }
  };
  if (options.frames.empty()) add(std::nullopt);
  for (const int frame : options.frames) add(frame);
  for (const DeskLook& look : options.looks) {
    inputs.insert(look.look.file);
    inputs.insert(look.look.bases.begin(), look.look.bases.end());
  }
  return {inputs.begin(), inputs.end()};
}

}  // namespace

fs::path Desk::save(const DeskChoice& choice, const std::string& name, bool replace) {
  expect_file_name(name);
  const fs::path path = fs::absolute(options_.folder / name).lexically_normal();
  const Look look = look_of(choice);
  look.validate();
  const std::string text = saved_look(look, look_named(choice.look), options_.folder);
  const std::lock_guard lock(mutex_);
  std::error_code ignored;
  const fs::file_status there = fs::symlink_status(path, ignored);
  if (fs::is_symlink(there)) throw Error(path.string() + ": is a link: expected a file, or none");
  expect_apart({inputs_of(options_), {path}});
  if (fs::exists(there) && !replace) {
    throw NameTaken(path.string() +
                    ": exists already: expected another name, or permission to replace it");
  }
  AtomicFiles files;
  files.add(path).write(text);
  files.commit();
  return path;
}

std::string Desk::command(const DeskChoice& choice) const {
  look_of(choice);  // refuses errors here, before the shell
  std::vector<std::string> words = {"limpid"};
  words.insert(words.end(), options_.command.begin(), options_.command.end());
  words.insert(words.end(), {"--look", choice.look});
  for (const std::string& setting : choice.settings) words.insert(words.end(), {"--set", setting});
  if (choice.time) {
    // Frame F is at --time + F / --fps.
    const int frame = options_.frames.empty() ? 0 : choice.frame.value_or(options_.frames.front());
    words.insert(words.end(), {"--time", toml_text(*choice.time - frame / options_.fps)});
  }
  if (!options_.range.empty()) words.insert(words.end(), {"--frames", options_.range});
  words.insert(words.end(), {"-o", options_.range.empty() ? "wet.exr" : "wet.####.exr"});
  return shell_line(words);
}

}  // namespace limpid
