#include "complete/edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "limpid/core/plane.h"

#include "complete/edge_blur.h"
#include "complete/edge_matte.h"
#include "complete/edge_picture.h"
#include "complete/rows.h"
#include "core/edge_cover.h"

namespace limpid {
namespace {

using Steps = std::vector<EdgeBlur::Step>;

/// A smaller cover, or a smaller rest, counts as 0.
constexpr double kLeast = 0.02;

/// Width of the blur around a pixel, across vertical and across horizontal edges: a rung of
/// EdgeBlur::kLadder, 0 for none.
struct Band {
  std::array<std::uint8_t, 2> rung{};
  bool none() const { return rung[0] == 0 && rung[1] == 0; }
};

/// Tiles of this many pixels square share their statistics of edges.
constexpr int kTile = 64;

/// The pixels around a pixel of a band that count, and their weight: a Gaussian that reaches from
/// one end of the band beyond the other, sampled at about a dozen places along each axis.
struct Kernel {
  int step = 1, reach = 0;
  std::array<double, 8> weight{};  ///< at 0, step, 2 step ...
  std::array<int, 8> width{};      ///< half width of each row of the disc

  static Kernel of(int half_width) {
    Kernel kernel;
    const int radius = 3 * half_width + 2;
    kernel.step = (radius + 5) / 6;
    kernel.reach = radius / kernel.step;
    for (int i = 0; i <= kernel.reach; ++i) {
      const double sigmas = 2.0 * i * kernel.step / radius;
      const auto at = static_cast<std::size_t>(i);
      kernel.weight[at] = std::exp(-0.5 * sigmas * sigmas);
      kernel.width[at] = static_cast<int>(std::sqrt(kernel.reach * kernel.reach - i * i + 0.5));
    }
    return kernel;
  }
};

/// A pixel, and 1 / depth of its water.
struct Place {
  int x, y;
  double water;
};

/// Columns of a row from the first to the last in a band.
struct Span {
  int begin = std::numeric_limits<int>::max(), end = std::numeric_limits<int>::min();
};

}  // namespace

struct __attribute__((visibility("hidden"))) Edges::State {
  std::array<Kernel, EdgeBlur::kWidths + 1> kernels;
  EdgeCover cover;
  std::array<Plane, 4> planes;                          ///< R G B depth
  std::vector<std::uint8_t> sides;                      ///< of each pixel
  std::vector<Band> bands;                              ///< that each pixel lies in
  std::vector<Span> spans;                              ///< of each row
  std::vector<EdgePicture::Row> rows;                   ///< likewise
  std::vector<Steps> steps;                             ///< of each row of tiles
  std::array<std::vector<EdgeBlur::Growth>, 2> growth;  ///< of each tile, to the right and down
  std::vector<EdgeBlur::Growth> resolved;               ///< of each row of tiles, no speckles
  std::array<std::vector<int>, 2> rungs;                ///< of EdgeBlur::kLadder, of each tile

  /// Copies color and depth into planes of this object.
  void take_over(Frame& frame, Executor& executor) {
    constexpr std::array kMended{PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB,
                                 PlaneId::kDepth};
    for (std::size_t i = 0; i < kMended.size(); ++i) {
      View<const float>& view = frame.planes[index_of(kMended[i])];
      if (!planes[i] || planes[i].view().window != view.window) planes[i] = Plane(view.window);
      const View<float> to = planes[i].view();
      each_row(executor, view.window, [&](int y) {
        const float* from = view.row(y);
        float* row = to.row(y);
        if (view.x_stride == 1) {
          std::copy_n(from, view.window.width(), row);
        } else {
          for (int x = 0; x < view.window.width(); ++x) row[x] = from[x * view.x_stride];
        }
      });
      view = to;
    }
    frame.edges = &cover;
  }

  void clear_cover(const Rect& window) {
    cover.first_row = window.y0;
    cover.rows.resize(static_cast<std::size_t>(window.height()));
    for (auto& row : cover.rows) row.clear();
  }
  std::vector<EdgeCover::Pixel>& cover_of(int y) {
    return cover.rows[static_cast<std::size_t>(y - cover.first_row)];
  }

