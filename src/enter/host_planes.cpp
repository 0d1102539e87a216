#include "enter/host_planes.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "limpid/core/error.h"

#include "enter/nothing_hit.h"
#include "enter/valid_row.h"

namespace limpid {
namespace {

constexpr int kBandRows = 32;

void copy_row(const HostInput& from, int y, float* to, const HalfTarget& half) {
  const auto* row = static_cast<const std::byte*>(from.data) + (y - from.window.y0) * from.y_stride;
  const int count = from.window.width();
  if (from.sample == Sample::kHalf) {
    half.widen(row, from.x_stride, to, count);
  } else if (from.x_stride == sizeof(float)) {
    std::memcpy(to, row, sizeof(float) * static_cast<std::size_t>(count));
  } else {
    for (int x = 0; x < count; ++x) std::memcpy(to + x, row + x * from.x_stride, sizeof(float));
  }
}

/// Whether an alpha plane is 0 there; false outside of it.
bool is_zero(const HostInput& alpha, int x, int y) {
  if (!alpha.window.contains({x, y, x + 1, y + 1})) return false;
  const auto* row = static_cast<const std::byte*>(alpha.data) +
                    std::ptrdiff_t{y - alpha.window.y0} * alpha.y_stride;
  const std::byte* at = row + std::ptrdiff_t{x - alpha.window.x0} * alpha.x_stride;
  if (alpha.sample == Sample::kHalf) {
    std::uint16_t half;
    std::memcpy(&half, at, sizeof half);
    return (half & 0x7fff) == 0;  // +0 or -0
  }
  float value;
  std::memcpy(&value, at, sizeof value);
  return value == 0;
}

View<float> rows_of(const View<float>& view, int y0, int y1) {
  const Rect& w = view.window;
  return {view.row(y0), view.x_stride, view.y_stride, {w.x0, y0, w.x1, y1}};
}

}  // namespace

/// Bands of rows are the tasks: those of each role that is copied, one after another.
struct EnteredPlanes::Entry {
  EnteredPlanes& self;
  const HostPlanes& host;
  const EntryRules& rules;
  PlaneSet wanted;  ///< wanted and present

  PlaneRoute& route(const Role& role) const { return self.routes_[index_of(role.first)]; }
  HostInput plane(const Role& role, int i) const {
    const PlaneId id = plane_after(role.first, i);
    return wanted.has(id) ? host[index_of(id)] : HostInput{};
  }
  /// Whether this is the depth of a scene whose alpha tells where a surface was hit.
  bool covered(const Role& role) const {
    return role.first == PlaneId::kDepth && !rules.trusted && host[index_of(PlaneId::kColorA)];
  }
  static int bands(const PlaneRoute& route) {
    return (route.window.height() + kBandRows - 1) / kBandRows;
  }

  void decide(const Role& role) const {
    PlaneRoute& route = this->route(role);
    route.watched = route.copied = false;
    route.window = {};
    route.wrong = false;
    route.nan = route.inf = 0;
    for (int i = 0; i < role.count; ++i) {
      const HostInput view = plane(role, i);
      if (!view) continue;
      const Rect& w = view.window;
      if (w.empty()) throw Error("frame: " + std::string(role.name) + " has no pixels");
      if (role.sanitise == Sanitise::kNormal && !route.window.empty() && w != route.window) {
        throw Error("frame: " + std::string(role.name) + " has components of several sizes");
      }
      route.window = route.window.empty()
                         ? w
                         : Rect{std::min(route.window.x0, w.x0), std::min(route.window.y0, w.y0),
                                std::max(route.window.x1, w.x1), std::max(route.window.y1, w.y1)};
      route.copied |= !is_floats(view) || rules.written.has(plane_after(role.first, i));
    }
    if (route.window.empty()) return;
    const bool read_anew = rules.depth.kind != DepthKind::kEye || rules.depth.nothing;
    route.copied |= role.sanitise == Sanitise::kDepth && read_anew;
    route.copied |= role.sanitise == Sanitise::kNormal && !rules.trusted;
    route.watched = !route.copied && !rules.trusted;
    if (!route.copied && !route.watched) return;
    for (int i = 0; i < role.count; ++i) {
      const HostInput view = plane(role, i);
      Plane& own = self.planes_[index_of(plane_after(role.first, i))];
      if (view && (!own || own.view().window != view.window)) own = Plane(view.window);
    }
  }

