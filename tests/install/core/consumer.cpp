// A host with one pixel: water on it, and the library's error by its type.
#include <array>
#include <iostream>
#include <string>

#include <glm/ext/matrix_transform.hpp>

#include "limpid/core/error.h"
#include "limpid/plan/plan.h"
#include "limpid/run/fused.h"

namespace {

using namespace limpid;

/// The dry gray of a bottom ten units off, with the look's water in front of it.
std::array<float, 4> wet(const Look& look) {
  std::array<float, 4> dry{0.3f, 0.3f, 0.3f, 1.0f}, out{};
  float depth = 10.0f;
  Frame frame;
  frame.display = rect_of(Size{1, 1});
  for (int c = 0; c < 4; ++c) frame.planes[c] = {&dry[c], 4, 4, frame.display};
  frame.planes[index_of(PlaneId::kDepth)] = {&depth, 1, 1, frame.display};
  Scene scene;
  scene.camera = Camera{glm::lookAt(glm::dvec3(0, 2, 5), glm::dvec3(0), glm::dvec3(0, 1, 0)),
                        perspective(0.8, 1, 0.1, 1000, ClipSpace::kGl), ClipSpace::kGl};
  scene.water = WaterPlane{{0, 1, 0}, 0};
  Target target;
  for (int c = 0; c < 3; ++c) target.color[c] = {&out[c], 4, 4, frame.display};
  target.alpha = {&out[3], 4, 4, frame.display};
  run_fused(make_plan(look, {.planes = frame.present()}), frame, scene, target, *make_executor(0));
  return out;
}

bool refuses_a_wrong_look() {
  try {
    Look().set("depth_fog", "density", -1.0);
  } catch (const Error& error) {
    return std::string(error.what()).find("depth_fog.density") != std::string::npos;
  }
  return false;
}

}  // namespace

int main() {
  Look dense;
  dense.set("depth_fog", "density", 0.4);
  if (wet(dense) == std::array<float, 4>{0.3f, 0.3f, 0.3f, 1.0f}) {
    std::cerr << "the pixel is still dry\n";
    return 1;
  }
  if (!refuses_a_wrong_look()) {
    std::cerr << "density -1 was not refused by a limpid::Error\n";
    return 1;
  }
  return 0;
}
