#include "enter/half.h"

#include "limpid/core/simd.h"

namespace limpid {

// One for each instruction set that the build names, defined in half_target.cpp.
#define LIMPID_TARGET(name, highway) extern const HalfTarget kHalf_##name;
#include "core/targets.inc"
#undef LIMPID_TARGET

namespace {

constexpr const HalfTarget* kTargets[] = {
#define LIMPID_TARGET(name, highway) &kHalf_##name,
#include "core/targets.inc"
#undef LIMPID_TARGET
};

}  // namespace

const HalfTarget& half_target(const std::string& simd) { return *kTargets[simd_index(simd)]; }

}  // namespace limpid
