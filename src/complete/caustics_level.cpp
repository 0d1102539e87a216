#include "complete/caustics_level.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace limpid {
namespace {

/// Variance of a beam one texel wide, plus a texel, plus a lookup between texels: light that is not
/// focused is wider, and blurred less.
constexpr float kBlur = 1.0f / 3;
constexpr float kOfEdge = 1.2f;  ///< a texel deeper than this factor times the edge lies beyond it
/// An edge falls more over a cell than this factor times a wall that the sun lights.
constexpr double kSteep = 1.5;

}  // namespace

void CausticsLevel::lay_out(const Layout& layout) {
  layout_ = layout;
  const int count = (layout.size.height + kTall - 1) / kTall;
  spans_.resize(static_cast<std::size_t>(count));
  const Octagon& seen = layout.seen;
  for (int k = 0; k < count; ++k) {
    const double y0 = layout.corner.y + (k * kTall - 0.5) * layout.texel,
                 y1 = y0 + kTall * layout.texel;
    const double begin = std::max({seen.low[0], seen.low[2] - y1, seen.low[3] + y0});
    const double end = std::min({seen.high[0], seen.high[2] - y0, seen.high[3] + y1});
    const auto column = [&](double x) {
      return static_cast<int>(std::clamp((x - layout.corner.x) / layout.texel, -1.0, 1e5));
    };
    spans_[static_cast<std::size_t>(k)] = {std::max(column(begin), 0),
                                           std::min(column(end) + 2, layout.size.width)};
  }
  const int down = rays_over(layout.size.height);
  rays_.resize(static_cast<std::size_t>(down));
  for (int row = 0; row < down; ++row) {
    const int at = static_cast<int>(row * layout.spacing) - layout.margin;
    const Span span = seen_in(at - layout.margin, at + layout.margin + 1);
    rays_[static_cast<std::size_t>(row)] =
        span.empty() ? Span{0, 0}
                     : Span{static_cast<int>(span.begin / layout.spacing), rays_over(span.end)};
  }
}

/// Columns that the rows from `begin` to before `end` see.
CausticsLevel::Span CausticsLevel::seen_in(int begin, int end) const {
  Span sum{std::numeric_limits<int>::max(), 0};
  const int last = std::min(end - 1, layout_.size.height - 1) / kTall;
  for (int k = std::max(begin, 0) / kTall; k <= last; ++k) {
    const Span& span = spans_[static_cast<std::size_t>(k)];
    if (!span.empty()) sum = {std::min(sum.begin, span.begin), std::max(sum.end, span.end)};
  }
  return sum;
}

/// The number of rays along a line of so many texels and the margins on both sides.
int CausticsLevel::rays_over(int texels) const {
  return static_cast<int>(std::ceil((texels + 2 * layout_.margin) / layout_.spacing));
}

double CausticsLevel::points() const {
  double sum = 0;
  for (const Span& span : rays_) sum += span.end - span.begin;
  return sum * std::max(layout_.spacing * layout_.spacing, 1.0);
}

