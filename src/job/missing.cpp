#include "limpid/job/missing.h"

#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "limpid/core/error.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;

/// The nearest existing frame before, else the first after.
int stand_in_for(int frame, const std::set<int>& there) {
  const auto after = there.lower_bound(frame);
  return after == there.begin() ? *after : *std::prev(after);
}

/// The job of an existing frame.
CompositeJob own_job(const JobOfFrame<CompositeJob>& job_of, int frame) {
  CompositeJob job = job_of(frame);
  if (const auto gone = missing_file(job)) {
    throw Error(gone->string() +
                    ": has disappeared since the sequence began; run the sequence again to treat "
                    "this file as a missing plate",
                Fault::kRetry);
  }
  return job;
}

CompositeJob held_job(const JobOfFrame<CompositeJob>& job_of, int frame, int stand_in) {
  CompositeJob held = own_job(job_of, stand_in);
  CompositeJob job = job_of(frame);
  job.plate = std::move(held.plate);
  job.scene = std::move(held.scene);
  job.other_views = std::move(held.other_views);
  job.depth_kind = held.depth_kind;
  job.time.plate_offset += job.time.fallback - held.time.fallback;
  return job;
}

}  // namespace

std::optional<fs::path> missing_file(const CompositeJob& job) {
  std::vector<fs::path> files = files_of(job.plate);
  for (const CompositeJob::View& view : job.other_views) {
    for (fs::path& file : files_of(view.plate)) files.push_back(std::move(file));
  }
  for (const fs::path& file : files) {
    std::error_code ignored;
    if (fs::status(file, ignored).type() == fs::file_type::not_found) return file;
  }
  return std::nullopt;
}

FilledSequence fill_missing(const std::vector<int>& frames, const JobOfFrame<CompositeJob>& job_of,
                            Missing missing) {
  FilledSequence filled{frames, job_of, {}};
  if (missing == Missing::kError || frames.empty()) return filled;

  std::set<int> there, unclear;
  std::map<int, fs::path> holes;
  for (const int frame : frames) {
    try {
      if (const auto file = missing_file(job_of(frame))) {
        holes[frame] = *file;
      } else {
        there.insert(frame);
      }
    } catch (const Error&) {
      unclear.insert(frame);  // reported when its turn comes
    }
  }
  if (there.empty() && unclear.empty()) {
    throw Error(holes[frames.front()].string() +
                ": no such file, and no other frame has its plates");
  }

  const bool hold = missing == Missing::kHold && !there.empty();
  std::map<int, int> stand_ins;
  filled.frames.clear();
  for (const int frame : frames) {
    const auto hole = holes.find(frame);
    if (hole == holes.end()) {
      filled.frames.push_back(frame);
      continue;
    }
    MissingPlate& plate = filled.missing.emplace_back(MissingPlate{frame, hole->second, {}});
    if (!hold) continue;
    plate.stand_in = stand_ins[frame] = stand_in_for(frame, there);
    filled.frames.push_back(frame);
  }
  filled.job_of = [job_of, stand_ins = std::move(stand_ins),
                   unclear = std::move(unclear)](int frame) {
    if (unclear.contains(frame)) return job_of(frame);
    const auto held = stand_ins.find(frame);
    return held == stand_ins.end() ? own_job(job_of, frame) : held_job(job_of, frame, held->second);
  };
  return filled;
}

}  // namespace limpid
