#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "limpid/core/executor.h"
#include "limpid/core/frame.h"
#include "limpid/core/host_view.h"
#include "limpid/core/scene.h"
#include "limpid/enter/sanitise.h"
#include "limpid/gpu/gpu_runner.h"
#include "limpid/ops/look.h"
#include "limpid/optics/depth.h"
#include "limpid/plan/plan.h"
#include "limpid/run/target.h"
#include "limpid/shade/shader_text.h"

/// @file
/// limpid as a post-processing stage of another program: buffers of the host in, a wet picture in
/// the host's buffers out, frame by frame.
///
///     Compositor water({.depth = DepthKind::kDevice, .clip = ClipSpace::kReversed}, look);
///     ...
///     water.run(frame, picture);  // each frame

namespace limpid {

/// The conventions of a host for cameras and depths, the same for all of its frames. The defaults
/// are those of OpenGL and of this library. Worlds may be left-handed: nothing here depends on
/// handedness, except that PlaneAxes::y then lies on the other side of x.
struct Conventions {
  DepthKind depth = DepthKind::kEye;  ///< what all depth planes hold
  double near = 0, far = 0;           ///< scene units, of DepthKind::kNormalised alone
  /// The range of clip z that projections are made for; Camera::clip of a frame does not count.
  ClipSpace clip = ClipSpace::kGl;
  /// View space looks down +Z instead of -Z, as in Direct3D and Unreal: the last row of perspective
  /// projections is 0 0 1 0.
  bool looks_along_plus_z = false;
  bool clip_y_down = false;  ///< clip y = +1 is the lowest row of the picture, as in Vulkan
  /// The host vouches for its planes: no NaN, no infinity except in depths, where it means "no
  /// surface hit" (as does the far plane of device and normalised depth, and 0 of inverse depth,
  /// but no large number), shadows and masks within 0 ... 1, unit normals. Floats of eye depth are
  /// then read without a copy, and NaN gives NaN around it. Otherwise all planes are checked, and
  /// bad values are replaced as in sanitise.h, in a copy.
  bool trusted = false;
  /// A stored depth of exactly this value is "no surface hit", too. If the planes are not
  /// `trusted`, so is a depth of 0 with an alpha of 0.
  std::optional<double> depth_nothing = {};
};

/// A frame of a host. Planes as in Frame, but in the host's conventions, float or half, with any
/// strides; planes that the plan does not read are ignored. The scene must have camera and
/// water.
struct HostFrame {
  Rect display;  ///< the picture that the camera's projection belongs to
  std::array<HostInput, kPlaneCount> planes;
  Scene scene;

  HostInput& plane(PlaneId id) { return planes[index_of(id)]; }
};

/// The picture of a host, as in Target: float or half, with any strides but 0. Its channels must
/// cover the pixels of the display window that have color; all other pixels are left alone. It may
/// lie over planes of the frame, in place: these are copied first. No two of its channels may share
/// a byte, nor may one with a texture. Halves are rounded to nearest, finite values beyond 65504 to
/// 65504.
struct HostPicture {
  std::array<HostOutput, 3> color;
  HostOutput alpha;  ///< may be absent
  std::array<std::array<HostOutput, 3>, kAovCount> aovs;

  std::array<HostOutput, 3>& of(Aov aov) { return aovs[static_cast<std::size_t>(aov)]; }
};

struct CompositorOptions {
  /// Whose threads compute; it must outlive the compositor. Null: a pool of its own, a thread for
  /// each core.
  Executor* executor = nullptr;
  std::string simd = {};  ///< as in FusedOptions
  double max_error = 0;   ///< as in make_plan(); of the CPU alone
  /// The chain runs there, by a GpuRunner; absent: here, by the FusedRunner. What is made on the
  /// CPU before follows `simd` above, and the one in here stays empty.
  std::optional<GpuOptions> gpu = {};
};

/// Puts water into the frames of a host. Several may work at once, on threads and executors of
/// their own or shared ones; one is for one thread at a time. The bits of a picture do not depend
/// on threads, nor on the frames before it.
///
/// From the second frame of a kind on (same sizes, same planes, same look, same AOVs) run()
/// allocates nothing, but where edges are blurred in more pixels than in any frame before; it never
/// locks (executors may) and opens no file. It prints nothing. On a GPU the bits depend on the
/// device and its driver; each frame records the shader anew, which allocates, and locks the device
/// that all compositors of it share; a frame that needs another shader reads it from the folder of
/// GpuOptions::cache, or loads the module that compiles it and writes it there.
class Compositor {
 public:
  /// Throws Error for depths that cannot be made linear with what the conventions say, and as
  /// make_plan() does for a look or a max_error out of range, or an unknown instruction set; on a
  /// GPU as GpuRunner does, and for a max_error, since that leaves nothing out.
  explicit Compositor(const Conventions& conventions = {}, const Look& look = {},
                      const CompositorOptions& options = {});
  ~Compositor();
  Compositor(Compositor&&) noexcept;
  Compositor& operator=(Compositor&&) noexcept;

  /// From the next frame on. Throws Error for a parameter out of range; the look stays then.
  void set_look(const Look& look);
  const Look& look() const;

  /// The tiling normal map, values 0 ... 1, blue is up; the surroundings as in Frame. Their memory
  /// belongs to the host and must stay valid and unchanged until they are replaced: set a changed
  /// texture again. An empty texture removes the old one. Throws Error for channels of several
  /// sizes, NaN and infinity.
  void set_wave_map(const Texture& map);
  void set_environment(const Texture& environment);

  /// Throws Error, before anything is written: as Frame::validate, the camera, the water and the
  /// planner do, for device depth in the direction opposite to the conventions, windows beyond 2^29
  /// pixels, and for a picture that does not cover the frame; on a GPU as GpuRunner::run().
  /// Throws std::bad_alloc in a first frame only, on a GPU in any.
  void run(const HostFrame& frame, const HostPicture& picture);

  /// The current look as one shader for frames like this one, with the values of this frame: the
  /// plan that run() would make for it, with the AOVs of `options`. The host binds textures of
  /// source kPlanes, which hold the planes of Frame for any conventions: eye depth, unit
  /// normals, row 0 at the top. Without max_error and mixed edges. Each call records and prints
  /// the shader, in about ten milliseconds, and runs the completers on one thread. Changes no
  /// result of run(), plan() and replaced(). Throws Error as run() does for a frame, and as
  /// ShaderText.
  ShaderText shader(const HostFrame& frame, const ShaderOptions& options = {});

  /// Of the last frame: what ran and why, and the replaced values. Throws Error if that frame was
  /// refused, or the look or a texture has been set since.
  const Plan& plan() const;
  const SanitiseCounts& replaced() const;

  /// GpuRunner::device(); "" where the CPU computes.
  const std::string& device() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limpid
