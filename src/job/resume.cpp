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
#include "job/composite_frame.h"
#include "job/water_frame.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

using Files = std::vector<fs::path>;

Files outputs_of(const CompositeJob& job) { return outputs_of(job.output); }
Files outputs_of(const WaterJob& job) { return outputs_of(job.output); }
Files outputs_of(const PlateJob& job) { return {job.output.plate}; }

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

/// Throws Error unless the file is as it was written, as far as it is looked at.
void check(const ExrFile& file, Scrutiny scrutiny) {
  const std::string name = file.path().string();
  if (!file.is_whole()) throw Error(name + ": is not whole");
  if (scrutiny == Scrutiny::kWhole) return;
  const std::optional<bool> as_written = file.is_as_written();
  if (!as_written) throw Error(name + " has no hash of its bytes");
  if (!*as_written) throw Error(name + " has changed since it was written (its hash is another)");
}

/// What the file says under the names of the record. Throws Error for one that cannot be read or
/// does not pass.
Record said_by(const fs::path& file, const Record& record, Scrutiny scrutiny) {
  if (!holds_exr(file)) return read_image_texts(file);
  const ExrFile exr = ExrFile::open(file);
  check(exr, scrutiny);
  Record said;
  for (const auto& [name, text] : record) {
    if (const auto found = exr.text_attribute(0, name)) said[name] = *found;
  }
  return said;
}

/// Why the file is not as it would be made now, or "".
std::string why_not(const fs::path& file, const Record& record, Scrutiny scrutiny) {
  try {
    const Record said = said_by(file, record, scrutiny);
    std::vector<std::string> others;
    for (const auto& [name, text] : record) {
      const auto found = said.find(name);
      if (found == said.end()) return file.string() + " does not say how it was made";
      if (found->second != text) others.push_back(name.substr(name.find('/') + 1));
    }
    return others.empty() ? "" : file.string() + " was made otherwise (" + join(others) + ")";
  } catch (const Error& error) {
    return error.what();
  }
}

/// What there is of a frame.
struct Found {
  bool kept = false;
  std::string why;  ///< it is not, though its picture is there
};

template <class RecordOfJob>
Found find(const Files& files, const RecordOfJob& record_of_job, Scrutiny scrutiny) {
  if (!is_there(files.front())) return {};
  for (const fs::path& file : files) {
    if (!is_there(file)) return {false, file.string() + " is not there"};
  }
  Record record;
  try {
    record = record_of_job();
  } catch (const Error&) {
    return {};  // it will be told when the frame is made
  }
  for (const fs::path& file : files) {
    const std::string why = why_not(file, record, scrutiny);
    if (!why.empty()) return {false, why};
  }
  return {true, ""};
}

struct Findings {
  Scrutiny scrutiny;
  Rest rest;
  std::set<fs::path> folders;

  void add_folder_of(const fs::path& file) {
    try {
      folders.insert(fs::absolute(followed(file)).parent_path());
    } catch (const Error&) {
      return;  // it will be told when the frame is made
    }
  }
};

/// A slot that looks at frames instead of making them.
template <class Job, class RecordOfJob>
class LookingSlot : public FrameSlot {
 public:
  LookingSlot(const JobOfFrame<Job>& job_of, const RecordOfJob& record_of_job, Findings& findings)
      : job_of_(job_of), record_of_job_(record_of_job), findings_(findings) {}

  void begin(int frame) override {
    job_.reset();
    found_ = {};
    try {
      job_ = job_of_(frame);
    } catch (const Error&) {
      return;  // it will be told when the frame is made
    }
    for (const fs::path& file : outputs_of(*job_)) findings_.add_folder_of(file);
  }
  void read(Executor&) override {
    const auto record = [&] { return record_of_job_(*job_); };
    if (job_) found_ = find(outputs_of(*job_), record, findings_.scrutiny);
  }
  void run(Executor&) override {}
  void write() override {}
  void done(const SequenceProgress& progress) override {
    Rest& rest = findings_.rest;
    if (found_.kept) {
      ++rest.kept;
      return;
    }
    rest.frames.push_back(progress.frame);
    if (!found_.why.empty()) rest.others.push_back({progress.frame, found_.why});
  }

 private:
  const JobOfFrame<Job>& job_of_;
  const RecordOfJob& record_of_job_;
  Findings& findings_;
  std::optional<Job> job_;
  Found found_;
};

template <class Job, class RecordOfJob>
Rest rest_of(const Sequence& sequence, const JobOfFrame<Job>& job_of,
             const RecordOfJob& record_of_job, Executor& executor, Scrutiny scrutiny) {
  Findings findings{scrutiny, {}, {}};
  const auto make_slot = [&]() -> std::unique_ptr<FrameSlot> {
    return std::make_unique<LookingSlot<Job, RecordOfJob>>(job_of, record_of_job, findings);
  };
  run_sequence(sequence, make_slot, executor);
  for (const fs::path& folder : findings.folders) remove_abandoned_files(folder);
  return std::move(findings.rest);
}

}  // namespace

Rest rest_of_composite(const Sequence& sequence, const JobOfFrame<CompositeJob>& job_of,
                       Executor& executor, Scrutiny scrutiny) {
  expect_apart(sequence.frames, [&](int frame) { return files_of(job_of(frame)); });
  SharedTextures textures;
  return rest_of(
      sequence, job_of, [&](const CompositeJob& job) { return record_of(job, textures); }, executor,
      scrutiny);
}

Rest rest_of_render(const Model& model, const Sequence& sequence,
                    const JobOfFrame<PlateJob>& job_of, Executor& executor, Scrutiny scrutiny) {
  expect_apart(sequence.frames, [&](int frame) { return files_of(model, job_of(frame)); });
  const HashedModel hashed(model);
  return rest_of(
      sequence, job_of, [&](const PlateJob& job) { return record_of(hashed, job); }, executor,
      scrutiny);
}

Rest rest_of_water(const Model& model, const Sequence& sequence, const JobOfFrame<WaterJob>& job_of,
                   Executor& executor, Scrutiny scrutiny) {
  expect_apart(sequence.frames, [&](int frame) { return files_of(model, job_of(frame)); });
  SharedTextures textures;
  const HashedModel hashed(model);
  return rest_of(
      sequence, job_of, [&](const WaterJob& job) { return record_of(hashed, job, textures); },
      executor, scrutiny);
}

}  // namespace limpid
