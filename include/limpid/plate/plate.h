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

/// Where the planes of a frame are to come from.
struct PlateRequest {
  std::vector<std::filesystem::path> files;  ///< searched by convention for every role
  std::map<std::string, std::string>
      named;  ///< role -> "FILE" or "FILE:CHANNELS": a scene's [plates]
  /// role -> "FILE:CHANNELS", "FILE", "CHANNELS" of `files`, or "none" to leave the role out. Wins
  /// over both.
  LayerOverrides layers;
  /// Of stereo and the like: that of every role, by its name in any letter case. "": the color's,
  /// which is then that of the default view (layers.h).
  std::string view = {};
  /// Which layer of `files` has motion vectors, "" for the one that a convention tells.
  std::string motion = {};
  Limits limits = {};
};

/// The files that Plate::open() of this request opens, each once, in no particular order. A layer
/// that is named without an extension of EXR counts as a file if it is there.
std::vector<std::filesystem::path> files_of(const PlateRequest& request);

/// What the depth planes of a plate hold, the dry scene's and the water's alike.
struct DepthMeaning {
  DepthKind kind = DepthKind::kEye;
  double near = 0, far = 0;  ///< for kNormalised
  /// A depth that is stored as exactly this is "nothing hit", too.
  std::optional<double> nothing = {};
};

/// The planes of a plate in the conventions of the chain, owned.
struct LoadedPlate {
  Frame frame;  ///< views into `planes`
  SanitiseCounts replaced;
  std::vector<Plane> planes;
  std::array<Plane, 4> foreground;  ///< of deep samples, or none
  double transparent = 0;           ///< share of the wet pixels, as DeepLayers has it
};

/// Layers of one part of a plate that are handed on to a picture as they are.
struct PassedPart {
  const ExrFile* file = nullptr;  ///< one of the plate's, which it lives as long as
  int part = 0;
  bool of_color = false;  ///< the color comes from that part, too
  std::string name;       ///< the part's; its file's, without the frame's number, where it has none
  std::vector<std::string> channels;
  /// What is handed on of the part's header: manifests of the cryptomattes among its channels, and
  /// but for the color's part what Plate::attributes() is of that.
  std::map<std::string, ExrFile::Attribute> attributes;
};

/// Motion vectors of the dry picture, in pixels, x to the right, y up: X and Y, Z and W, or others.
struct MotionLayer {
  std::string name;                   ///< of what is made of them: "motion", "motion_forward" ...
  std::vector<std::string> suffixes;  ///< as they are called in the plate; two a vector
  std::vector<ChannelRef> channels;   ///< one a suffix
};

/// A frame as it lies in files: opened, every role found, no pixel read. A role is decided by
/// `layers`, else by `named`, else found among `files`. A deep part (files/exr/deep.h) gives color
/// and depth, and where no other layer does, below_color and below_depth: what its samples hold
/// behind the surface. Samples that a renderer left out behind opaque ones are black and infinitely
/// far.
class Plate {
 public:
  /// Throws Error: a file that cannot be opened, no color (the list of what there is), two
  /// candidates, a view that no file has (the list of views), display windows that differ.
  static Plate open(const PlateRequest& request);
  /// The views of the request's files (views_of()). Throws Error as open() does for files.
  static std::vector<std::string> views(const PlateRequest& request);
  /// What `limpid inspect` prints. Roles that cannot be decided are told, not thrown.
  static std::string inspect(const PlateRequest& request);
  Plate(Plate&&) noexcept;
  Plate& operator=(Plate&&) noexcept;
  ~Plate();

  PlaneSet planes() const;
  /// Of these, the ones of roles that the request names.
  PlaneSet named_planes() const;
  Rect display() const;
  double pixel_aspect() const;
  /// Of the part that has the color; "" where it has none.
  std::string part_name() const;
  /// From the attributes of the part that has the color (its first channel), see exr_camera.h:
  /// parts of other views have other cameras.
  std::optional<Camera> camera() const;
  /// From the attribute limpid/scene of that part, as `limpid render` writes it; empty where there
  /// is none.
  SceneFile scene() const;
  bool has_scene() const;
  /// Attributes of the color's part (ExrFile::attributes), to be handed on to a picture made from
  /// it: without those that tell of the part's own channels or pixels, as the manifests of a
  /// cryptomatte do, and without what limpid wrote of how it was made.
  std::map<std::string, ExrFile::Attribute> attributes() const;
  /// The working space that these attributes tell of: `chromaticities`, else the name of a known
  /// space in `colorInteropID` or `oiio:ColorSpace`. Nothing where neither does. Throws Error for
  /// chromaticities that are none.
  std::optional<Primaries> primaries() const;
  /// The layers of PlateRequest::files, and of the file that has the color, that these names mean:
  /// "all", but the color; layers, parts and channels as choose_layer() knows their names, of which
  /// each may be several; a cryptomatte as its manifest calls it; names with * and ?. Layers of
  /// views other than the color's are none of them. Throws Error for a name that nothing has, and
  /// for deep samples.
  std::vector<PassedPart> passed(const std::vector<std::string>& names) const;
  /// The names of these layers that feed no role.
  std::vector<std::string> other_layers() const;
  /// Those of PlateRequest::files that have motion vectors: of Blender (Vector), Arnold
  /// (motionvector), Nuke (forward, backward), or the one that PlateRequest::motion names. Throws
  /// Error where there is none.
  std::vector<MotionLayer> motion_layers() const;
  /// Their planes, of the whole data windows. Throws Error as read().
  std::vector<Plane> read_motion(const std::vector<MotionLayer>& layers) const;
  /// As inputs_text(), of motion vectors.
  std::string motion_text(const std::vector<MotionLayer>& layers) const;
  /// As inputs_text(), of what is handed on.
  std::string passed_text(const std::vector<PassedPart>& parts) const;
  /// Throws the Error for a role that nothing feeds, with the list of all layers that there are.
  [[noreturn]] void refuse_without(std::string_view role) const;

  /// The planes that read() reads where these are wanted: what deep samples have below the water
  /// begins at the surface depth.
  PlaneSet read_for(PlaneSet wanted) const;

  /// What read() of these planes goes by besides scene and depth, as TOML: for each role that has
  /// one of them, the hash of the file's bytes (ExrFile::content_hash), the part and the channels;
  /// a list of such where its channels lie in several parts.
  /// No names of files, nor where they lie: the same text stands for the same planes. Reads the
  /// files whole. Throws Error when that fails.
  std::string inputs_text(PlaneSet wanted) const;

  /// Decodes the wanted planes and enters them (sanitise.h). A depth of 0 is "nothing hit" where
  /// the color's alpha is 0 and wanted. Planes smaller than the picture are filled up with their
  /// role's `missing` value. What is below the water in deep samples begins at the surface depth,
  /// or else at the scene's calm plane. Throws Error for damaged pixels, for a depth kind that
  /// needs what the scene lacks, and for deep samples of a kind but eye or ray.
  LoadedPlate read(PlaneSet wanted, const Scene& scene, const DepthMeaning& depth) const;
  /// The same into a plate that was read before, in whose planes of the right windows it is read.
  void read(PlaneSet wanted, const Scene& scene, const DepthMeaning& depth,
            LoadedPlate& loaded) const;

 private:
  struct State;
  explicit Plate(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace limpid