  void put(int x, int y, const Rgb<float>& color, double inverse_depth) {
    planes[0].view().at(x, y) = color.r;
    planes[1].view().at(x, y) = color.g;
    planes[2].view().at(x, y) = color.b;
    put_depth(x, y, inverse_depth);
  }
  void put_depth(int x, int y, double inverse_depth) {
    planes[3].view().at(x, y) = static_cast<float>(1 / inverse_depth);
  }

  void take_deep(Frame& frame, const Pass& pass, Executor& executor);
  bool find_bands(const EdgePicture& picture, Executor& executor);
  EdgeBlur::Growth growth_around(std::size_t down, int tile, const Rect& tiles) const;
  void paint(const EdgePicture& picture, const EdgeBlur::Step& step, int rung);
  void part_row(const EdgePicture& picture, int y);
  template <class See>
  void each_around(const EdgePicture& picture, const Place& place, const Kernel& kernel,
                   const See& see) const;
  EdgeAround sides_around(const EdgePicture& picture, const Place& place,
                          const Kernel& kernel) const;
  void add_band(const EdgePicture& picture, const Place& place, const Kernel& kernel,
                EdgeAround& sums) const;
  double inverse_depth_around(const EdgePicture& picture, const Place& place, const Kernel& kernel,
                              Side side) const;
  std::optional<Matte> matte_at(const EdgePicture& picture, const Place& place, const Band& band,
                                const Kernel*& kernel) const;
  void part(const EdgePicture& picture, const Place& place, const Band& band);

  Side side_at(const EdgePicture& picture, int x, int y) const {
    return static_cast<Side>(sides[index(picture, x, y)]);
  }
  /// Whether a pixel is dry between two wet ones.
  bool is_thin(const EdgePicture& picture, int x, int y) const {
    const Rect& w = picture.window;
    const auto wet = [&](int column, int row) {
      return side_at(picture, column, row) == Side::kWet;
    };
    return side_at(picture, x, y) == Side::kDry &&
           ((x > w.x0 && x + 1 < w.x1 && wet(x - 1, y) && wet(x + 1, y)) ||
            (y > w.y0 && y + 1 < w.y1 && wet(x, y - 1) && wet(x, y + 1)));
  }

