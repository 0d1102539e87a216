#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "limpid/job/composite.h"
#include "limpid/job/output.h"
#include "limpid/job/water.h"

/// @file
/// Which files a job reads and which it writes, and that no file is both. Every job of this library
/// and of the tool passes through here before it writes.

namespace limpid {

struct JobFiles {
  std::vector<std::filesystem::path> inputs, outputs;  ///< empty paths count for nothing
};

/// The files that the choice names, the picture first.
std::vector<std::filesystem::path> outputs_of(const OutputChoice& choice);

/// What a model is made from, seen in a scene by a look: glTF with its buffers and images
/// (Model::files), scene and look (SceneFile::file, Look::file, Look::bases), textures.
std::vector<std::filesystem::path> inputs_of(const Model& model, const SceneFile& scene,
                                             const Look& look);

/// All files that were read or may be, plates and layers, too, and all that will be written.
JobFiles files_of(const CompositeJob& job);
JobFiles files_of(const Model& model, const RenderJob& job);
JobFiles files_of(const Model& model, const WaterJob& job);

/// Throws the Error of Fault::kUsage for an output that is an input, too, or another output: by
/// device and inode, so that links, "./" and absolute paths hide nothing; files that are not there
/// yet by their folder and name.
void expect_apart(const JobFiles& files);

/// The same of all frames of a sequence together: no frame writes what another reads or writes.
/// `files_of_frame` is asked for each frame in order; one that throws is passed over, for that is
/// told when its turn comes. A few system calls a file, some 50 microseconds a frame.
void expect_apart(std::span<const int> frames,
                  const std::function<JobFiles(int frame)>& files_of_frame);

}  // namespace limpid
