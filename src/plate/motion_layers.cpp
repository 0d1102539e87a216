#include "plate/motion_layers.h"

#include <algorithm>

#include "limpid/core/error.h"

#include "plate/layer_candidates.h"
#include "plate/layer_views.h"

namespace limpid {
namespace {

/// A convention: the last words of a layer's name, and the names of the vectors made from it.
struct MotionRule {
  std::string_view topic, made;
};
constexpr MotionRule kRules[] = {
    {"vector", "motion"},
    {"motionvector", "motion"},
    {"motion vector", "motion"},
    {"motion vectors", "motion"},
    {"motion", "motion"},
    {"forward", "motion_forward"},
    {"backward", "motion_backward"},
};

/// Pairs of components that form one vector, in the order of writing.
constexpr std::string_view kPairs[][2] = {{"x", "y"}, {"z", "w"}, {"u", "v"}, {"r", "g"}};

/// The layer's vectors, or no channels.
MotionLayer vectors_of(const LayerGroup& group, std::string_view made) {
  MotionLayer layer;
  layer.name = made;
  const auto channel_of = [&](std::string_view component) -> const std::string* {
    for (const std::string& channel : group.channels) {
      if (plain_component(split_channel(channel).component) == component) return &channel;
    }
    return nullptr;
  };
  for (const auto& pair : kPairs) {
    const std::string *x = channel_of(pair[0]), *y = channel_of(pair[1]);
    if (x == nullptr || y == nullptr) continue;
    for (const std::string* channel : {x, y}) {
      layer.channels.push_back({group.source->file, group.source->part, *channel});
      layer.suffixes.push_back(split_channel(*channel).component);
    }
  }
  return layer;
}

}  // namespace

std::vector<MotionLayer> find_motion_layers(const std::vector<LayerSource>& sources,
                                            const std::string& view, const std::string& named) {
  const std::vector<LayerGroup> groups = group_layers(sources);
  std::vector<MotionLayer> layers;
  const auto add = [&](const LayerGroup& group, std::string_view made) {
    MotionLayer layer = vectors_of(group, made);
    const auto same = [&](const MotionLayer& other) { return other.name == layer.name; };
    if (layer.channels.empty() || std::any_of(layers.begin(), layers.end(), same)) return;
    layers.push_back(std::move(layer));
  };
  const auto is_of_view = [&](const LayerGroup& group) {
    return group.view.empty() || view.empty() || is_same_view(group.view, view);
  };
  for (const MotionRule& rule : kRules) {
    for (const LayerGroup& group : groups) {
      if (!named.empty() || group.source->deep || !is_of_view(group)) continue;
      if (group.topic == rule.topic) add(group, rule.made);
    }
  }
  for (const Agreement agreement : kAgreements) {
    for (const LayerGroup& group : groups) {
      if (!layers.empty() || named.empty() || group.source->deep || !is_of_view(group)) continue;
      const std::string part = group.path.empty() ? group.source->part_name : group.path;
      if (agrees(agreement, part, named) ||
          agrees(agreement, with_part(group, group.path), named)) {
        add(group, "motion");
      }
    }
  }
  if (!layers.empty()) return layers;
  throw Error(
      (named.empty() ? "no motion vectors found" : "motion=" + named + ": no such vectors") +
      ": expected a layer vector, motionvector, or forward and backward, with X Y (Z W), "
      "U V or R G; there is " +
      layer_list(groups, sources) +
      "; name it with --layer motion=LAYER, or give --motion-to next");
}

}  // namespace limpid
