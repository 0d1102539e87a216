#include "judge/shot/shot_error.h"

#include <algorithm>
#include <cmath>

#include "core/convert_color.h"
#include "judge/compare/compare.h"
#include "judge/compare/flip.h"
#include "judge/compare/ssim.h"
#include "judge/report/lagoon.h"

namespace limpid {
namespace {

constexpr int kSsimWindow = 11;

/// Mean |picture - judge| over mean judge.
double relative_error(const ColorViews& picture, const ColorViews& judge, const WetMask& wet) {
  const Rect w = judge[0].window;
  double off = 0, all = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    auto is_wet = wet.begin();
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x, ++is_wet) {
        if (!*is_wet) continue;
        const double value = std::min<double>(picture[c].at(x, y), Lagoon::kBrightest);
        const double right = std::min<double>(judge[c].at(x, y), Lagoon::kBrightest);
        off += std::abs(value - right);
        all += right;
      }
    }
  }
  return all > 0 ? off / all : std::nan("");
}

/// A picture with the primaries that metrics of color expect: itself, or a converted copy.
class InRec709 {
 public:
  InRec709(const ColorViews& picture, const Primaries& primaries) : views_(picture) {
    if (agree(primaries, kRec709)) return;
    for (std::size_t c = 0; c < 3; ++c) {
      planes_[c] = Plane(picture[c].window);
      for (int y = picture[c].window.y0; y < picture[c].window.y1; ++y) {
        std::copy_n(picture[c].row(y), picture[c].window.width(), planes_[c].view().row(y));
      }
      views_[c] = planes_[c].view();
    }
    convert_color({planes_[0].view(), planes_[1].view(), planes_[2].view()}, kRec709, primaries);
  }
  const ColorViews& views() const { return views_; }

 private:
  std::array<Plane, 3> planes_;
  ColorViews views_;
};

}  // namespace

ShotError shot_error(const ColorViews& picture, const ColorViews& judge, const WetMask& wet,
                     const Primaries& primaries) {
  CompareOptions options;
  options.clip = Lagoon::kBrightest;
  const ComparedChannel channels[] = {
      {"R", picture[0], judge[0]}, {"G", picture[1], judge[1]}, {"B", picture[2], judge[2]}};
  const Metrics all = compare(channels, options).overall;
  ShotError error;
  error.pixels = {all.mean, all.p99, all.p99_99, all.max};
  error.rmse = all.rmse;
  error.relative_wet = relative_error(picture, judge, wet);
  const InRec709 shown(picture, primaries), shown_judge(judge, primaries);
  const ColorPair pair{shown.views(), shown_judge.views()};
  const Rect w = judge[0].window;
  if (std::min(w.width(), w.height()) >= kSsimWindow) error.ssim = ssim(pair).mean;
  error.flip = flip(pair).mean;
  return error;
}

}  // namespace limpid
