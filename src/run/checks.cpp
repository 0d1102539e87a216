#include "run/checks.h"

#include <span>
#include <string>

#include "limpid/core/error.h"
#include "limpid/core/host_view.h"

namespace limpid {

float missing_value(PlaneId plane) {
  for (const Role& role : roles()) {
    if (role.planes().has(plane)) return role.missing;
  }
  return 0;
}

namespace {

/// `name` as in "a normal map".
void check_texture(const Texture& texture, const std::string& name) {
  if (!texture) throw Error("frame: the plan looks up " + name + ", and the frame has none");
  for (const View<const float>& channel : texture.channels) {
    if (!channel || channel.window.empty() || channel.window != texture.channels[0].window) {
      throw Error("frame: " + name + " has channels that are not three of one size");
    }
  }
}

/// A target over its own input would be read by lookups after it was written.
void check_apart(const Frame& frame, const View<float>& out) {
  const auto check = [&](std::span<const View<const float>> inputs) {
    for (const View<const float>& in : inputs) {
      if (overlap(host_view(in), host_view(out))) {
        throw Error("target: it overlaps the memory of the frame, expected separate memory");
      }
    }
  };
  check(frame.planes);
  check(frame.wave_map.channels);
  check(frame.environment.channels);
}

}  // namespace

void check_run(const Plan& plan, const Frame& frame, const Scene& scene, const Target& target) {
  frame.validate();
  if (plan.reads_wave_map) check_texture(frame.wave_map, "a normal map");
  if (plan.reads_environment) check_texture(frame.environment, "an environment");
  if (!agree(plan.primaries, scene.primaries)) {
    throw Error("scene: its primaries are " + to_string(scene.primaries) +
                ", and the plan was made for " + to_string(plan.primaries) +
                ": expected a plan for the primaries of the scene");
  }
  if (plan.needs_sun && !scene.sun) {
    throw Error("scene: the plan has a sun highlight, and the scene has no sun");
  }
  for (const View<float>& view : target.color) check_apart(frame, view);
  check_apart(frame, target.alpha);
  for (const auto& views : target.aovs) {
    for (const View<float>& view : views) check_apart(frame, view);
  }
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
      if (view && !target.aovs[a][0]) {
        throw Error("target: AOV " + std::string(info.name) + " lacks its first channel");
      }
      if (view && (!covers(view) || i >= info.suffixes.size())) {
        throw Error("target: AOV " + std::string(info.name) + " does not cover the picture");
      }
    }
  }
}

}  // namespace limpid
