#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "limpid/job/composite.h"
#include "limpid/job/output.h"
#include "limpid/job/water.h"

/// @file
/// The files that a job reads and writes, and the check that no output is also an input. Every job
/// of the library and of the tool makes this check before it writes.

namespace limpid {

struct JobFiles {
  std::vector<std::filesystem::path> inputs, outputs;  ///< empty paths are ignored
};

/// The files that `choice` writes, the picture first.
std::vector<std::filesystem::path> outputs_of(const OutputChoice& choice);

/// The input files of a job with a model: glTF with its buffers and images (Model::files), scene
/// and look (SceneFile::file, Look::file, Look::bases), textures.
std::vector<std::filesystem::path> inputs_of(const Model& model, const SceneFile& scene,
                                             const Look& look);

/// All files that have been or may be read, with plates and layers, and all files that will be
/// written.
JobFiles files_of(const CompositeJob& job);
JobFiles files_of(const Model& model, const RenderJob& job);
JobFiles files_of(const Model& model, const WaterJob& job);

/// Throws Error of Fault::kUsage for an output that is also an input or another output. Files are
/// compared by device and inode, so that links, "./" and absolute paths do not matter; files that
/// do not exist yet are compared by their folder and name.
void expect_apart(const JobFiles& files);

/// The same for all frames of a sequence: no frame may write a file that any frame reads, or that
/// another one writes. Calls `files_of_frame` for each frame in order; a frame for which it throws
/// is skipped here, and fails when its turn comes. A few system calls per file, some 50
/// microseconds per frame.
void expect_apart(std::span<const int> frames,
                  const std::function<JobFiles(int frame)>& files_of_frame);

}  // namespace limpid
