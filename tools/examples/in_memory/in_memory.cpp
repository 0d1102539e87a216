// Puts water into buffers that are in memory already: no file, no copy.
#include <vector>

#include <glm/ext/matrix_transform.hpp>

#include "limpid/plan/plan.h"
#include "limpid/run/fused.h"

int main() {
  using namespace limpid;
  const Size size{640, 360};
  const std::size_t pixels = 640 * 360;

  // The dry picture, interleaved RGBA as a renderer left it, and its linear eye depth.
  std::vector<float> rgba(4 * pixels, 0.3f), depth(pixels, 9.0f), wet(4 * pixels);
  Frame frame;
  frame.display = rect_of(size);
  for (int c = 0; c < 4; ++c) frame.planes[c] = {rgba.data() + c, 4, 4 * 640, frame.display};
  frame.planes[index_of(PlaneId::kDepth)] = {depth.data(), 1, 640, frame.display};

  Scene scene;
  scene.camera = Camera{glm::lookAt(glm::dvec3(0, 2, 5), glm::dvec3(0), glm::dvec3(0, 1, 0)),
                        perspective(0.8, 640.0 / 360, 0.1, 1000, ClipSpace::kGl), ClipSpace::kGl};
  scene.water = WaterPlane{{0, 1, 0}, 0};

  Look look;
  look.set("depth_fog", "density", 0.4);
  const Plan plan = make_plan(look, {.planes = frame.present()});

  Target target;
  for (int c = 0; c < 3; ++c) target.color[c] = {wet.data() + c, 4, 4 * 640, frame.display};
  target.alpha = {wet.data() + 3, 4, 4 * 640, frame.display};
  run_fused(plan, frame, scene, target, *make_executor(0));
  return wet == rgba;  // 0: there is water in it
}
