#include <cmath>

#include "limpid/core/error.h"
#include "limpid/files/text/scene_file.h"

#include "enter/clip_direction.h"

namespace limpid {
namespace {

double aspect_of(Size display, double pixel_aspect) {
  if (display.width <= 0 || display.height <= 0) {
    throw Error("camera: the picture is " + std::to_string(display.width) + "x" +
                std::to_string(display.height) + ", expected at least 1x1");
  }
  if (!(pixel_aspect > 0) || std::isinf(pixel_aspect)) {
    throw Error("camera: pixel aspect " + std::to_string(pixel_aspect) +
                ", expected a number above 0");
  }
  return display.width * pixel_aspect / display.height;
}

glm::dmat4 projection_of(const CameraSpec& spec, double aspect) {
  switch (spec.lens) {
    case CameraSpec::Lens::kProjection:
      return spec.projection;
    case CameraSpec::Lens::kFovX: {
      const double fov_y = 2 * std::atan(std::tan(spec.extent / 2) / aspect);
      return perspective(fov_y, aspect, spec.near, spec.far, spec.clip);
    }
    case CameraSpec::Lens::kFovY:
      return perspective(spec.extent, aspect, spec.near, spec.far, spec.clip);
    case CameraSpec::Lens::kOrthographic:
      return orthographic(spec.extent, spec.extent / aspect, spec.near, spec.far, spec.clip);
  }
  return {};
}

}  // namespace

Camera camera_for(const CameraSpec& spec, Size display, double pixel_aspect) {
  const double aspect = aspect_of(display, pixel_aspect);
  const Camera camera{spec.view, projection_of(spec, aspect), spec.clip};
  camera.validate();
  expect_clip_direction(camera);
  return camera;
}

}  // namespace limpid