  static std::size_t index(const EdgePicture& picture, int x, int y) {
    const Rect& w = picture.window;
    return static_cast<std::size_t>(y - w.y0) * static_cast<std::size_t>(w.width()) +
           static_cast<std::size_t>(x - w.x0);
  }
};

/// The layer below is the scene behind the objects.
void Edges::State::take_deep(Frame& frame, const Pass& pass, Executor& executor) {
  if (!frame.present().covers(kBelowPlanes)) return;
  const std::array<View<const float>, 4> before = frame.foreground;
  const Frame given = frame;
  const EdgePicture picture(frame, pass);
  Rect window = intersection(picture.window, before[3].window);
  for (int i = 0; i < 4; ++i) {
    window = intersection(window, frame.plane(plane_after(PlaneId::kBelowR, i)).window);
  }
  clear_cover(window);
  take_over(frame, executor);
  each_row(executor, window, [&](int y) {
    const EdgePicture::Water water(picture, y);
    for (int x = window.x0; x < window.x1; ++x) {
      const float cover_here = before[3].at(x, y);
      const double behind = 1.0 / given.plane(PlaneId::kBelowDepth).at(x, y);
      if (!(cover_here > 0 && cover_here < 1) || !(behind < water.inverse_depth(x))) continue;
      const auto below = [&](int i) {
        return given.plane(plane_after(PlaneId::kBelowR, i)).at(x, y);
      };
      put(x, y, {below(0), below(1), below(2)}, behind);
      cover_of(y).push_back(
          {x, cover_here, {before[0].at(x, y), before[1].at(x, y), before[2].at(x, y)}});
    }
  });
}

/// Whether any pixel lies in the band of a blurred edge.
bool Edges::State::find_bands(const EdgePicture& picture, Executor& executor) {
  const Rect& w = picture.window;
  const auto width = static_cast<std::size_t>(w.width());
  const EdgeBlur blur(picture);
  steps.resize(static_cast<std::size_t>((w.height() + kTile - 1) / kTile));
  if (!blur.any(sides, steps[0])) return false;

  sides.resize(width * static_cast<std::size_t>(w.height()));
  const auto sides_of = [&](int y) { return sides.data() + width * (y - w.y0); };
  each_row(executor, w, [&](int y) { picture.sides(y, w.x0, w.x1, sides_of(y)); });

  const Rect tiles{0, 0, (w.width() + kTile - 1) / kTile, static_cast<int>(steps.size())};
  const auto tile_of = [&](const EdgeBlur::Step& step) {
    return static_cast<std::size_t>((step.y - w.y0) / kTile * tiles.width() +
                                    (step.x - w.x0) / kTile);
  };
  for (auto& list : growth) list.assign(static_cast<std::size_t>(tiles.area()), {});
  resolved.assign(static_cast<std::size_t>(tiles.height()), {});
  each_row(executor, tiles, [&](int row) {
    Steps& found = steps[static_cast<std::size_t>(row)];
    found.clear();
    const int begin = w.y0 + row * kTile, end = std::min(begin + kTile, w.y1);
    for (int y = begin; y < end; ++y) {
      blur.find(y, sides_of(y), y + 1 < w.y1 ? sides_of(y + 1) : nullptr, found);
    }
    for (const EdgeBlur::Step& step : found) {
      const EdgeBlur::Growth grown = blur.growth_of(step, EdgeBlur::kWidths);
      growth[step.down][tile_of(step)].add(grown);
      if (!step.speckle) resolved[static_cast<std::size_t>(row)].add(grown);
    }
  });

  // A filter covers the whole picture, also objects thinner than a pixel, and edges beside others
  // or beside textures: their own steps do not show it. A blur that is wider somewhere could be
  // taken for a filter.
  EdgeBlur::Growth whole;
  for (const EdgeBlur::Growth& of_row : resolved) whole.add(of_row);
  const bool filtered = whole.is_blurred(), no_wider = !whole.grows_at(1);
  for (std::size_t down = 0; down < 2; ++down) {
    rungs[down].resize(growth[down].size());
    for (int tile = 0; tile < static_cast<int>(tiles.area()); ++tile) {
      const EdgeBlur::Growth around = growth_around(down, tile, tiles);
      rungs[down][static_cast<std::size_t>(tile)] =
          std::max(around.full_at(), filtered && (no_wider || around.is_speckled()) ? 1 : 0);
    }
  }
  bands.assign(sides.size(), {});
  spans.assign(static_cast<std::size_t>(w.height()), {});
  bool some = false;
  for (const Steps& list : steps) {
    for (const EdgeBlur::Step& step : list) {
      const int rung = rungs[step.down][tile_of(step)];
      if (rung > 0) paint(picture, step, rung);
      some |= rung > 0;
    }
  }
  return some;
}

/// Over a tile and its neighbours: an edge in the tile's corner belongs to the next tile as well.
EdgeBlur::Growth Edges::State::growth_around(std::size_t down, int tile, const Rect& tiles) const {
  EdgeBlur::Growth sum;
  const int column = tile % tiles.x1, row = tile / tiles.x1;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, tiles.y1 - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, tiles.x1 - 1); ++x) {
      sum.add(growth[down][static_cast<std::size_t>(y * tiles.x1 + x)]);
    }
  }
  return sum;
}

/// The step is between two pixels, both of which may be in the band.
void Edges::State::paint(const EdgePicture& picture, const EdgeBlur::Step& step, int rung) {
  const Rect& w = picture.window;
  const int full = EdgeBlur::kLadder[static_cast<std::size_t>(rung)];
  // Nearly full counts as full; the filter's box of one pixel ends in the pixels of the step.
  const int half = rung == 1 ? 0 : full + full / 4;
  const int across = step.down ? 0 : half, along = step.down ? half : 0;
  const Rect both{step.x, step.y, step.x + (step.down ? 1 : 2), step.y + (step.down ? 2 : 1)};
  const Rect band =
      intersection(w, {both.x0 - across, both.y0 - along, both.x1 + across, both.y1 + along});
  for (int y = band.y0; y < band.y1; ++y) {
    Span& span = spans[static_cast<std::size_t>(y - w.y0)];
    span = {std::min(span.begin, band.x0), std::max(span.end, band.x1)};
    for (int x = band.x0; x < band.x1; ++x) {
      std::uint8_t& here = bands[index(picture, x, y)].rung[step.down];
      here = std::max(here, static_cast<std::uint8_t>(rung));
    }
  }
}

