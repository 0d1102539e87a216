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
/// limpid as a post-processing stage of another program: it reads the host's buffers and writes the
/// wet picture into the host's buffers, frame by frame.
///
///     Compositor water({.depth = DepthKind::kDevice, .clip = ClipSpace::kReversed}, look);
///     ...
///     water.run(frame, picture);  // each frame

namespace limpid {

/// The conventions of a host for cameras and depths, the same for all of its frames. The defaults
/// are those of OpenGL and of this library. Worlds may be left-handed: only the side of x on which
/// PlaneAxes::y lies depends on handedness.
struct Conventions {
  DepthKind depth = DepthKind::kEye;  ///< of all depth planes
  double near = 0, far = 0;           ///< scene units, for DepthKind::kNormalised only
  /// The range of clip z in the host's projections; Camera::clip of a frame is ignored.
  ClipSpace clip = ClipSpace::kGl;
  /// The camera looks down +Z of view space instead of -Z, as in Direct3D and Unreal: the last row
  /// of perspective projections is 0 0 1 0.
  bool looks_along_plus_z = false;
  bool clip_y_down = false;  ///< clip y = +1 is the lowest row of the picture, as in Vulkan
  /// The host guarantees valid planes: no NaN; no infinity except in depths, where it means "no
  /// surface hit" (as do the far plane of device and normalised depth, and 0 of inverse depth, but
  /// no large finite number); shadows and masks within 0 ... 1; unit normals. Floats of eye depth
  /// are then read without a copy, and a NaN spreads to the pixels whose lookups read it. Otherwise
  /// all planes are checked, and invalid values are replaced in a copy, as in sanitise.h.
  bool trusted = false;
  /// A stored depth of exactly this value means "no surface hit", too. If the planes are not
  /// `trusted`, so does a depth of 0 with an alpha of 0.
  std::optional<double> depth_nothing = {};
};

/// A frame of a host. It has the planes of Frame, but in the host's conventions, float or half,
/// with any strides; planes that the plan does not read are ignored. The scene must have a camera
/// and water.
struct HostFrame {
  Rect display;  ///< the rectangle that the camera's projection covers, in pixels
  std::array<HostInput, kPlaneCount> planes;
  Scene scene;

  HostInput& plane(PlaneId id) { return planes[index_of(id)]; }
};

/// The output memory of a host, with the channels of Target: float or half, with any strides but 0.
/// The channels must cover the pixels of the display window that have color; all other pixels stay
/// unchanged. They may overlap planes of the frame, which are then copied first. Two channels must
/// not share a byte, and no channel may share one with a texture. Halves are rounded to nearest,
/// finite values beyond 65504 to 65504.
struct HostPicture {
  std::array<HostOutput, 3> color;
  HostOutput alpha;  ///< may be absent
  std::array<std::array<HostOutput, 3>, kAovCount> aovs;

  std::array<HostOutput, 3>& of(Aov aov) { return aovs[static_cast<std::size_t>(aov)]; }
};

struct CompositorOptions {
  /// Runs the computation on its threads; must outlive the compositor. Null: the compositor makes a
  /// pool with one thread per core.
  Executor* executor = nullptr;
  std::string simd = {};  ///< as in FusedOptions
  double max_error = 0;   ///< as in make_plan(); must be 0 on a GPU
  /// If present, the chain runs on this GPU, by a GpuRunner; else on the CPU, by the FusedRunner.
  /// Completers run on the CPU, by `simd` above; GpuOptions::simd must stay empty.
  std::optional<GpuOptions> gpu = {};
};

/// Puts water into the frames of a host. One compositor is for one thread at a time; several may
/// run at once, with separate or shared executors. The bits of a picture do not depend on threads,
/// nor on the frames before it.
///
/// On a CPU, from the second frame of a kind on (same sizes, planes, look and AOVs), run()
/// allocates memory only if more pixels have blurred edges than in any frame before. It takes no
/// lock (executors may), opens no file and prints nothing. On a GPU the bits depend on the device
/// and its driver. Each frame records the shader anew, which allocates memory, and locks the
/// device, which all its compositors share. A frame that needs a new shader reads it from the
/// folder GpuOptions::cache, or loads the module that compiles it and writes it into that folder.
class Compositor {
 public:
  /// Throws Error for conventions that do not suffice to make depths linear, for an unknown
  /// instruction set, and, as make_plan(), for a look or a max_error out of range; on a GPU also as
  /// GpuRunner does, and for a max_error above 0, since a GPU skips no operator.
  explicit Compositor(const Conventions& conventions = {}, const Look& look = {},
                      const CompositorOptions& options = {});
  ~Compositor();
  Compositor(Compositor&&) noexcept;
  Compositor& operator=(Compositor&&) noexcept;

  /// Sets the look from the next frame on. Throws Error for a parameter out of range, and then
  /// keeps the old look.
  void set_look(const Look& look);
  const Look& look() const;

  /// Sets the tiling normal map (values 0 ... 1, blue is up), and the surroundings as in Frame. The
  /// memory belongs to the host and must stay valid and unchanged until the texture is replaced:
  /// set a changed texture again. An empty texture removes the old one. Throws Error for channels
  /// of different sizes, NaN and infinity.
  void set_wave_map(const Texture& map);
  void set_environment(const Texture& environment);

  /// Puts water into a frame. Throws Error before it writes anything: as Frame::validate(),
  /// Scene::validate() and make_plan() do, for a projection whose device depth runs against the
  /// conventions, for windows beyond 2^29 pixels, and for a picture that does not cover the frame;
  /// on a GPU also as GpuRunner::run(). Throws std::bad_alloc, on a CPU in the first frame of a
  /// kind only.
  void run(const HostFrame& frame, const HostPicture& picture);

  /// The current look as one shader for frames of this kind, with the values of this frame, by the
  /// plan that run() would make and with the AOVs of `options`. The host binds textures of source
  /// kPlanes, which hold the planes of Frame for any conventions: eye depth, unit normals, row 0 at
  /// the top. The shader ignores max_error and has no mixed edges. Each call records and prints the
  /// shader, in about ten milliseconds, and runs the completers on one thread. Changes no result of
  /// run(), plan() and replaced(). Throws Error as run() does for a frame, and as ShaderText.
  ShaderText shader(const HostFrame& frame, const ShaderOptions& options = {});

  /// The plan of the last frame, with the reasons, and the number of its replaced values. Throws
  /// Error if that frame was refused, or if the look or a texture has been set since.
  const Plan& plan() const;
  const SanitiseCounts& replaced() const;

  /// GpuRunner::device(); "" on a CPU.
  const std::string& device() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limpid
