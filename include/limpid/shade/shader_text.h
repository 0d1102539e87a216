#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "limpid/core/frame.h"
#include "limpid/core/scene.h"
#include "limpid/plan/plan.h"
#include "limpid/run/target.h"

/// @file
/// A look as a shader, for engines that put water into a picture themselves. The operators of the
/// plan are recorded from their C++ templates and printed as one function; the values of a frame
/// are numbers in a uniform block and textures. Modelled on OpenColorIO's GpuShaderDesc: one object
/// has the text, its declarations, values and names.

namespace limpid {

/// Options of a shader text.
struct ShaderOptions {
  enum class Stage {
    kFunction,  ///< only declarations and the function, for a shader of the host
    kCompute,   ///< also a main() for groups of pixels (group()), which writes images
    kFragment,  ///< also a main() for the pixels of a full-screen triangle
  };
  Stage stage = Stage::kFunction;
  std::string function = "limpid_water";  ///< a word of letters, digits and _
  int set = 0;                            ///< descriptor set of all declarations, 0 ... 31
  int first_binding = 0;                  ///< first binding, 0 ... 1000
  std::vector<Aov> aovs = {};             ///< returned by the function besides the picture
  int max_threads = 128;                  ///< the device's limit on threads per group, at least 128
  bool half = false;  ///< whether images that a compute main() writes hold halves (rgba16f)
};

/// A number of the uniform block, in float.
struct ShaderNumber {
  std::string name;    ///< "refraction.strength"; the text has _ for . and [
  std::size_t offset;  ///< in bytes
  float value;         ///< of the frame
  /// The range, for a parameter of the look that the shader uses unchanged. Other numbers are
  /// computed for each frame.
  std::optional<Range> range;
};

/// A sampler2D of the text, which reads it only by texelFetch, without a filter.
struct ShaderTexture {
  enum class Source {
    kPlanes,  ///< planes of the frame: r g b a are those of `role`; their windows are in the block
    kRows,    ///< numbers of each row of the picture
    kMade,    ///< `texels`: a map of the look, or data computed for the frame, also planes
  };
  std::string name;  ///< "limpid_depth"
  int binding;
  Source source;
  std::string role;  ///< of planes, also computed ones: "depth", "color"
  int channels;      ///< number of channels that are read, 1 ... 4
  int width = 0, height = 0;
  /// For kMade: `channels` floats per texel, row after row.
  std::vector<float> texels = {};
};

/// An image (compute) or output (fragment) that main() writes. The first is the picture.
struct ShaderOutput {
  std::string name;  ///< "color", or the AOV, such as "path"
  int channels;
  int binding;  ///< of an image; the location of a fragment output
};

/// One shader for one look, and the values of a frame.
class ShaderText {
 public:
  /// Records the plan for a frame. Runs the completers of the plan. The text is the same for any
  /// size, time and position of the camera, as long as the frame has the same planes and textures,
  /// the scene has the same number of waves, and the camera does not pass between air and water.
  /// Throws Error for options out of range, and as run_reference().
  ShaderText(const Plan& plan, const Frame& frame, const Scene& scene,
             const ShaderOptions& options = {});

  /// GLSL 4.50 for Vulkan. The function takes the pixel (in the coordinates of Frame::planes) and
  /// returns a struct with `color` and the AOVs.
  const std::string& text() const { return text_; }
  const ShaderOptions& options() const { return options_; }
  /// A hash of the text, 16 hexadecimal digits.
  const std::string& id() const { return id_; }
  /// The uniform block, std140: `block_size` bytes at `block_binding`.
  int block_binding() const { return block_binding_; }
  const std::vector<std::byte>& block() const { return block_; }
  const std::vector<ShaderNumber>& numbers() const { return numbers_; }
  const std::vector<ShaderTexture>& textures() const { return textures_; }
  const std::vector<ShaderOutput>& outputs() const { return outputs_; }
  /// The pixels of a group of a compute main(), with one thread each: 16x8, or for long programs
  /// 16x64 if `max_threads` permits.
  const Size& group() const { return group_; }
  /// The pixels that the shader computes: Frame::work().
  const Rect& work() const { return work_; }

 private:
  ShaderOptions options_;
  std::string text_, id_;
  int block_binding_ = 0;
  std::vector<std::byte> block_;
  std::vector<ShaderNumber> numbers_;
  std::vector<ShaderTexture> textures_;
  std::vector<ShaderOutput> outputs_;
  Rect work_;
  Size group_;
};

}  // namespace limpid
