#include "limpid/job/resume.h"

#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "limpid/core/error.h"
#include "limpid/files/exr/exr_file.h"
#include "limpid/files/picture/image_file.h"
#include "limpid/files/unfinished.h"
#include "limpid/job/job_files.h"

#include "files/file_identity.h"
#include "job/frame_line.h"
#include "job/resume_frames.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

/// Throws Error unless the file is complete and unchanged, as far as `level` checks.
void check(const ExrFile& file, VerifyLevel level) {
  const std::string name = file.path().string();
  if (!file.is_whole()) throw Error(name + ": is incomplete");
  if (level == VerifyLevel::kWhole) return;
  const std::optional<bool> as_written = file.is_as_written();
  if (!as_written) throw Error(name + " has no hash of its bytes");
  if (!*as_written) throw Error(name + " has changed since it was written (its hash differs)");
}

/// The file's values for the names of the record. Throws Error if it cannot be read or fails the
/// check.
Record said_by(const fs::path& file, const Record& record, VerifyLevel level) {
  if (!holds_exr(file)) return read_image_texts(file);
  const ExrFile exr = ExrFile::open(file);
  check(exr, level);
  Record said;
  for (const auto& [name, text] : record) {
    if (const auto found = exr.text_attribute(0, name)) said[name] = *found;
  }
  return said;
}

/// Why the file differs from what would be written now, or "".
std::string why_not(const fs::path& file, const Record& record, VerifyLevel level) {
  try {
    const Record said = said_by(file, record, level);
    std::vector<std::string> others;
    for (const auto& [name, text] : record) {
      const auto found = said.find(name);
      if (found == said.end()) return file.string() + " does not record how it was made";
      if (found->second != text) others.push_back(name.substr(name.find('/') + 1));
    }
    return others.empty() ? "" : file.string() + " was made differently (" + join(others) + ")";
  } catch (const Error& error) {
    return error.what();
  }
}

/// The state of a frame's output.
struct Found {
  bool kept = false;
  std::string why;  ///< why it is not done, although its picture exists
};

Found find(const ExpectedOutput& output, VerifyLevel level) {
  const std::vector<fs::path>& files = output.files.outputs;
  if (!is_there(files.front())) return {};
  for (const fs::path& file : files) {
    if (!is_there(file)) return {false, file.string() + " is missing"};
  }
  Record record;
  try {
    record = output.record();
  } catch (const Error&) {
    return {};  // reported when the frame is made
  }
  for (const fs::path& file : files) {
    const std::string why = why_not(file, record, level);
    if (!why.empty()) return {false, why};
  }
  return {true, ""};
}

/// A frame to be checked.
struct Candidate {
  std::optional<ExpectedOutput> output;
  Found found;
};

}  // namespace

Rest rest_of_frames(const Sequence& sequence,
                    const std::function<ExpectedOutput(int frame)>& output_of, Executor& executor,
                    VerifyLevel level) {
  check(sequence);
  expect_apart(sequence.frames, [&](int frame) { return output_of(frame).files; });
  Rest rest;
  std::set<fs::path> folders;
  std::vector<Candidate> candidates(static_cast<std::size_t>(frames_in_flight(sequence)));
  const auto at = [&](int place) -> Candidate& {
    return candidates[static_cast<std::size_t>(place)];
  };
  const FrameStep steps[] = {
      [&](int place, int frame) {
        at(place) = {};
        try {
          at(place).output = output_of(frame);
          for (const fs::path& file : at(place).output->files.outputs) {
            folders.insert(fs::absolute(followed(file)).parent_path());
          }
        } catch (const Error&) {
          return;  // reported when the frame is made
        }
      },
      [&](int place, int) {
        if (at(place).output) at(place).found = find(*at(place).output, level);
      },
      [&](int place, int frame) {
        const Found& found = at(place).found;
        if (found.kept) {
          ++rest.kept;
          return;
        }
        rest.frames.push_back(frame);
        if (!found.why.empty()) rest.others.push_back({frame, found.why});
      },
  };
  run_steps(sequence, steps, executor);
  for (const fs::path& folder : folders) remove_abandoned_files(folder);
  return rest;
}

}  // namespace limpid
