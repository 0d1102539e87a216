#pragma once
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "complete/completer.h"
#include "plan/pass_of.h"
#include "shade/interpret.h"
#include "shade/record.h"
#include "support.h"

namespace limpid::test {

/// AOVs that operators make; the others show planes.
inline std::vector<Aov> made_aovs() {
  std::vector<Aov> list;
  for (int i = 0; i < kAovCount; ++i) {
    if (aovs()[static_cast<std::size_t>(i)].planes.empty()) list.push_back(static_cast<Aov>(i));
  }
  return list;
}

/// A look, recorded for a frame.
class Recorded {
 public:
  /// Edges are mixed after the pixels are made: the look has hard ones.
  Recorded(Look look, const Frame& plate, const Scene& scene)
      : plate_(plate), scene_(scene), plan_(plan_of(look, plate, scene)) {
    const auto serial = make_executor(1);
    frame_ = completer_.complete(plan_, plate, pass_of(plan_, scene, plate), *serial);
    pass_.emplace(pass_of(plan_, scene, frame_));
    pass_->plate_waves = completer_.plate_waves();
    if (!plan_.reads_environment) pass_->environment = {};
    recording_ = record(plan_, *pass_, made_aovs());
  }
  const Recording& recording() const { return recording_; }
  const Pass& pass() const { return *pass_; }
  const Plan& plan() const { return plan_; }
  const Frame& frame() const { return frame_; }

  /// Every `step`-th pixel has the reference's values, in all channels: the same double but for its
  /// last digits, which may round to the neighbouring float.
  void expect_reference(int step = 1) const {
    Picture judge(plate_.work());
    run_reference(plan_, plate_, scene_, judge.target);
    Interpreter interpreter(recording_, *pass_, frame_);
    const Rect work = plate_.work();
    int next = 0;
    for (int y = work.y0; y < work.y1; ++y) {
      for (int x = work.x0; x < work.x1; ++x) {
        if (next++ % step != 0) continue;
        const std::vector<double>& got = interpreter.run(x, y);
        const Rgb<double> color = judge.color(x, y);
        std::vector<double> wanted{color.r, color.g, color.b, judge.target.alpha.at(x, y)};
        for (const Aov aov : made_aovs()) {
          const auto& info = aovs()[static_cast<std::size_t>(aov)];
          for (std::size_t k = 0; k < info.suffixes.size(); ++k) {
            wanted.push_back(judge.aov(aov, x, y, static_cast<int>(k)));
          }
        }
        ASSERT_EQ(got.size(), wanted.size());
        for (std::size_t i = 0; i < got.size(); ++i) {
          ASSERT_TRUE(same(got[i], static_cast<float>(wanted[i])))
              << recording_.outputs[i].name << " at " << x << ", " << y << ": " << got[i]
              << ", the reference has " << wanted[i];
        }
      }
    }
  }

 private:
  static Plan plan_of(Look& look, const Frame& plate, const Scene& scene) {
    look.water.edges = Water::Edges::kHard;
    return make_plan(look, inputs_of(plate, scene), all_state());
  }
  static bool same(double got, float wanted) {
    const float near = static_cast<float>(got);
    if (near == wanted || (std::isnan(near) && std::isnan(wanted))) return true;
    return std::abs(got - double(wanted)) <= 1e-12 * std::abs(got) + 6e-8 * std::abs(wanted);
  }

  Frame plate_;
  Scene scene_;
  Plan plan_;
  Completer completer_;
  Frame frame_;
  std::optional<Pass> pass_;
  Recording recording_;
};

}  // namespace limpid::test
