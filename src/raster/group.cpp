#include "raster/group.h"

#include <algorithm>
#include <array>

namespace limpid::raster {
namespace {

/// The arrays of Survivors, one set per thread at a time.
struct Scratch {
  static constexpr int kRoom = kGroup + kSlack;
  std::array<std::array<std::int32_t, kRoom>, 9> arrays;

  Survivors survivors() {
    const auto array = [&](std::size_t i) { return arrays[i].data(); };
    return {{array(0), array(1), array(2)},
            array(3),
            array(4),
            array(5),
            array(6),
            array(7),
            array(8),
            0,
            0};
  }
};

}  // namespace

void Group::reset(const DrawnInstance& instance, int first, int count) {
  instance_ = &instance;
  first_ = first;
  count_ = count;
}

void Group::set_up(const RasterTarget& target, const Screen& screen, const Corner* corners) {
  const auto scratch = std::make_unique_for_overwrite<Scratch>();
  Survivors survivors = scratch->survivors();
  target.cull(*instance_, screen, corners, first_, count_, survivors);
  clipped_.clear();
  for (int i = 0; i < survivors.clip_count; ++i) {
    clip(*instance_, screen, corners, static_cast<std::uint32_t>(survivors.to_clip[i]), clipped_);
  }
  whole_ = survivors.count;
  total_ = whole_ + static_cast<int>(clipped_.pieces.size());
  Triangle* triangles = triangles_.take(static_cast<std::size_t>(total_));
  target.set_up(*instance_, corners, survivors, triangles);

  TileBox* boxes = boxes_.take(static_cast<std::size_t>(total_));
  const auto box_of = [&](int x0, int y0, int x1, int y1) {
    const auto tile = [](int pixel, int from) {
      return static_cast<std::int16_t>((pixel - from) / kTile);
    };
    if (x1 < x0) return TileBox{0, 0, -1, -1};
    return TileBox{tile(x0, screen.x0), tile(y0, screen.y0), tile(x1, screen.x0),
                   tile(y1, screen.y0)};
  };
  for (int i = 0; i < whole_; ++i) {
    boxes[i] = box_of(survivors.x0[i], survivors.y0[i], survivors.x1[i], survivors.y1[i]);
  }
  for (int i = whole_; i < total_; ++i) {
    const ClippedPieces::Piece& p = clipped_.pieces[static_cast<std::size_t>(i - whole_)];
    triangles[i] = p.triangle;
    boxes[i] = box_of(p.x0, p.y0, p.x1, p.y1);
  }
  sort_into_tiles();
}

/// A counting sort: entries of a tile stay in the order of the triangles.
void Group::sort_into_tiles() {
  const TileBox* boxes = boxes_.data();
  GroupView& v = view_;
  v = {triangles_.data(), nullptr, nullptr, 32767, 32767, 0, 0};
  for (int i = 0; i < total_; ++i) {
    if (boxes[i].x1 < boxes[i].x0) continue;
    v.tx0 = std::min<int>(v.tx0, boxes[i].x0);
    v.ty0 = std::min<int>(v.ty0, boxes[i].y0);
    v.tx1 = std::max<int>(v.tx1, boxes[i].x1 + 1);
    v.ty1 = std::max<int>(v.ty1, boxes[i].y1 + 1);
  }
  if (v.tx1 <= v.tx0) {
    v.tx0 = v.ty0 = v.tx1 = v.ty1 = 0;
    return;
  }
  const int across = v.tx1 - v.tx0;
  const std::size_t tiles =
      static_cast<std::size_t>(across) * static_cast<std::size_t>(v.ty1 - v.ty0);
  std::uint32_t* offsets = offsets_.take(tiles + 2);
  std::fill(offsets, offsets + tiles + 2, 0u);
  const auto for_tiles = [&](int i, auto&& visit) {
    for (int ty = boxes[i].y0; ty <= boxes[i].y1; ++ty) {
      for (int tx = boxes[i].x0; tx <= boxes[i].x1; ++tx) {
        visit((ty - v.ty0) * across + tx - v.tx0);
      }
    }
  };
  // Counts are stored two places ahead; after the sums and the filling they are in place.
  for (int i = 0; i < total_; ++i) {
    for_tiles(i, [&](int tile) { ++offsets[tile + 2]; });
  }
  for (std::size_t t = 2; t < tiles + 2; ++t) offsets[t] += offsets[t - 1];
  std::uint32_t* entries = entries_.take(offsets[tiles + 1]);
  for (int i = 0; i < total_; ++i) {
    for_tiles(i, [&](int tile) { entries[offsets[tile + 1]++] = static_cast<std::uint32_t>(i); });
  }
  v.entries = entries;
  v.offsets = offsets;
}

void Group::place_new_corners(std::uint32_t first, Corner* corners, Attributes* attributes,
                              MoreAttributes* more) {
  std::copy(clipped_.corners.begin(), clipped_.corners.end(), corners + first);
  std::copy(clipped_.attributes.begin(), clipped_.attributes.end(), attributes + first);
  if (more) std::copy(clipped_.more.begin(), clipped_.more.end(), more + first);
  for (int i = whole_; i < total_; ++i) {
    for (std::uint32_t& corner : triangles_.data()[i].corner) corner += first;
  }
}

}  // namespace limpid::raster
