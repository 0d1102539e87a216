#include "judge/report/measure.h"

#include "limpid/files/picture/preview.h"

#include "judge/compare/heat_map.h"
#include "judge/report/jpeg.h"
#include "judge/report/lagoon.h"
#include "judge/report/numbers.h"

namespace limpid {
namespace {

std::vector<ComparedChannel> channels_of(const std::array<View<const float>, 3>& picture,
                                         const std::array<View<const float>, 3>& judge) {
  return {{"R", picture[0], judge[0]}, {"G", picture[1], judge[1]}, {"B", picture[2], judge[2]}};
}

Figure encoded(std::string name, std::string caption, const std::array<Plane, 3>& rgb) {
  return {std::move(name), std::move(caption), rgb[0].view().window.size(),
          jpeg_of({rgb[0].view(), rgb[1].view(), rgb[2].view()})};
}

}  // namespace

Measuring scattered_once(Measuring measuring) {
  const auto change = [](Look& look) {
    DepthFog::Params& fog = look.of<DepthFog>();
    if (fog.model == DepthFog::Model::kRadiativeTransfer) fog.model = DepthFog::Model::kBeerLambert;
    look.of<Caustics>().strength = 0;
  };
  change(measuring.physical);
  for (Look& look : measuring.looks) change(look);
  return measuring;
}

PixelError error_of(const Picture& picture, const Picture& judge, bool clip) {
  CompareOptions options;
  if (clip) options.clip = Lagoon::kBrightest;
  const Metrics all = compare(channels_of(picture.color(), judge.color()), options).overall;
  return {all.mean, all.p99, all.p99_99, all.max};
}

std::string costs_text(double ns_per_pixel, const PixelError& error) {
  return short_number(ns_per_pixel) + " ns/pixel, error mean " + short_number(error.mean) +
         ", max " + short_number(error.max);
}

Figure figure_of(std::string name, std::string caption,
                 const std::array<View<const float>, 3>& linear) {
  return encoded(std::move(name), std::move(caption),
                 {displayed(linear[0]), displayed(linear[1]), displayed(linear[2])});
}

Figure heat_figure_of(std::string name, std::string caption,
                      const std::array<View<const float>, 3>& picture,
                      const std::array<View<const float>, 3>& judge) {
  return encoded(std::move(name), std::move(caption),
                 heat_map(channels_of(picture, judge), {.maximum = 1, .decades = kHeatDecades}));
}

}  // namespace limpid
