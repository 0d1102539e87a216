// Puts water into buffers that are in memory already: no file is read and nothing is copied.
#include <vector>

#include <glm/ext/matrix_transform.hpp>

#include "limpid/compositor.h"

int main() {
  using namespace limpid;
  constexpr Size kSize{640, 360};
  constexpr auto kFloat = Sample::kFloat;

  // A dry picture, RGBA as a renderer left it, and its linear eye depth.
  std::vector<float> dry(4 * 640 * 360, 0.3f), depth(640 * 360, 9.0f), wet(dry.size());

  Look look;
  look.set("depth_fog", "density", 0.4);
  Compositor water({.depth = DepthKind::kEye, .clip = ClipSpace::kGl}, look);

  HostFrame frame{.display = rect_of(kSize), .planes = {}, .scene = {}};
  frame.scene.camera =
      Camera{glm::lookAt(glm::dvec3(0, 2, 5), glm::dvec3(0), glm::dvec3(0, 1, 0)),
             perspective(0.8, 640.0 / 360, 0.1, 1000, ClipSpace::kGl), ClipSpace::kGl};
  frame.scene.water = WaterPlane{{0, 1, 0}, 0};
  frame.plane(PlaneId::kDepth) = planar<const void>(depth.data(), kFloat, kSize);
  HostPicture picture;
  for (int c = 0; c < 4; ++c) {
    frame.planes[c] = interleaved<const void>(dry.data(), kFloat, 4, c, kSize);
    (c < 3 ? picture.color[c] : picture.alpha) = interleaved<void>(wet.data(), kFloat, 4, c, kSize);
  }
  water.run(frame, picture);  // once a frame; no memory is allocated after the first
  return wet == dry;          // 0: there is water in it
}
