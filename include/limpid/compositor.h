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
/// limpid as a post stage of another program: buffers of the host in, a wet picture in its own
/// buffers out, frame after frame.
///
///     Compositor water({.depth = DepthKind::kDevice, .clip = ClipSpace::kReversed}, look);
///     ...
///     water.run(frame, picture);  // each frame

namespace limpid {

/// How a host keeps cameras and depths, the same for all of its frames. The defaults are those of
/// OpenGL and of this library. Worlds may be left-handed: nothing here depends on it, and
/// PlaneAxes::y then lies to the other side of x.
struct Conventions {
  DepthKind depth = DepthKind::kEye;  ///< what all depth planes hold
  double near = 0, far = 0;           ///< scene units, of DepthKind::kNormalised alone
  /// The range of clip z that projections are made for; Camera::clip of a frame does not count.
  ClipSpace clip = ClipSpace::kGl;
  /// View space looks down +Z and not -Z, as those of Direct3D and Unreal do: the last row of
  /// perspective projections is 0 0 1 0.
  bool looks_along_plus_z = false;
  bool clip_y_down = false;  ///< clip y = +1 is the lowest row of the picture, as in Vulkan
  /// The host vouches for its planes: no NaN, no infinity but in depths, where it means "nothing
  /// hit" (as does the far plane of device and normalised depth, and 0 of inverse depth, but no
  /// large number), shadows and masks within 0 ... 1, unit normals. Floats of eye depth are then
  /// read as they lie, and NaN gives NaN around it. Otherwise all is looked through, and what is
  /// wrong is replaced as sanitise.h says, in a copy.
  bool sane = false;
  /// A depth that is stored as exactly this is "nothing hit", too. Where the planes are not `sane`,
  /// so is a depth of 0 with an alpha of 0.
  std::optional<double> depth_nothing = {};
};

/// A frame of a host. Planes as in Frame, but in the host's conventions, float or half, with any
/// strides; those that the plan does not read are not looked at. The scene must have camera and
/// water.
struct HostFrame {
  Rect display;  ///< the picture that the camera's projection belongs to
  std::array<HostInput, kPlaneCount> planes;
  Scene scene;

  HostInput& plane(PlaneId id) { return planes[index_of(id)]; }
};

/// Where a host wants its picture, as in Target: float or half, with any strides but 0. What there
/// is must cover the pixels of the display window that have color; all else is left alone. It may
/// lie over planes of the frame, in place: these are copied first. No two of its channels may share
/// a byte, nor one with a texture. Halves take the nearest value, finite ones beyond 65504 that
/// one.
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
/// locks (executors may), opens no file, prints nothing. On a GPU the bits depend on the device and
/// its driver, and each frame records the shader anew, which allocates.
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
  /// stays the host's and must be there, unchanged, until they are replaced: what has changed is
  /// set again. An empty texture takes them away. Throws Error for channels of several sizes, NaN
  /// and infinity.
  void set_wave_map(const Texture& map);
  void set_environment(const Texture& environment);

  /// Throws Error, before anything is written: for what Frame::validate, the camera, the water and
  /// the planner refuse, for device depth that runs the other way than the conventions say, windows
  /// farther out than 2^29 pixels, and for a picture that does not cover the frame. Throws
  /// std::bad_alloc in a first frame only.
  void run(const HostFrame& frame, const HostPicture& picture);

  /// The look as it is set now as one shader for frames like this one, with the values of this one:
  /// the plan that run() would make for it, with the AOVs of `options`. Textures of source kPlanes
  /// are for the host to bind and hold what Frame says, whatever the conventions are: eye depth,
  /// unit normals, row 0 at the top. Without max_error, and no edge is mixed. Each call records and
  /// prints anew, about ten milliseconds, and makes on one thread what nobody rendered. Changes
  /// nothing of what run(), plan() and replaced() give. Throws Error as run() does for a frame, and
  /// as ShaderText.
  ShaderText shader(const HostFrame& frame, const ShaderOptions& options = {});

  /// Of the last frame: what ran and why, and what was replaced because it meant nothing. Throws
  /// Error where that one was refused, or the look or a texture has been set since.
  const Plan& plan() const;
  const SanitiseCounts& replaced() const;

  /// GpuRunner::device(); "" where the CPU computes.
  const std::string& device() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limpid