/// Means of what is seen in each cell, drawn on over those in which nothing is. Where the upper
/// edge of a cliff shades its foot light meets the edge.
void CausticsLevel::find_bottom(std::span<const CausticsBottom> samples, Executor& executor) {
  if (!light_ || light_.view().window != rect_of(layout_.size)) {
    light_ = Plane(rect_of(layout_.size));
  }
  coarse_ = layout_.coarse;
  const int margin = layout_.margin + coarse_;
  cells_ = {(layout_.size.width + 2 * margin) / coarse_ + 2,
            (layout_.size.height + 2 * margin) / coarse_ + 2};
  auto& cells = filled_.finest(cells_);
  std::fill(cells.texels.begin(), cells.texels.end(), PullPush<1>::Texel{});
  bottom_.assign(cells.texels.size(), std::numeric_limits<float>::infinity());
  const float per_cell = static_cast<float>(1 / (coarse_ * layout_.texel));
  const float first_x = static_cast<float>(layout_.corner.x) -
                        static_cast<float>(margin) / static_cast<float>(coarse_) / per_cell;
  const float first_y = static_cast<float>(layout_.corner.y) -
                        static_cast<float>(margin) / static_cast<float>(coarse_) / per_cell;
  places_.resize(samples.size());
  const float across = static_cast<float>(cells_.width), down = static_cast<float>(cells_.height);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const CausticsBottom& s = samples[k];
    const float x = (s.x - first_x) * per_cell, y = (s.y - first_y) * per_cell;
    const bool counts = s.depth > 0 && x >= 0 && y >= 0 && x < across && y < down;
    places_[k] = counts ? static_cast<int>(y) * cells_.width + static_cast<int>(x) : -1;
    if (!counts) continue;
    float& highest = bottom_[static_cast<std::size_t>(places_[k])];
    highest = std::min(highest, s.depth);
  }
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (places_[k] < 0) continue;
    const auto cell = static_cast<std::size_t>(places_[k]);
    if (samples[k].depth > kOfEdge * bottom_[cell]) continue;
    cells.texels[cell][0] += samples[k].depth;
    cells.texels[cell][1] += 1;
  }
  for (auto& cell : cells.texels) {
    if (cell[1] > 0) cell = {cell[0] / cell[1], 1};
  }
  if (!filled_.draw_on(executor)) {
    std::fill(bottom_.begin(), bottom_.end(), static_cast<float>(layout_.depth));
    return;
  }
  const auto& whole = filled_.finest().texels;
  std::transform(whole.begin(), whole.end(), bottom_.begin(),
                 [](const auto& cell) { return cell[0]; });
}

/// Makes room for light in rows that have none yet.
void CausticsLevel::reach(Band& band, RowsHit rows) const {
  const auto clear = [&](int begin, int end) {
    if (begin >= end) return;
    std::fill_n(band.light.data() + std::ptrdiff_t{begin} * stride(),
                std::ptrdiff_t{end - begin} * stride(), 0.0f);
  };
  const int first = rows.first + kBorder, last = rows.last + kBorder;
  if (band.last < band.first) {
    clear(first, last + 1);
    band.first = first, band.last = last;
    return;
  }
  clear(first, band.first);
  clear(band.last + 1, last + 1);
  band.first = std::min(band.first, first), band.last = std::max(band.last, last);
}

