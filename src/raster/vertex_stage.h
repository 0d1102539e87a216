#pragma once
#include "raster/raster_job.h"
#include "raster/wide.h"

/// Transforms vertices to the screen, in double. For inclusion by raster_target.cpp alone.

namespace limpid::raster::HWY_NAMESPACE {

using namespace limpid::HWY_NAMESPACE;

/// A vertex outside of a half-space adds the half-space's bit.
LIMPID_LANES_INLINE VWD clip_bit(VWD distance, int bit) {
  return hn::IfThenElse(hn::Ge(distance, hn::Zero(kWD)), hn::Zero(kWD), wide(bit));  // NaN is out
}

/// kWide vertices; `positions` and `normals` have three floats per vertex, `uvs` two. `corners`,
/// `attributes`: room for kWide.
LIMPID_LANES_INLINE void transform_wide(const VertexTransform& t, const float* positions,
                                        const float* normals, const float* uvs, Corner* corners,
                                        Attributes* attributes) {
  VWF fx, fy, fz;
  hn::LoadInterleaved3(kWF, positions, fx, fy, fz);
  const VWD x = wide(fx), y = wide(fy), z = wide(fz);
  const auto row = [&](int r) { return hn::Add(dot_wide(t.row[r], x, y, z), wide(t.row[r][3])); };
  const VWD depth = row(VertexTransform::kDepth), one = wide(1.0);
  const VWD w = t.perspective ? depth : one;
  const VWD screen_x = row(VertexTransform::kX), screen_y = row(VertexTransform::kY);
  const VWD reach = hn::Mul(wide(kGuard), w);
  VWD bits = clip_bit(row(VertexTransform::kNearDistance), kNear);
  bits = hn::Add(bits, clip_bit(row(VertexTransform::kFarDistance), kFar));
  bits = hn::Add(bits, clip_bit(row(VertexTransform::kUserDistance), kUser));
  bits = hn::Add(bits, clip_bit(hn::Add(reach, screen_x), kLeft));
  bits = hn::Add(bits, clip_bit(hn::Sub(reach, screen_x), kRight));
  bits = hn::Add(bits, clip_bit(hn::Add(reach, screen_y), kTop));
  bits = hn::Add(bits, clip_bit(hn::Sub(reach, screen_y), kBottom));
  // Only the eye itself passes with w = 0: clipping removes it.
  const MWD inside = hn::And(hn::Eq(bits, hn::Zero(kWD)), hn::Gt(w, hn::Zero(kWD)));
  const VWD inverse = hn::Div(one, hn::IfThenElse(inside, w, one));
  const VWD fixed_x =
      hn::IfThenElse(inside, hn::Round(hn::Mul(screen_x, inverse)), hn::Add(wide(kClipped), bits));
  const VWD fixed_y = hn::IfThenElseZero(inside, hn::Round(hn::Mul(screen_y, inverse)));
  const VWD q = t.perspective ? hn::Min(inverse, wide(1e30)) : hn::Neg(depth);

  hn::LoadInterleaved3(kWF, normals, fx, fy, fz);
  const VWD nx = wide(fx), ny = wide(fy), nz = wide(fz);
  const VWD wx = dot_wide(t.normal[0], nx, ny, nz), wy = dot_wide(t.normal[1], nx, ny, nz),
            wz = dot_wide(t.normal[2], nx, ny, nz);
  const VWD square = hn::MulAdd(wx, wx, hn::MulAdd(wy, wy, hn::Mul(wz, wz)));
  const MWD some = hn::Gt(square, hn::Zero(kWD));
  const VWD unit =
      hn::IfThenElseZero(some, hn::Div(one, hn::Sqrt(hn::IfThenElse(some, square, one))));
  const auto single = [](VWD v) { return hn::DemoteTo(kWF, v); };
  const auto bits_of = [](VWD v) { return hn::BitCast(kWF, hn::DemoteTo(kWI, v)); };
  VWF u = hn::Zero(kWF), v = hn::Zero(kWF);
  if (uvs) hn::LoadInterleaved2(kWF, uvs, u, v);
  hn::StoreInterleaved4(bits_of(fixed_x), bits_of(fixed_y), single(q), single(hn::Mul(wx, unit)),
                        kWF, reinterpret_cast<float*>(corners));
  hn::StoreInterleaved4(single(hn::Mul(wy, unit)), single(hn::Mul(wz, unit)), u, v, kWF,
                        reinterpret_cast<float*>(attributes));
}

inline void copy_floats(const float* from, float* to, int count) {
  for (int i = 0; i < count; ++i) to[i] = from[i];
}

void transform(const DrawnInstance& instance, int first, int count, Corner* corners,
               Attributes* attributes) {
  const MeshView& m = instance.mesh;
  int i = first;
  for (; i + kWide <= first + count; i += kWide) {
    transform_wide(instance.transform, m.positions + 3 * std::ptrdiff_t{i},
                   m.normals + 3 * std::ptrdiff_t{i},
                   m.uvs ? m.uvs + 2 * std::ptrdiff_t{i} : nullptr, corners + i, attributes + i);
  }
  const int left = first + count - i;
  if (left <= 0) return;
  float positions[3 * kWide] = {}, normals[3 * kWide] = {}, uvs[2 * kWide] = {};
  Corner last_corners[kWide];
  Attributes last_attributes[kWide];
  copy_floats(m.positions + 3 * std::ptrdiff_t{i}, positions, 3 * left);
  copy_floats(m.normals + 3 * std::ptrdiff_t{i}, normals, 3 * left);
  if (m.uvs) copy_floats(m.uvs + 2 * std::ptrdiff_t{i}, uvs, 2 * left);
  transform_wide(instance.transform, positions, normals, m.uvs ? uvs : nullptr, last_corners,
                 last_attributes);
  for (int k = 0; k < left; ++k) {
    corners[i + k] = last_corners[k];
    attributes[i + k] = last_attributes[k];
  }
}

}  // namespace limpid::raster::HWY_NAMESPACE
