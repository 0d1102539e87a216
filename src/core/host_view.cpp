#include "limpid/core/host_view.h"

#include <algorithm>
#include <cstdint>

namespace limpid {
namespace {

constexpr std::ptrdiff_t kFloat = sizeof(float);

/// First address, and one past the last.
struct Span {
  std::uintptr_t begin, end;
};

Span span_of(const HostInput& view) {
  const std::ptrdiff_t across = (view.window.width() - 1) * view.x_stride;
  const std::ptrdiff_t down = (view.window.height() - 1) * view.y_stride;
  const std::ptrdiff_t low =
      std::min<std::ptrdiff_t>(across, 0) + std::min<std::ptrdiff_t>(down, 0);
  const std::ptrdiff_t high =
      std::max<std::ptrdiff_t>(across, 0) + std::max<std::ptrdiff_t>(down, 0);
  const auto at = reinterpret_cast<std::uintptr_t>(view.data);
  return {at + static_cast<std::uintptr_t>(low),
          at + static_cast<std::uintptr_t>(high + bytes_of(view.sample))};
}

}  // namespace

bool is_floats(const HostInput& view) {
  return view.sample == Sample::kFloat &&
         reinterpret_cast<std::uintptr_t>(view.data) % kFloat == 0 && view.x_stride % kFloat == 0 &&
         view.y_stride % kFloat == 0;
}

View<const float> floats_of(const HostInput& view) {
  return {static_cast<const float*>(view.data), view.x_stride / kFloat, view.y_stride / kFloat,
          view.window};
}

View<float> floats_of(const HostOutput& view) {
  return {static_cast<float*>(view.data), view.x_stride / kFloat, view.y_stride / kFloat,
          view.window};
}

bool overlap(const HostInput& a, const HostInput& b) {
  if (!a || !b || a.window.empty() || b.window.empty()) return false;
  const Span one = span_of(a), other = span_of(b);
  return one.begin < other.end && other.begin < one.end;
}

}  // namespace limpid
