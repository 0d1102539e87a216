#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "limpid/job/resume.h"
#include "limpid/job/sequence.h"
#include "limpid/job/water.h"

#include "job/frame_faults.h"
#include "judge/trace/truth.h"

namespace limpid {

/// `limpid truth`: a ray-traced picture of a model with its water, the standard for the chain.
struct TruthOutput {
  std::vector<Aov> aovs;          ///< as TruthOptions has it
  bool visible = false;           ///< as visible.R ... visible_below.B
  std::filesystem::path picture;  ///< EXR
  std::filesystem::path preview;  ///< PNG, or empty for none
  DisplayChoice display = {};     ///< of the preview
  std::string compression = "piz";
  bool store_float = false;  ///< half otherwise; depths, paths and maps are float always
};

struct TruthJob : SceneJob {
  Size size{1920, 1080};
  Look look;
  int samples = 1;
  TruthOptions::Light light = TruthOptions::Light::kPaths;
  int paths = 16, photons = 0;
  std::uint64_t seed = 0;
  TruthOutput output;
};

/// Result, for the report line.
struct TruthReport {
  Size size;
  double relative_error = 0;  ///< as TruthPicture has it
  double read_seconds = 0, run_seconds = 0, write_seconds = 0;
};

/// Traces and writes. Throws Error as trace_truth() does, for textures that cannot be read, and for
/// an output that is one of the inputs or another output; the former file of the output's name then
/// remains.
TruthReport truth(const Model& model, const TruthJob& job, Executor& executor);

/// Many frames, the rest of many, and their errors, as for water() (job/sequence.h, job/resume.h,
/// job/frame_faults.h).
void truth_sequence(const Model& model, const Sequence& sequence,
                    const JobOfFrame<TruthJob>& job_of, const OnFrameOf<TruthReport>& on_frame,
                    Executor& executor);
Rest rest_of_truth(const Model& model, const Sequence& sequence, const JobOfFrame<TruthJob>& job_of,
                   Executor& executor, VerifyLevel level = VerifyLevel::kWhole);
std::vector<FrameFault> faults_of_truth(const Model& model, const Sequence& sequence,
                                        const JobOfFrame<TruthJob>& job_of, Executor& executor);

}  // namespace limpid
