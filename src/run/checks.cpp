#include "run/checks.h"

#include <string>

#include "limpid/core/error.h"

namespace limpid {

float missing_value(PlaneId plane) {
  for (const Role& role : roles()) {
    if (role.planes().has(plane)) return role.missing;
  }
  return 0;
}

void check_run(const Plan& plan, const Frame& frame, const Target& target) {
  frame.validate();
  if (!frame.present().covers(plan.planes)) {
    std::vector<std::string> absent;
    for (const Role& role : roles()) {
      if (!frame.present().covers(plan.planes & role.planes())) absent.emplace_back(role.name);
    }
    throw Error("frame: the plan reads " + join(absent) + ", which the frame does not have");
  }
  const auto covers = [&](const View<float>& view) { return view.window.contains(frame.work()); };
  for (const View<float>& view : target.color) {
    if (!view || !covers(view)) throw Error("target: its color does not cover the picture");
  }
  if (target.alpha && !covers(target.alpha))
    throw Error("target: its alpha does not cover the picture");
  for (int a = 0; a < kAovCount; ++a) {
    const AovInfo& info = aovs()[a];
    for (std::size_t i = 0; i < 3; ++i) {
      const View<float>& view = target.aovs[a][i];
      if (view && (!covers(view) || i >= info.suffixes.size())) {
        throw Error("target: AOV " + std::string(info.name) + " does not cover the picture");
      }
    }
  }
}

}  // namespace limpid