  void watch(const Role& role, int y0, int y1) const {
    PlaneRoute& route = this->route(role);
    const ValidRange range = valid_range(role.sanitise);
    for (int i = 0; i < role.count; ++i) {
      const HostInput view = plane(role, i);
      if (!view) continue;
      const View<const float> floats = floats_of(view);
      for (int y = std::max(y0, view.window.y0); y < std::min(y1, view.window.y1); ++y) {
        if (route.wrong.load(std::memory_order_relaxed)) return;
        const auto* row = floats.row(y);
        const int count = view.window.width();
        const bool zero = covered(role) && row_has(0, row, floats.x_stride, count);
        if (zero || !row_is_valid(range, row, floats.x_stride, count)) {
          route.wrong.store(true, std::memory_order_relaxed);
        }
      }
    }
  }

  void copy(const Role& role, int y0, int y1) const {
    std::array<View<float>, 4> band;
    Replaced replaced;
    for (int i = 0; i < role.count; ++i) {
      const HostInput from = plane(role, i);
      if (!from) continue;
      const int begin = std::max(y0, from.window.y0), end = std::min(y1, from.window.y1);
      if (begin >= end) continue;
      View<float>& rows = band[static_cast<std::size_t>(i)];
      rows = rows_of(self.planes_[index_of(plane_after(role.first, i))].view(), begin, end);
      for (int y = begin; y < end; ++y) copy_row(from, y, rows.row(y), *rules.half);
      DepthSource depth = rules.depth;
      depth.half = from.sample == Sample::kHalf;
      const HostInput& alpha = host[index_of(PlaneId::kColorA)];
      if (covered(role)) depth.uncovered = [&](int x, int y) { return is_zero(alpha, x, y); };
      if (role.sanitise == Sanitise::kDepth) {
        const bool read_anew = depth.kind != DepthKind::kEye || depth.nothing;
        if (!rules.trusted || read_anew) replaced += make_eye_depth(rows, depth);
      } else if (!rules.trusted) {
        if (role.sanitise == Sanitise::kColor) {
          replaced += sanitise_color(rows, largest_of(plane_after(role.first, i)));
        }
        if (role.sanitise == Sanitise::kShadow) replaced += sanitise_shadow(rows);
        if (role.sanitise == Sanitise::kMask) replaced += sanitise_mask(rows);
      }
    }
    if (role.sanitise == Sanitise::kNormal && !rules.trusted && band[0] && band[1] && band[2]) {
      replaced += sanitise_normal(band[0], band[1], band[2], rules.up);
    }
    route(role).nan.fetch_add(replaced.nan, std::memory_order_relaxed);
    route(role).inf.fetch_add(replaced.inf, std::memory_order_relaxed);
  }

  template <bool PlaneRoute::*kGoes, void (Entry::*kStep)(const Role&, int, int) const>
  void run(Executor& executor) const {
    int count = 0;
    for (const Role& role : roles()) count += route(role).*kGoes ? bands(route(role)) : 0;
    if (count == 0) return;
    run_each(executor, count, [&](int index) {
      for (const Role& role : roles()) {
        const PlaneRoute& of_role = route(role);
        if (!(of_role.*kGoes)) continue;
        if (index < bands(of_role)) {
          const int y0 = of_role.window.y0 + index * kBandRows;
          return (this->*kStep)(role, y0, std::min(y0 + kBandRows, of_role.window.y1));
        }
        index -= bands(of_role);
      }
    });
  }
};

SanitiseCounts EnteredPlanes::enter(const HostPlanes& host, PlaneSet wanted,
                                    const EntryRules& rules, Executor& executor, Frame& frame) {
  const Entry entry{*this, host, rules, wanted};
  for (const Role& role : roles()) entry.decide(role);
  entry.run<&PlaneRoute::watched, &Entry::watch>(executor);
  for (PlaneRoute& route : routes_) route.copied |= route.wrong;
  entry.run<&PlaneRoute::copied, &Entry::copy>(executor);

  SanitiseCounts counts;
  for (const Role& role : roles()) {
    counts.of(role) = {entry.route(role).nan, entry.route(role).inf};
    for (int i = 0; i < role.count; ++i) {
      const HostInput view = entry.plane(role, i);
      const int index = index_of(plane_after(role.first, i));
      const bool copied = view && entry.route(role).copied;
      frame.planes[index] = copied ? View<const float>(planes_[index].view())
                            : view ? floats_of(view)
                                   : View<const float>{};
    }
  }
  return counts;
}

}  // namespace limpid
