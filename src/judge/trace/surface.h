#pragma once
#include <optional>
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/ops/look.h"
#include "limpid/raster/model.h"

#include "judge/trace/triangles.h"
#include "op/pass.h"

namespace limpid::trace {

/// The point where a ray meets the water.
struct SurfacePoint {
  double distance = 0;
  glm::dvec3 point{0};
  glm::dvec3 face{0};    ///< unit normal of the geometry, out of the water
  glm::dvec3 normal{0};  ///< unit normal for shading
};

/// The water's surface: the raised mesh, or the calm plane of a model without one.
class Surface {
 public:
  Surface(const Model& model, const Scene& scene, const Look& look, const Texture& wave_map,
          const Pass& pass);

  /// Rays in the air meet it from above, rays in the water from below; the other side is ignored.
  std::optional<SurfacePoint> nearest(const Ray& ray, bool from_air) const;

  /// From the water, for paths that must not end beside a mesh: there the water continues under a
  /// level plane at the height of the crests.
  std::optional<SurfacePoint> from_below(const Ray& ray) const;

  /// Height of the highest water relative to the eye.
  double crest() const { return height_ + crest_; }

 private:
  Triangles made(const Model& water);
  glm::dvec3 normal_at(const glm::dvec3& point) const;

  const Pass& pass_;
  const WaterPlane& water_;
  const PlaneAxes axes_;
  double time_;
  const WaveNormals::Params waves_;
  bool wavy_;  ///< from the operator wave_normals
  bool has_mesh_, raised_;
  double height_;  ///< of the calm plane over the eye
  double crest_;   ///< of the highest wave, over the calm plane
  Triangles mesh_;
};

}  // namespace limpid::trace
