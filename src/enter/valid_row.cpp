#include "enter/valid_row.h"

#include <cfloat>
#include <cmath>
#include <limits>

namespace limpid {
namespace {

/// Without a branch, and in integers as wide as floats: compilers vectorise it, and it runs at the
/// speed of memory.
template <class At>
bool all_valid(const ValidRange& range, int count, At&& at) {
  const ValidRange r = range;
  int invalid = 0;
  for (int i = 0; i < count; ++i) {
    const float v = at(i);
    invalid |= static_cast<int>(!(((v >= r.least) & (v <= r.most)) | (v == r.besides)));
  }
  return invalid == 0;
}

}  // namespace

ValidRange valid_range(Sanitise kind, float nothing_hit) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  switch (kind) {
    case Sanitise::kColor:
      return {-FLT_MAX, FLT_MAX, kNone};
    case Sanitise::kDepth:
      return {-FLT_MAX, std::nextafter(nothing_hit, 0.0f), kInfinity};
    case Sanitise::kShadow:
    case Sanitise::kMask:
      return {0, 1, kNone};
    case Sanitise::kNormal:
      break;
  }
  return {1, -1, kNone};
}

bool row_is_valid(const ValidRange& range, const float* row, std::ptrdiff_t stride, int count) {
  if (stride == 1) return all_valid(range, count, [=](int i) { return row[i]; });
  return all_valid(range, count, [=](int i) { return row[i * stride]; });
}

}  // namespace limpid
