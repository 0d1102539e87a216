#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "limpid/job/composite.h"
#include "limpid/job/output.h"
#include "limpid/job/water.h"

/// @file
/// The files that a job reads and writes, and the check that no file is both. Every job of this
/// library and of the tool makes this check before it writes.

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

/// All files that were read or may be, with plates and layers, and all that will be written.
JobFiles files_of(const CompositeJob& job);
JobFiles files_of(const Model& model, const RenderJob& job);
JobFiles files_of(const Model& model, const WaterJob& job);

/// Throws the Error of Fault::kUsage for an output that is also an input, or another output: by
/// device and inode, so that links, "./" and absolute paths hide nothing; files that do not exist
/// yet by their folder and name.
void expect_apart(const JobFiles& files);

/// The same for all frames of a sequence: no frame writes a file that a frame reads or writes. Asks
/// `files_of_frame` for each frame in order; a frame for which it throws is skipped, and fails when
/// its turn comes. A few system calls per file, some 50 microseconds per frame.
void expect_apart(std::span<const int> frames,
                  const std::function<JobFiles(int frame)>& files_of_frame);

}  // namespace limpid
