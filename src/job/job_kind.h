#pragma once
#include <concepts>
#include <utility>

#include "limpid/core/executor.h"
#include "limpid/job/job_files.h"

#include "job/provenance.h"

namespace limpid {

/// What a kind of job must give so that its jobs can be run alone and in sequences, and resumed
/// (job/run_jobs.h). A kind holds what does not change from frame to frame, such as the model and
/// textures; any threads may use it at once.
///
/// - files: all files that a job reads or may read, and all that it writes, the picture first.
/// - prepare: what is decided before a pixel is looked at, such as scene and plan. Throws Error for
///   what is wrong with the job.
/// - record: what the files say of how they were made. No pixel is decoded or drawn for it.
/// - expect_writable: throws the Error that writing would end with.
/// - Frame: the buffers of a frame, which the next one uses again. read(), run() and write() get
///   the same job, each on any thread. The report's times are kept by the caller.
template <class K>
concept JobKind = requires(K& kind, const typename K::Job& job, typename K::Prepared prepared,
                           typename K::Frame& frame, Executor& executor, Record record) {
  { kind.files(job) } -> std::same_as<JobFiles>;
  { kind.prepare(job) } -> std::same_as<typename K::Prepared>;
  { kind.record(job, std::as_const(prepared)) } -> std::same_as<Record>;
  kind.expect_writable(job);
  requires std::constructible_from<typename K::Frame, K&>;
  frame.read(job, std::move(prepared));
  frame.run(job, executor);
  frame.write(job, std::move(record));
  { frame.report() } -> std::same_as<typename K::Report&>;
  frame.report().read_seconds + frame.report().run_seconds + frame.report().write_seconds;
};

}  // namespace limpid
