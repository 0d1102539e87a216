#include <algorithm>
#include <limits>
#include <list>

#include "limpid/run/fused.h"
#include "limpid/run/reference.h"

#include "judge/report/differences.h"
#include "judge/report/measure.h"
#include "judge/report/rounds.h"

namespace limpid {
namespace {

/// A look on a subject, by all runners.
struct LookRun {
  const Look& look;
  Plan plan;
  Frame frame;
  Picture exact, fused;

  LookRun(const Look& which, Subject& subject)
      : look(which),
        plan(subject.plan(which)),
        frame(subject.frame_for(plan)),
        exact(subject.window()),
        fused(subject.window()) {}
};

class Looks {
 public:
  Looks(const Measuring& m, Subject& subject) : m_(m), subject_(subject) {
    for (const Look& look : m.looks) runs_.emplace_back(look, subject);
  }

  void run(bool figures) {
    time_reference();
    time_fused();
    time_gpu();
    judge();
    describe_subject();
    if (figures) draw();
  }

 private:
  double ns(double seconds) const { return 1e9 * seconds / subject_.pixels(); }

  LookRun& physical() {
    return *std::find_if(runs_.begin(), runs_.end(),
                         [&](const LookRun& r) { return r.look.name == m_.physical.name; });
  }

  void add(RunnerRow row) {
    std::string run = row.runner + (row.simd.empty() ? "" : " " + row.simd);
    run += row.threads == 1 ? ", 1 thread" : ", " + std::to_string(row.threads) + " threads";
    m_.say(row.subject + ", " + row.look + ", " + run + ": " +
           costs_text(row.ns_per_pixel, row.error));
    m_.report.runners.push_back(std::move(row));
  }

  /// It is so slow that other load hardly matters: two rounds are enough.
  void time_reference() {
    std::vector<Timed> timed;
    for (LookRun& run : runs_) {
      timed.push_back(
          {[&] { run_reference(run.plan, run.frame, subject_.scene(), run.exact.target); }});
    }
    const int rounds = std::min(m_.options.rounds, 2);
    time_rounds(timed, rounds);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      add({subject_.facts().name,
           runs_[i].look.name,
           "reference",
           "",
           1,
           rounds,
           ns(timed[i].best_seconds),
           {}});
    }
  }

  void time_fused() {
    Picture scratch(subject_.window());
    std::vector<RunnerRow> rows;
    std::vector<Timed> timed;
    for (LookRun& run : runs_) {
      const auto add_runs = [&](const std::string& simd, Executor& executor, int threads) {
        Timed work{[&, simd] {
          run_fused(run.plan, run.frame, subject_.scene(), scratch.target, executor,
                    {.simd = simd});
        }};
        if (threads > 1) work.clock = Clock::kWall;
        work.run();  // for its error, and as warm-up
        rows.push_back({subject_.facts().name, run.look.name, "fused", simd, threads,
                        m_.options.rounds, 0, error_of(scratch, run.exact, false)});
        timed.push_back(std::move(work));
      };
      for (const std::string& simd : simd_targets()) add_runs(simd, m_.one, 1);
      if (m_.threads > 1) add_runs(m_.simd, m_.many, m_.threads);
      run_fused(run.plan, run.frame, subject_.scene(), run.fused.target, m_.many,
                {.simd = m_.simd});
    }
    time_rounds(timed, m_.options.rounds);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].ns_per_pixel = ns(timed[i].best_seconds);
      add(rows[i]);
    }
  }

  /// From memory to memory; completers run on all threads.
  void time_gpu() {
    if (!m_.gpu) return;
    Picture scratch(subject_.window());
    std::list<GpuRunner> runners;  // each keeps the data of its look
    std::vector<RunnerRow> rows;
    std::vector<Timed> timed;
    for (LookRun& run : runs_) {
      GpuRunner& runner = runners.emplace_back(*m_.gpu);
      Timed work{
          [&] { runner.run(run.plan, run.frame, subject_.scene(), scratch.target, m_.many); }};
      work.clock = Clock::kWall;
      work.run();  // for its error, and to compile it
      rows.push_back({subject_.facts().name, run.look.name, "gpu", runner.device(), m_.threads,
                      m_.options.rounds, 0, error_of(scratch, run.exact, false)});
      timed.push_back(std::move(work));
    }
    time_rounds(timed, m_.options.rounds);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].ns_per_pixel = ns(timed[i].best_seconds);
      add(rows[i]);
    }
  }

  double fused_ns(const std::string& look) const {
    for (const RunnerRow& row : m_.report.runners) {
      if (row.subject == subject_.facts().name && row.look == look && row.simd == m_.simd &&
          row.threads == 1) {
        return row.ns_per_pixel;
      }
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

  void judge() {
    for (LookRun& run : runs_) {
      LookRow row{subject_.facts().name, run.look.name, fused_ns(run.look.name),
                  error_of(run.fused, physical().fused, true),
                  differences(run.plan, physical().plan)};
      m_.say(row.subject + ", " + row.look + " beside " + m_.physical.name + ": " +
             costs_text(row.ns_per_pixel, row.error));
      m_.report.look_rows.push_back(std::move(row));
    }
  }

  void describe_subject() {
    ReportSubject facts = subject_.facts();
    const Picture& wet = physical().fused;
    const Rect w = subject_.window();
    const Frame& frame = physical().frame;
    double changed = 0;
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        bool same = true;
        for (int c = 0; c < 3; ++c) {
          same &= wet.planes[c].view().at(x, y) ==
                  frame.plane(plane_after(PlaneId::kColorR, c)).at(x, y);
        }
        changed += same ? 0 : 1;
      }
    }
    facts.wet_share = changed / subject_.pixels();
    m_.report.subject_figures.push_back(figure_of(facts.name, facts.name, wet.color()));
    m_.report.subjects.push_back(std::move(facts));
  }

  void draw() {
    for (LookRun& run : runs_) {
      const std::string& name = run.look.name;
      m_.report.look_figures.push_back(figure_of(name, name, run.fused.color()));
      if (&run == &physical()) continue;
      m_.report.look_errors.push_back(heat_figure_of(name,
                                                     name + ", difference from " + m_.physical.name,
                                                     run.fused.color(), physical().fused.color()));
    }
  }

  const Measuring& m_;
  Subject& subject_;
  std::vector<LookRun> runs_;
};

}  // namespace

void measure_looks(const Measuring& m, Subject& subject, bool figures) {
  Looks(m, subject).run(figures);
}

}  // namespace limpid