void Edges::State::part_row(const EdgePicture& picture, int y) {
  const EdgePicture::Water water(picture, y);
  const Span span = spans[static_cast<std::size_t>(y - picture.window.y0)];
  for (int x = span.begin; x < span.end; ++x) {
    const Band& band = bands[index(picture, x, y)];
    if (band.none()) continue;
    const Place place{x, y, water.inverse_depth(x)};
    if (place.water > 0) part(picture, place, band);
  }
}

/// The pixels around a pixel: see(weight, right, down, texels, column, is wet, is sure). Dry pixels
/// behind the pixel's water do not count.
template <class See>
void Edges::State::each_around(const EdgePicture& picture, const Place& place, const Kernel& kernel,
                               const See& see) const {
  const Rect& w = picture.window;
  const double water_depth = 1 / place.water;
  const int left = (place.x - w.x0) / kernel.step, right = (w.x1 - 1 - place.x) / kernel.step;
  for (int j = -kernel.reach; j <= kernel.reach; ++j) {
    const int row = place.y + j * kernel.step;
    if (row < w.y0 || row >= w.y1) continue;
    const EdgePicture::Row& texels = rows[static_cast<std::size_t>(row - w.y0)];
    const std::size_t at_place = index(picture, place.x, row);
    const double row_weight = kernel.weight[static_cast<std::size_t>(std::abs(j))];
    const int reach = kernel.width[static_cast<std::size_t>(std::abs(j))];
    for (int i = -std::min(reach, left); i <= std::min(reach, right); ++i) {
      const int column = place.x + i * kernel.step;
      const std::size_t at = at_place + static_cast<std::size_t>(i * kernel.step);
      const Side side = static_cast<Side>(sides[at]);
      const bool wet = side == Side::kWet;
      if (!wet && (side == Side::kNone || !(texels.depth(column) < water_depth))) continue;
      const double weight = row_weight * kernel.weight[static_cast<std::size_t>(std::abs(i))];
      see(weight, i, j, texels, column, wet, bands[at].none());
    }
  }
}

/// The moments of the sure pixels, and the weights of the band's pixels.
EdgeAround Edges::State::sides_around(const EdgePicture& picture, const Place& place,
                                      const Kernel& kernel) const {
  const Rgb<double> color = picture.color_at(place.x, place.y);
  EdgeAround sums;
  each_around(picture, place, kernel,
              [&](double weight, int, int, const EdgePicture::Row& texels, int column, bool wet,
                  bool sure) {
                EdgeMoments& moments = sums.kinds[static_cast<std::size_t>(wet + 2 * sure)];
                if (sure) {
                  moments.add(weight, texels.color(column) - color, texels.alpha(column));
                } else {
                  moments.weight += weight;
                }
              });
  return sums;
}

/// The moments of the band's pixels.
void Edges::State::add_band(const EdgePicture& picture, const Place& place, const Kernel& kernel,
                            EdgeAround& sums) const {
  const Rgb<double> color = picture.color_at(place.x, place.y);
  sums.of(EdgeKind::kDry) = sums.of(EdgeKind::kWet) = {};
  each_around(picture, place, kernel,
              [&](double weight, int, int, const EdgePicture::Row& texels, int column, bool wet,
                  bool sure) {
                if (sure) return;
                EdgeMoments& moments = sums.kinds[static_cast<std::size_t>(wet)];
                moments.add(weight, texels.color(column) - color, texels.alpha(column));
              });
}

/// Inverse depth of the dry pixels around the pixel, or of the surely wet pixels; 0 without any.
double Edges::State::inverse_depth_around(const EdgePicture& picture, const Place& place,
                                          const Kernel& kernel, Side side) const {
  EdgePlane plane;
  each_around(picture, place, kernel,
              [&](double weight, int i, int j, const EdgePicture::Row& texels, int column, bool wet,
                  bool sure) {
                if (wet != (side == Side::kWet) || (wet && !sure)) return;
                plane.add(weight, i, j, 1 / texels.depth(column));
              });
  return plane.most > 0 ? plane.here() : 0;
}

