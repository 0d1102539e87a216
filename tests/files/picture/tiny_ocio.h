#pragma once
#include <filesystem>
#include <fstream>

/// A config of OpenColorIO, small enough to be worked by hand.

namespace limpid::test {

/// Linear Rec.709 is its reference; `rec709` stands for what a display encodes. Of its displays
/// `screen` is the default, with the views `half` (half of the light, linear) and `swapped` (red
/// and blue change places); `wall` has `half` alone.
inline std::filesystem::path write_tiny_ocio(const std::filesystem::path& path) {
  std::ofstream(path) << R"(ocio_profile_version: 1
search_path: ""
strictparsing: true
luma: [0.2126, 0.7152, 0.0722]
roles:
  default: lin_rec709
  scene_linear: lin_rec709
displays:
  screen:
    - !<View> {name: half, colorspace: half}
    - !<View> {name: swapped, colorspace: swapped}
  wall:
    - !<View> {name: half, colorspace: half}
active_displays: [screen, wall]
active_views: [half, swapped]
colorspaces:
  - !<ColorSpace>
    name: rec709
    bitdepth: 32f
    to_reference: !<MatrixTransform> {matrix: [0.1, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: lin_rec709
    bitdepth: 32f
  - !<ColorSpace>
    name: half
    bitdepth: 32f
    from_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: swapped
    bitdepth: 32f
    from_reference: !<MatrixTransform> {matrix: [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1]}
)";
  return path;
}

}  // namespace limpid::test
