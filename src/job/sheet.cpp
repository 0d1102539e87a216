#include "job/sheet.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>

#include "show/contact_sheet.h"
#include "show/encoded.h"

namespace limpid {
namespace {

constexpr int kMaxAcross = 480;  ///< pixels of a cell

/// A canvas of at most that width: the same, or a reduced copy.
class Smaller {
 public:
  Smaller(const Canvas& canvas, const Rect& display, int most_across, const OutputChoice& choice)
      : canvas_(&canvas), window_(intersection(canvas.target().color[0].window, display)) {
    const int least_side = std::min(window_.width(), window_.height());
    const int n = std::min((window_.width() + most_across - 1) / most_across, least_side);
    if (n < 2) return;
    canvas_ = &smaller_.emplace(canvas.filtered(n, choice));
    window_ = {window_.x0 / n, window_.y0 / n, window_.x1 / n, window_.y1 / n};
  }
  Smaller(const Smaller&) = delete;
  Smaller& operator=(const Smaller&) = delete;

  std::array<View<float>, 3> color() const { return cropped(canvas_->target().color); }
  std::array<View<float>, 3> of(Aov aov) const { return cropped(canvas_->target().of(aov)); }

 private:
  std::array<View<float>, 3> cropped(std::array<View<float>, 3> views) const {
    for (View<float>& view : views) {
      if (!view) continue;
      view.data = &view.at(window_.x0, window_.y0);
      view.window = window_;
    }
    return views;
  }

  std::optional<Canvas> smaller_;
  const Canvas* canvas_;
  Rect window_;
};

Shown shown_color(const Smaller& smaller, const DisplayTransform& light, Executor& executor) {
  const std::array<View<float>, 3> color = smaller.color();
  return shown_light({color[0], color[1], color[2]}, light, executor);
}

std::string label_of(const std::string& name, const Shown& shown) {
  if (!shown.scale) return name;
  char text[96];
  std::snprintf(text, sizeof text, "%s  %.3g ... %.3g", name.c_str(), (*shown.scale)[0],
                (*shown.scale)[1]);
  return text;
}

}  // namespace

Shown sheet_of(const Canvas& canvas, const Rect& display, const DisplayTransform& light) {
  OutputChoice all;
  all.contact_sheet = "all";  // to compute all AOVs
  const Smaller smaller(canvas, display, kMaxAcross, all);
  const auto executor = make_executor(1);  // the pictures are small
  std::vector<SheetCell> cells{{"picture", shown_color(smaller, light, *executor)}};
  for (const AovInfo& info : aovs()) {
    const Aov aov = aov_named(info.name);
    Shown shown = shown_aov(aov, smaller.of(aov), light, *executor);
    std::string label = label_of(std::string(info.name), shown);
    cells.push_back({std::move(label), std::move(shown)});
  }
  return contact_sheet(cells);
}

PreviewPixels preview_pixels(const Canvas& canvas, const Rect& display, const OutputChoice& choice,
                             const Primaries& primaries) {
  if (choice.preview_across <= 0) return {};
  const Smaller smaller(canvas, display, choice.preview_across, {});
  const auto executor = make_executor(1);
  const Shown shown = shown_color(smaller, DisplayTransform(choice.display, primaries), *executor);
  return {shown.size, rgb_of(shown)};
}

}  // namespace limpid
