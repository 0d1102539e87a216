#include "limpid/job/job_files.h"

#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "limpid/core/error.h"

#include "files/file_identity.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;
using Files = std::vector<fs::path>;
using FilesOfFrame = std::function<JobFiles(int)>;

/// The user of a file: a frame, or the only job.
struct Use {
  std::optional<int> frame;
  bool writes = false;
};

/// The files of all frames so far, by identity. Paths are not kept: for 10^5 frames they would need
/// more memory than all other data.
class Uses {
 public:
  explicit Uses(FilesOfFrame files_of_frame) : files_of_frame_(std::move(files_of_frame)) {}

  void add(const JobFiles& files, std::optional<int> frame) {
    for (std::size_t i = 0; i < files.inputs.size(); ++i) {
      // Frames share most of what they read.
      if (i < inputs_.size() && inputs_[i] == files.inputs[i]) continue;
      add(files.inputs[i], {frame, false});
    }
    inputs_ = files.inputs;
    for (const fs::path& file : files.outputs) add(file, {frame, true});
  }

 private:
  void add(const fs::path& file, const Use& use) {
    if (file.empty()) return;
    const FileIdentity identity = identity_of(file);
    const auto [found, is_new] = uses_.try_emplace(identity, use);
    if (is_new || !(found->second.writes || use.writes)) return;
    const Use& before = found->second;
    if (use.writes) refuse(file, use, name_of(identity, before), before);
    refuse(name_of(identity, before), before, file, use);
  }

  /// The path by which the frame names the file.
  fs::path name_of(const FileIdentity& identity, const Use& use) const {
    const JobFiles files = files_of_frame_(use.frame.value_or(0));
    for (const fs::path& file : use.writes ? files.outputs : files.inputs) {
      if (!file.empty() && identity_of(file) == identity) return file;
    }
    return {};
  }

  [[noreturn]] static void refuse(const fs::path& output, const Use& of, const fs::path& other,
                                  const Use& of_other) {
    std::string text = of.frame ? "frame " + std::to_string(*of.frame) + ": " : "";
    text += output.string() + ": is " + (of_other.writes ? "another output" : "an input");
    if (of_other.frame != of.frame) text += " of frame " + std::to_string(*of_other.frame);
    text += ", too";
    if (other != output) text += ", named " + other.string();
    throw Error(text + ": expected a separate file for each output", Fault::kUsage);
  }

  FilesOfFrame files_of_frame_;
  std::unordered_map<FileIdentity, Use, FileIdentityHash> uses_;
  Files inputs_;  ///< of the previous frame
};

void add_texture_files(const SceneFile& scene, const Look& look, Files& inputs) {
  inputs.insert(inputs.end(),
                {scene.environment, scene.file, look.of<WaveNormals>().map, look.file});
  inputs.insert(inputs.end(), look.bases.begin(), look.bases.end());
}

Files rendered_from(const Model& model, const SceneFile& scene) {
  Files files = model.files;
  files.push_back(scene.geometry);
  files.push_back(scene.file);
  return files;
}

}  // namespace

Files outputs_of(const OutputChoice& choice) {
  Files files{choice.picture};
  for (const fs::path& also : {choice.deep, choice.preview, choice.contact_sheet}) {
    if (!also.empty()) files.push_back(also);
  }
  return files;
}

Files inputs_of(const Model& model, const SceneFile& scene, const Look& look) {
  Files files = rendered_from(model, scene);
  add_texture_files(scene, look, files);
  return files;
}

JobFiles files_of(const CompositeJob& job) {
  JobFiles files{files_of(job.plate), outputs_of(job.output)};
  add_texture_files(job.scene, job.look, files.inputs);
  const auto add = [&](const Files& more) {
    files.inputs.insert(files.inputs.end(), more.begin(), more.end());
  };
  if (job.second) add(files_of(job.second->plate));
  for (const CompositeJob::View& view : job.other_views) {
    add(files_of(view.plate));
    if (view.second) add(files_of(view.second->plate));
    add_texture_files(view.scene, job.look, files.inputs);
  }
  return files;
}

JobFiles files_of(const Model& model, const RenderJob& job) {
  return {rendered_from(model, job.scene), {job.output.plate}};
}

JobFiles files_of(const Model& model, const WaterJob& job) {
  return {inputs_of(model, job.scene, job.look), outputs_of(job.output)};
}

void expect_apart(const JobFiles& files) {
  Uses([&](int) { return files; }).add(files, std::nullopt);
}

void expect_apart(std::span<const int> frames, const FilesOfFrame& files_of_frame) {
  Uses uses(files_of_frame);
  std::unordered_set<int> seen;
  for (const int frame : frames) {
    if (!seen.insert(frame).second) continue;  // duplicate
    std::optional<JobFiles> files;
    try {
      files = files_of_frame(frame);
    } catch (...) {
      continue;  // reported when the frame is made
    }
    uses.add(*files, frame);
  }
}

}  // namespace limpid
