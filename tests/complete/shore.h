#pragma once
#include <algorithm>
#include <cmath>

#include "complete/mirror_depth.h"
#include "op/pass.h"
#include "support.h"

namespace limpid::test {

/// A wall across the view, `far` away and `top` high, on a bottom `deep` under the water, before an
/// open sky. The camera is two metres above the water, level, and looks along -z: the horizon is in
/// the middle.
struct Shore {
  static constexpr Size kSize{64, 48};
  double far = 20, top = 6, deep = 3;
  Scene scene = seen_from();
  test::Buffers buffers{rect_of(kSize)};

  Shore() {
    buffers.set(PlaneId::kDepth, [&](int x, int y) { return dry_depth(x, y); });
    for (PlaneId id : {PlaneId::kColorR, PlaneId::kColorG, PlaneId::kColorB, PlaneId::kReflectionR,
                       PlaneId::kReflectionG, PlaneId::kReflectionB}) {
      buffers.fill(id, 0.5f);
    }
  }
  glm::dvec3 ray(int x, int y) const {
    return rays_of(*scene.camera, {kSize.width, kSize.height}).ray_at(x + 0.5, y + 0.5);
  }
  float dry_depth(int x, int y) const {
    const double sinks = ray(x, y).y;
    if (2 + far * sinks > top) return kInf;
    return static_cast<float>(sinks < 0 ? std::min(far, -(2 + deep) / sinks) : far);
  }
  /// The picture of a mirror at the water: the wall, upside down.
  double mirrored_depth(int x, int y) const {
    const double height = -(2 + far * ray(x, y).y);
    return height > 0 && height < top ? far : HUGE_VAL;
  }
  const MirrorDepth& made(Executor& executor) {
    const Pass pass(scene, buffers.frame, 1.333, kWholeState);
    mirror.make(buffers.frame, pass, executor);
    return mirror;
  }
  MirrorDepth mirror;

  static Scene seen_from() {
    Scene scene;
    Camera camera;
    camera.view = glm::lookAt(glm::dvec3(0, 2, 0), glm::dvec3(0, 2, -1), glm::dvec3(0, 1, 0));
    camera.projection = perspective(1, 4.0 / 3, 0.1, 1e3, ClipSpace::kGl);
    scene.camera = camera;
    scene.water = WaterPlane{};
    return scene;
  }
};

}  // namespace limpid::test