/// Sends a grid of rays; a band has some of its rows.
void CausticsLevel::send(const WaveRows& waves, const Sunlight& sun, const CausticsTarget& target,
                         int band) {
  Band& kept = bands_[static_cast<std::size_t>(band)];
  const Size size = layout_.size;
  kept.light.resize(static_cast<std::size_t>(stride()) * (size.height + 2 * kBorder));
  kept.first = 0, kept.last = -1;
  const double own = layout_.spacing;
  const int across = rays_over(size.width), down = rays_over(size.height);
  const int widest = own > 1 ? 3 : 2;
  const int begin = static_cast<int>(std::int64_t{down} * band / kBands);
  const int end = static_cast<int>(std::int64_t{down} * (band + 1) / kBands);
  const std::ptrdiff_t whole = across + 4 * kRoom;
  kept.rows.resize(20 * static_cast<std::size_t>(whole));
  kept.texels.resize(static_cast<std::size_t>(whole));
  const auto row_at = [&](int i) { return kept.rows.data() + i * whole + kRoom; };
  const SurfaceRow surface{row_at(0), row_at(1), row_at(2)};
  const SplatRow to{kept.texels.data(), row_at(12), row_at(16)};
  const auto lit_row = [&](int row) {
    const int nth = 3 + 3 * ((row + 3) % 3);
    return LitRow{row_at(nth), row_at(nth + 1), row_at(nth + 2)};
  };

  const double step = layout_.texel * own;
  const double first = (0.5 * own - 0.5) - layout_.margin;
  LightRow job{
      .sun_x = static_cast<float>(sun.to_sun.x),
      .sun_y = static_cast<float>(sun.to_sun.y),
      .sun_z = static_cast<float>(sun.to_sun.z),
      .ior = static_cast<float>(sun.ior),
      .eta = static_cast<float>(1 / sun.ior),
      .per_calm = static_cast<float>(sun.low ? 1 / sun.passes : 0),
      .calm_x = static_cast<float>(sun.aside.x),
      .calm_y = static_cast<float>(sun.aside.y),
      .share = static_cast<float>(own * own / sun.to_sun.z),
      .per_length = static_cast<float>(1 / layout_.texel),
      .first_x = 0,
      .step_x = static_cast<float>(own),
      .at_y = 0,
      .bottom = bottom_.data(),
      .across = cells_.width,
      .down = cells_.height,
      .per_cell = 1.0f / static_cast<float>(coarse_),
      .cell_x = static_cast<float>(layout_.margin + coarse_) / static_cast<float>(coarse_) - 0.5f,
      .edge = static_cast<float>(kSteep * coarse_ * layout_.texel /
                                 std::max(glm::length(sun.aside), 1e-9))};
  /// Traces the rays of a row and one more at each end, if the next row needs it, too.
  const auto follow = [&](int row) {
    Span span = rays_[std::clamp(row, 0, down - 1)];
    for (const int beside : {row - 1, row + 1}) {
      const Span more = rays_[std::clamp(beside, 0, down - 1)];
      if (span.empty()) span = more;
      if (!more.empty()) span = {std::min(span.begin, more.begin), std::max(span.end, more.end)};
    }
    if (span.empty()) return;
    const int count = span.end - span.begin + 2;
    const double at_x = first + (span.begin - 1) * own, at_y = first + row * own;
    job.first_x = static_cast<float>(at_x);
    job.at_y = static_cast<float>(at_y);
    waves.row(layout_.corner.x + at_x * layout_.texel, layout_.corner.y + at_y * layout_.texel,
              step, count, target, kept.room, surface);
    const LitRow lit = lit_row(row);
    const int from = span.begin - 1;
    target.follow(job, count, surface, {lit.x + from, lit.y + from, lit.power + from});
  };
  follow(begin - 1);
  follow(begin);
  for (int row = begin; row < end; ++row) {
    follow(row + 1);
    const Span span = rays_[row];
    if (span.empty()) continue;
    const auto part_of = [&](int of) {
      const LitRow lit = lit_row(of);
      return LitRow{lit.x + span.begin, lit.y + span.begin, lit.power + span.begin};
    };
    const int count = span.end - span.begin;
    const RowsHit hit = target.spread({part_of(row - 1), part_of(row), part_of(row + 1), size.width,
                                       size.height, stride(), widest},
                                      count, to);
    if (hit.last < hit.first) continue;
    reach(kept, hit);
    target.splat(to, count, stride(), widest, kept.light.data());
  }
}

