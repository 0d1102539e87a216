#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <glm/vec4.hpp>

#include "limpid/core/camera.h"
#include "limpid/core/executor.h"
#include "limpid/core/plane.h"
#include "limpid/core/rect.h"
#include "limpid/core/scene.h"
#include "limpid/raster/model.h"

namespace limpid {

struct ShadowMap;

enum class RasterSubject : std::uint8_t { kDry, kWater };  ///< all but the water; only the water

/// The view of a pass. `display` is the rectangle that the projection covers; `window`, the pixels
/// that are drawn, may be larger (overscan) or smaller.
struct RasterView {
  Camera camera;
  Rect display;
  Rect window;
  RasterSubject subject = RasterSubject::kDry;
  std::optional<glm::dvec4> clip_plane = {};  ///< world; keeps points with dot(plane, (p, 1)) >= 0
  bool flip_winding = false;                  ///< for a view matrix that mirrors the world
  bool cull = true;  ///< cull back faces, except those of double-sided materials
};

struct RasterLighting {
  Sun sun;
  const ShadowMap* shadow = nullptr;  ///< null: no shadows
  bool sun_alone = false;  ///< without ambient light, emission, unlit surfaces and background
};

/// The planes that a pass draws.
struct RasterWanted {
  bool color = false, depth = false, coverage = false, shadow = false, normal = false;
};

/// The requested planes, over the view's window; the others are empty.
struct RasterImage {
  std::array<Plane, 3> color;  ///< scene-linear; the model's background where no surface is
  Plane depth;                 ///< linear eye depth, +inf where no surface is
  Plane coverage;              ///< 1 where a surface is, else 0
  Plane shadow;  ///< the sun's visibility: 0 on surfaces that face away, 1 where no surface is
  std::array<Plane, 3> normal;  ///< unit, world, towards the viewer's side; 0 where no surface is
};

/// Draws a model on the CPU: visibility first, then shading once per pixel, and once for each
/// surface that is blended over it (AlphaMode). Pixels are sampled at their centres, corners
/// snapped to 1/256 pixel, edges shared by two triangles belong to one of them (top-left rule).
/// Depth is that of the triangle's plane, computed in double. Textures are bilinear in the mip
/// level nearest to the pixel's footprint. Without normals faces are flat; triangles without area
/// are left out. Clips at the near and far plane of the projection and at `clip_plane`.
///
/// Keeps a reference to the model, which must not change, and keeps its buffers from one draw to
/// the next. One draw at a time.
class Rasteriser {
 public:
  /// Throws Error for a model without materials, an index out of range, or more than 2^28 vertices.
  explicit Rasteriser(const Model& model);
  ~Rasteriser();

  /// The bits of the picture depend on the arguments and the instruction set, not on threads or the
  /// order of tiles. `simd` as in simd.h. Planes of `image` with the right window are reused.
  /// Throws Error for an invalid camera, an empty window, or one wider or higher than 32000 pixels.
  void draw(const RasterView& view, const RasterLighting& lighting, RasterWanted wanted,
            Executor& executor, RasterImage& image, const std::string& simd = "");

  /// The number of triangles without area, which are left out.
  std::int64_t degenerate_triangles() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Rasteriser for a single picture.
RasterImage rasterise(const Model& model, const RasterView& view, const RasterLighting& lighting,
                      RasterWanted wanted, Executor& executor, const std::string& simd = "");

}  // namespace limpid
