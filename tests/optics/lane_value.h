#pragma once
#include "limpid/core/vec.h"

#include "core/lanes.h"

/// The fused pass's number type, for the instruction set that the tests are compiled for.

namespace limpid::test {

using Lane = HWY_NAMESPACE::Lane;

inline double value(Lane x) { return hwy::HWY_NAMESPACE::GetLane(x.v); }
inline Vec3<double> value(Vec3<Lane> a) { return {value(a.x), value(a.y), value(a.z)}; }
inline Rgb<double> value(Rgb<Lane> a) { return {value(a.r), value(a.g), value(a.b)}; }
inline Vec3<Lane> lanes(Vec3<double> a) { return {Lane(a.x), Lane(a.y), Lane(a.z)}; }

}  // namespace limpid::test