/// The pixel's share, and the kernel whose surroundings determine it, if any does. The blur across
/// a nearly parallel direction looks far wider than the true blur: so the narrower of both
/// directions is tried first. In the middle of a thin object the water begins beyond all of its
/// blur: so a wider kernel is tried last.
std::optional<Matte> Edges::State::matte_at(const EdgePicture& picture, const Place& place,
                                            const Band& band, const Kernel*& kernel) const {
  const auto [narrow, wide] = std::minmax(band.rung[0], band.rung[1]);
  const std::array<std::size_t, 3> tries{narrow, wide, wide + std::size_t{1}};
  const std::size_t first = narrow == 0 || narrow == wide ? 1 : 0;
  std::array<EdgeAround, 3> seen;
  for (std::size_t i = first; i < tries.size(); ++i) {
    kernel = &kernels[tries[i]];
    seen[i] = sides_around(picture, place, *kernel);
    const EdgeMoments& wet = seen[i].of(EdgeKind::kSureWet);
    std::optional<Matte> matte = matte_between(seen[i]);
    if (picture.alpha && wet.weight > 0 && wet.alpha < 0.05 * wet.weight) {
      matte = Matte{picture.alpha.at(place.x, place.y), wet.mean()};
    }
    if (matte) return matte;
  }
  for (std::size_t i = first; i < tries.size(); ++i) {
    if (!may_regress(seen[i])) continue;
    kernel = &kernels[tries[i]];
    add_band(picture, place, *kernel, seen[i]);
    if (const std::optional<Matte> matte = matte_by_regression(seen[i])) return matte;
  }
  // An object in a pixel of the water's color covers little of it: only the one sample of depth hit
  // the object.
  const bool unseen = is_thin(picture, place.x, place.y) && may_regress(seen.back()) &&
                      looks_wet(seen.back(), picture.color_at(place.x, place.y));
  return unseen ? std::optional(Matte{0, {0, 0, 0}}) : std::nullopt;
}

void Edges::State::part(const EdgePicture& picture, const Place& place, const Band& band) {
  const auto [x, y, water] = place;
  const Kernel* kernel = nullptr;
  const std::optional<Matte> matte = matte_at(picture, place, band, kernel);
  if (!matte) return;
  const bool is_wet = side_at(picture, x, y) == Side::kWet;
  if (is_wet ? matte->cover < kLeast : matte->cover > 1 - kLeast) return;
  if (matte->cover > 1 - kLeast) {
    const double before = inverse_depth_around(picture, place, *kernel, Side::kDry);
    if (before > 0) put_depth(x, y, before);
    return;
  }
  const double behind = inverse_depth_around(picture, place, *kernel, Side::kWet);
  if (!(behind < water)) return;
  const double open = 1 - matte->cover;
  // Light from an object in front is not negative.
  const auto shared = [&](double whole, double part) {
    return std::clamp(whole + part, 0.0, std::max(whole, 0.0) / open);
  };
  const Rgb<double> color = picture.color_at(x, y);
  const Rgb<double> beyond{shared(color.r, matte->behind.r), shared(color.g, matte->behind.g),
                           shared(color.b, matte->behind.b)};
  const auto narrow = [](const Rgb<double>& c) {
    return Rgb<float>{static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
  };
  put(x, y, narrow(beyond), behind);
  cover_of(y).push_back({x, static_cast<float>(matte->cover), narrow(color - open * beyond)});
}

Edges::Edges() : state_(std::make_unique<State>()) {
  for (std::size_t i = 0; i < state_->kernels.size(); ++i) {
    state_->kernels[i] = Kernel::of(EdgeBlur::kLadder[i]);
  }
}
Edges::~Edges() = default;
Edges::Edges(Edges&&) noexcept = default;
Edges& Edges::operator=(Edges&&) noexcept = default;

void Edges::make(Frame& frame, const Pass& pass, Executor& executor) {
  if (pass.submersible) return;
  State& s = *state_;
  if (frame.foreground[3]) return s.take_deep(frame, pass, executor);
  const EdgePicture picture(frame, pass);
  if (picture.window.empty() || !s.find_bands(picture, executor)) return;
  static_assert(EdgeBlur::kLadder[EdgeBlur::kWidths - 1] == kFarthest);
  s.clear_cover(picture.window);
  s.take_over(frame, executor);
  s.rows.clear();
  for (int y = picture.window.y0; y < picture.window.y1; ++y) s.rows.emplace_back(picture, y);
  each_row(executor, picture.window, [&](int y) { s.part_row(picture, y); });
}

}  // namespace limpid
