#include "run/show_planes.h"

#include "complete/rows.h"
#include "run/checks.h"

namespace limpid {

void show_planes(const Plan& plan, const Frame& frame, const Target& target, Executor& executor) {
  const Rect work = frame.work();
  for (int a = 0; a < kAovCount; ++a) {
    std::size_t channel = 0;
    for (int i = 0; i < kPlaneCount; ++i) {
      const PlaneId id = static_cast<PlaneId>(i);
      if (!aovs()[static_cast<std::size_t>(a)].planes.has(id)) continue;
      const View<float>& to = target.aovs[static_cast<std::size_t>(a)][channel++];
      if (!to) continue;
      const bool read = (plan.planes | plan.completed).has(id);
      const View<const float> from = read ? frame.plane(id) : View<const float>{};
      each_row(executor, work, [&](int y) {
        for (int x = work.x0; x < work.x1; ++x) {
          to.at(x, y) = from ? from.at(x, y) : missing_value(id);
        }
      });
    }
  }
}

}  // namespace limpid
