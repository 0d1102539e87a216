#pragma once
#include "raster/rich.h"

/// Visibility of triangles whose opacity decides whether a fragment exists. For inclusion by
/// raster_target.cpp alone.

namespace limpid::raster::HWY_NAMESPACE {

/// One triangle, loaded into lanes when its opacity is first needed: most triangles are hidden.
class TestedTriangle {
 public:
  LIMPID_LANES_INLINE TestedTriangle(const ShadeJob& job, std::int32_t id)
      : job_(job),
        id_(id),
        material_(job.materials[triangle_of(job, id).material & Triangle::kMaterial]) {}

  const MaterialView& material() const { return material_; }

  /// At the pixels (x ... x + kLanes - 1, y) from Screen::origin.
  Lane opacity(int x, int y, Mask covered) {
    if (!ready_) bring();
    Fragment f;
    f.covered = covered;
    const Shares shares = shares_of(job_, corners_, x, y, covered);
    interpolate(shares, corners_, f);
    const More more = more_at(job_, shares, more_corners_);
    return opacity_of(material_, texel_of(material_.base_texture, material_.base_lookup, f, more),
                      more);
  }

 private:
  void bring() {
    set_all<true>(job_, triangle_of(job_, id_), corners_);
    if (job_.more) {
      alignas(64) std::int32_t ids[kLanes];
      hn::Store(hn::Set(kDI, id_), kDI, ids);
      find_more(job_, ids, more_corners_);
    }
    ready_ = true;
  }

  const ShadeJob& job_;
  std::int32_t id_;
  const MaterialView& material_;
  bool ready_ = false;
  Corners corners_;
  MoreCorners more_corners_;
};

/// Fragments of an opacity of at least `from`.
struct OpacityTest {
  TestedTriangle& triangle;
  const Screen& tile;
  float from;

  M operator()(V, int x, int y, M put) const {
    if (hn::AllFalse(kD, put)) return put;
    const Lane opacity = triangle.opacity(tile.x0 + x, tile.y0 + y, {put});
    return hn::And(put, (opacity >= Lane(from)).m);
  }
};

/// Blended fragments behind the layer `before`. Layers are in the order of depth, layers of the
/// same depth in the order of drawing.
struct LayerTest {
  TestedTriangle& triangle;
  const Screen& tile;
  std::int32_t id;
  const Visibility& before;

  M operator()(V q, int x, int y, M put) const {
    const int at = y * kTileStride + x;
    const V last = hn::LoadU(kD, before.q + at);
    const VI sign = hn::Set(kDI, INT32_MIN);  // ids are unsigned
    const auto later =
        hn::Gt(hn::Xor(hn::Set(kDI, id), sign), hn::Xor(hn::LoadU(kDI, before.id + at), sign));
    const M behind = hn::Or(hn::Lt(q, last), hn::And(hn::Eq(q, last), hn::RebindMask(kD, later)));
    const M left = hn::And(put, behind);
    if (hn::AllFalse(kD, left)) return left;
    const Lane opacity = triangle.opacity(tile.x0 + x, tile.y0 + y, {left});
    const Mask blends =
        opacity >= Lane(kSeenFrom) && opacity < Lane(triangle.material().solid_from);
    return hn::And(left, blends.m);
  }
};

/// `from`: the least opacity of a fragment, by material.
inline void find_tested(const ShadeJob& job, const Tile& tile, int first_group, int end_group,
                        float MaterialView::*from, Visibility& out) {
  each_triangle(
      job, tile, first_group, end_group,
      [&](const EdgeBatch& batch, int l, std::int32_t id) LIMPID_LANES_LAMBDA {
        TestedTriangle triangle(job, id);
        draw(batch, l, id, out, OpacityTest{triangle, tile.pixels, triangle.material().*from});
      });
}

/// The nearest layer behind `before` and in front of `solid`.
inline void find_layer(const ShadeJob& job, const Tile& tile, const Visibility& solid,
                       const Visibility& before, Visibility& out) {
  const VI nothing = hn::Set(kDI, static_cast<std::int32_t>(kNothing));
  for (int i = 0; i < kTile * kTileStride; i += kLanes) {
    hn::Store(hn::Load(kD, solid.q + i), kD, out.q + i);
    hn::Store(nothing, kDI, out.id + i);
  }
  each_triangle(job, tile, job.unblended_groups, job.group_count,
                [&](const EdgeBatch& batch, int l, std::int32_t id) LIMPID_LANES_LAMBDA {
                  TestedTriangle triangle(job, id);
                  draw(batch, l, id, out, LayerTest{triangle, tile.pixels, id, before});
                });
}

}  // namespace limpid::raster::HWY_NAMESPACE
