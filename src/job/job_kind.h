#pragma once
#include <concepts>
#include <utility>

#include "limpid/core/executor.h"
#include "limpid/job/job_files.h"

#include "job/provenance.h"

namespace limpid {

/// The functions of a kind of job, so that its jobs can run alone and in sequences, and be resumed
/// (job/run_jobs.h). A kind holds data that does not change from frame to frame, such as the model
/// and textures; any number of threads may use it at once.
///
/// - files: all files that a job reads or may read, and all that it writes, the picture first.
/// - prepare: the decisions before a pixel is read, such as scene and plan. Throws Error if the
///   job is wrong.
/// - record: how the files were made, for their attributes. Decodes and draws no pixel.
/// - expect_writable: throws the Error with which writing would end.
/// - Frame: the buffers of a frame, reused by the next one. read(), run() and write() get the
///   same job, each on any thread. The caller measures the report's times.
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