/// The sum of the bands, filtered by [v/2, 1 - v, v/2] along each axis, where v is the variance of
/// the sun's disc on the bottom, in texels, less that of splat and lookup.
void CausticsLevel::finish(const Sunlight& sun, const CausticsTarget& target, int band) {
  const Size size = layout_.size;
  Band& own = bands_[static_cast<std::size_t>(band)];
  const int margin = layout_.margin + coarse_;
  const double level_square = 1 - sun.to_sun.z * sun.to_sun.z;
  const double ahead_x = level_square > 1e-12 ? sun.to_sun.x * sun.to_sun.x / level_square : 0.5;
  const double along = sun.along * sun.along, across = sun.across * sun.across;
  const auto spread = [&](double ahead) {
    const double square = along * ahead + across * (1 - ahead);
    return static_cast<float>(square / (layout_.texel * layout_.texel));
  };
  const float spread_x = spread(ahead_x), spread_y = spread(1 - ahead_x);
  const std::ptrdiff_t whole = size.width + 2 * kRoom;
  own.rows.resize(std::max(own.rows.size(), 6 * static_cast<std::size_t>(whole)));
  const auto row_at = [&](int i) { return own.rows.data() + i * whole + kRoom; };
  const auto half_at = [&](int y) { return row_at((std::clamp(y, 0, size.height - 1) + 3) % 3); };
  float* sum = row_at(3);
  // Depths of the last two rows of cells used.
  std::array<int, 2> cell_rows{-1, -1};
  const auto depths_at = [&](int y, const Span& span) {
    const int row = (y + margin) / coarse_;
    const std::size_t nth = static_cast<std::size_t>(row % 2);
    float* depths = row_at(4 + row % 2);
    if (cell_rows[nth] == row) return depths;
    cell_rows[nth] = row;
    const float* cells = bottom_.data() + std::ptrdiff_t{row} * cells_.width;
    for (int cell = (span.begin + margin) / coarse_; cell <= (span.end + margin) / coarse_;
         ++cell) {
      const int first = cell * coarse_ - margin;
      for (int x = std::max(first, -1); x < first + coarse_; ++x) depths[x] = cells[cell];
    }
    return depths;
  };
  const int begin = static_cast<int>(std::int64_t{size.height} * band / kBands);
  const int end = static_cast<int>(std::int64_t{size.height} * (band + 1) / kBands);
  own.least = own.most = 1;
  if (begin >= end) return;
  const Span wide = seen_in(begin, end);
  if (wide.empty()) {
    for (int y = begin; y < end; ++y) std::fill_n(light_.view().row(y), size.width, 1.0f);
    return;
  }
  const int count = wide.end - wide.begin;
  const auto add_up = [&](int y) {
    float *from = sum + wide.begin - 1, *until = sum + wide.end + 1;
    std::fill(from, until, 0.0f);
    for (const Band& part : bands_) {
      if (y + kBorder < part.first || y + kBorder > part.last) continue;
      const float* add =
          part.light.data() + std::ptrdiff_t{y + kBorder} * stride() + kBorder + wide.begin - 1;
      for (float* texel = from; texel < until; ++texel) *texel += *add++;
    }
    const float* here = sum + wide.begin;
    target.filter({here - 1, here, here + 1, depths_at(y, wide) + wide.begin, spread_x, kBlur},
                  count, half_at(y) + wide.begin);
  };
  add_up(std::max(begin - 1, 0));
  if (begin > 0) add_up(begin);
  for (int y = begin; y < end; ++y) {
    if (y + 1 < size.height) add_up(y + 1);
    const Span seen = seen_in(y, y + 1);
    float* out = light_.view().row(y);
    if (seen.empty()) {
      std::fill_n(out, size.width, 1.0f);
      continue;
    }
    const auto part_of = [&](int of) { return half_at(of) + seen.begin; };
    const Extremes found = target.filter({part_of(y - 1), part_of(y), part_of(y + 1),
                                          depths_at(y, wide) + seen.begin, spread_y, kBlur},
                                         seen.end - seen.begin, sum + seen.begin);
    own.least = std::min(own.least, found.least), own.most = std::max(own.most, found.most);
    std::fill_n(out, seen.begin, 1.0f);
    std::copy(sum + seen.begin, sum + seen.end, out + seen.begin);
    std::fill(out + seen.end, out + size.width, 1.0f);
  }
}

double CausticsLevel::least() const {
  float least = 1;
  for (const Band& band : bands_) least = std::min(least, band.least);
  return least;
}

double CausticsLevel::most() const {
  float most = 1;
  for (const Band& band : bands_) most = std::max(most, band.most);
  return most;
}

}  // namespace limpid
