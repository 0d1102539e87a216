#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/enter/sanitise.h"
#include "limpid/files/exr/exr_file.h"
#include "limpid/files/limits.h"
#include "limpid/files/text/scene_file.h"
#include "limpid/plate/layers.h"

namespace limpid {

/// The files and layers of a frame's planes.
struct PlateRequest {
  std::vector<std::filesystem::path> files;  ///< searched for every role, by known layer names
  std::map<std::string, std::string>
      named;  ///< role -> "FILE" or "FILE:CHANNELS": a scene's [plates]
  /// role -> "FILE:CHANNELS", "FILE", "CHANNELS" of `files`, or "none" to leave the role out. Takes
  /// precedence over `files` and `named`.
  LayerOverrides layers;
  /// The view of all roles, for stereo plates; letter case is ignored. "": the view of the color,
  /// which is then that of the default view (layers.h).
  std::string view = {};
  /// The layer of `files` with motion vectors; "" searches for it by known layer names.
  std::string motion = {};
  Limits limits = {};
};

/// The files that Plate::open() of this request opens, each once, in no particular order. A name in
/// `layers` without the extension .exr counts as a file if the file exists.
std::vector<std::filesystem::path> files_of(const PlateRequest& request);

/// The kind of the depth planes of a plate, for the dry scene and the water.
struct DepthMeaning {
  DepthKind kind = DepthKind::kEye;
  double near = 0, far = 0;  ///< for kNormalised
  /// A stored depth of exactly this value means "no surface hit", too.
  std::optional<double> nothing = {};
};

/// The planes of a plate in the conventions of the chain, with their memory.
struct LoadedPlate {
  Frame frame;  ///< views into `planes`
  SanitiseCounts replaced;
  std::vector<Plane> planes;
  std::array<Plane, 4> foreground;  ///< from deep samples; else empty
  double transparent = 0;           ///< DeepLayers::transparent
};

/// Layers of one part of a plate that are copied unchanged to the output.
struct PassedPart {
  const ExrFile* file = nullptr;  ///< valid as long as the plate
  int part = 0;
  bool of_color = false;  ///< whether the color comes from that part, too
  std::string name;       ///< of the part; else of its file, without the frame number
  std::vector<std::string> channels;
  /// Copied attributes of the part's header: manifests of the cryptomattes among its channels; and,
  /// unless it is the color's part, the attributes that Plate::attributes() would select.
  std::map<std::string, ExrFile::Attribute> attributes;
};

/// Motion vectors of the dry picture, in pixels, x to the right, y up: X and Y, Z and W, or others.
struct MotionLayer {
  std::string name;                   ///< of the output layer: "motion", "motion_forward" ...
  std::vector<std::string> suffixes;  ///< of the channels in the plate; two per vector
  std::vector<ChannelRef> channels;   ///< one per suffix
};

/// A frame in files, opened: the source of every role is known, no pixel has been read. The source
/// of a role is that in `layers`, else that in `named`, else found among `files`. A deep part
/// (files/exr/deep.h) gives color and depth, and, unless other layers feed these roles, below_color
/// and below_depth from its samples behind the surface. Where a renderer left out the samples
/// behind opaque ones, these are black and infinitely far.
class Plate {
 public:
  /// Throws Error for a file that cannot be opened, without a color (with a list of all layers),
  /// for two candidates of one role, for a view that no file has (with a list of the views), and
  /// for display windows that differ.
  static Plate open(const PlateRequest& request);
  /// The views of the request's files (views_of()). Throws Error as open() does for files.
  static std::vector<std::string> views(const PlateRequest& request);
  /// The output of `limpid inspect`. Roles with ambiguous sources are reported in the text, not
  /// thrown.
  static std::string inspect(const PlateRequest& request);
  Plate(Plate&&) noexcept;
  Plate& operator=(Plate&&) noexcept;
  ~Plate();

  PlaneSet planes() const;
  /// The planes of roles that the request names.
  PlaneSet named_planes() const;
  Rect display() const;
  double pixel_aspect() const;
  /// The name of the color's part; "" if it has none.
  std::string part_name() const;
  /// The camera in the attributes of the color's part (that of its first channel), see
  /// exr_camera.h. Parts of other views have other cameras.
  std::optional<Camera> camera() const;
  /// The scene in the attribute limpid/scene of that part, as `limpid render` writes it; empty
  /// without the attribute.
  SceneFile scene() const;
  bool has_scene() const;
  /// Attributes of the color's part (ExrFile::attributes) to copy into the output: without those
  /// that describe the part's own channels or pixels, such as manifests of cryptomattes, and
  /// without limpid's records on how the part was made.
  std::map<std::string, ExrFile::Attribute> attributes() const;
  /// The working space in these attributes: `chromaticities`, else the name of a known space in
  /// `colorInteropID` or `oiio:ColorSpace`; empty if neither is there. Throws Error for invalid
  /// chromaticities (Primaries::validate()).
  std::optional<Primaries> primaries() const;
  /// The layers of PlateRequest::files and of the color's file with these names: "all" (except the
  /// color); names of layers, parts and channels as in choose_layer(), which may match several; the
  /// name of a cryptomatte in its manifest; names with * and ?. Layers of views other than the
  /// color's do not match. Throws Error for a name without a match, and for deep samples.
  std::vector<PassedPart> passed(const std::vector<std::string>& names) const;
  /// The names of the layers of these files that feed no role.
  std::vector<std::string> other_layers() const;
  /// The layers of PlateRequest::files with motion vectors: those of Blender (Vector), Arnold
  /// (motionvector), Nuke (forward, backward), or the layer PlateRequest::motion. Throws Error if
  /// there are none.
  std::vector<MotionLayer> motion_layers() const;
  /// The planes of these layers, with their whole data windows. Throws Error as read().
  std::vector<Plane> read_motion(const std::vector<MotionLayer>& layers) const;
  /// As inputs_text(), for motion vectors.
  std::string motion_text(const std::vector<MotionLayer>& layers) const;
  /// As inputs_text(), for copied layers.
  std::string passed_text(const std::vector<PassedPart>& parts) const;
  /// Throws the Error for a role without a source, with a list of all layers.
  [[noreturn]] void refuse_without(std::string_view role) const;

  /// The planes that read() reads for `wanted`: also the surface depth, which divides deep samples,
  /// if the layer below the water comes from them.
  PlaneSet read_for(PlaneSet wanted) const;

  /// The inputs of read() for these planes besides scene and depth, as TOML: for each role with a
  /// wanted plane, the hash of the file's bytes (ExrFile::content_hash), the part and the channels;
  /// a list of these if its channels lie in several parts. It has no names or places of files, so
  /// equal texts mean equal planes. Reads the whole files. Throws Error if that fails.
  std::string inputs_text(PlaneSet wanted) const;

  /// Decodes the wanted planes and converts them (sanitise.h). A depth of 0 means "no surface hit"
  /// where the color's alpha is 0, if alpha is wanted. Planes smaller than the picture are filled
  /// up with their role's `missing` value. The layer below the water in deep samples begins at the
  /// surface depth, or else at the scene's calm plane. Throws Error for damaged pixels, for a depth
  /// kind that needs a camera, or near and far, that the scene lacks, and for deep samples of
  /// another kind than eye or ray.
  LoadedPlate read(PlaneSet wanted, const Scene& scene, const DepthMeaning& depth) const;
  /// The same, into a plate that was read before: planes with the right windows are reused.
  void read(PlaneSet wanted, const Scene& scene, const DepthMeaning& depth,
            LoadedPlate& loaded) const;

 private:
  struct State;
  explicit Plate(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace limpid
