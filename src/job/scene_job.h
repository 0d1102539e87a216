#pragma once
#include "limpid/core/error.h"
#include "limpid/job/water.h"

namespace limpid {

/// The scene of a job over a model, for a picture of that size.
inline Scene scene_of(const Model& model, const SceneJob& job, Size size) {
  Scene scene = job.scene.scene;
  if (job.scene.camera) scene.camera = camera_for(*job.scene.camera, size);
  scene.time = job.time.of(job.scene);
  if (const auto& named = job.scene.primaries; named && !agree(*named, kRec709)) {
    throw Error("scene.colorspace = " + to_string(*named) +
                ": expected Rec.709, the color space of a glTF scene");
  }
  return scene_of_model(scene, model, size);
}

}  // namespace limpid
