// Puts water into a video: opencv_video DRY.avi DEPTH WET.avi FOV HEIGHT PITCH
//
// DEPTH is a picture of float eye depths in metres, TIFF or PFM: one file for all frames of a
// locked camera, else a pattern with #s for the frame's number, depth_##.tiff. FOV is the vertical
// angle of the lens, HEIGHT the height of the camera above the water, PITCH its angle below the
// horizon: degrees, metres, degrees. Without arguments the program first draws a dry video with
// depths.
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "limpid/opencv.h"

#include "demo.h"

namespace {

limpid::Camera camera_of(double fov, double height, double pitch, cv::Size size) {
  limpid::Camera camera;
  camera.view = glm::rotate(glm::dmat4(1), glm::radians(pitch), glm::dvec3(1, 0, 0)) *
                glm::translate(glm::dmat4(1), glm::dvec3(0, -height, 0));
  camera.projection =
      limpid::perspective(glm::radians(fov), double(size.width) / size.height, 0.1,
                          std::numeric_limits<double>::infinity(), limpid::ClipSpace::kGl);
  return camera;
}

/// limpid works on light, not on bytes: 8-bit video is encoded with the sRGB curve.
cv::Mat linear_from_srgb(const cv::Mat& bytes) {
  cv::Mat1f curve(1, 256);
  for (int i = 0; i < 256; ++i) {
    const double v = i / 255.0;
    curve(i) = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
  }
  cv::Mat linear;
  cv::LUT(bytes, curve, linear);
  return linear;
}

cv::Mat srgb_from_linear(const cv::Mat& linear) {
  cv::Mat steep = linear * 12.92, curve, bytes;
  cv::pow(cv::max(linear, 0), 1 / 2.4, curve);
  curve = curve * 1.055 - cv::Scalar::all(0.055);
  steep.copyTo(curve, linear <= 0.0031308);
  curve.convertTo(bytes, CV_8U, 255);
  return bytes;
}

limpid::Look pool_water() {
  limpid::Look look;
  look.set("wave_normals", "model", "sines");
  look.set("wave_normals", "waves", limpid::Rows{{0.02, 2.5, 0.8, 0}, {0.012, -1.9, 4.1, 1}});
  look.set("depth_fog", "water_type", "I");
  look.set("depth_fog", "scattering", limpid::Rgb<double>{0.01, 0.02, 0.02});
  look.set("fresnel_reflection", "source", "constant");
  look.set("fresnel_reflection", "color", limpid::Rgb<double>{0.55, 0.75, 1});
  return look;
}

void composite(const std::string& dry, const std::string& depth, const std::string& wet, double fov,
               double height, double pitch) {
  cv::VideoCapture reader(dry);
  if (!reader.isOpened()) throw std::runtime_error(dry + ": cannot be read");
  const double known = reader.get(cv::CAP_PROP_FPS);
  const double per_second = known > 0 ? known : 24;  // picture sequences have no rate
  limpid::Compositor water({.depth = limpid::DepthKind::kEye}, pool_water());
  limpid::HostFrame frame;
  frame.scene.water = limpid::WaterPlane{};
  frame.scene.sun = limpid::Sun{normalize(glm::dvec3(0.5, 1, 0.35)), {2, 2, 1.8}};

  cv::VideoWriter writer;
  cv::Mat bytes, eye_depth;
  int frames = 0, changed = 0;
  for (; reader.read(bytes); ++frames) {
    cv::Mat picture = linear_from_srgb(bytes);
    const std::string path = depth_path(depth, frames);
    if (frames == 0 || path != depth) eye_depth = cv::imread(path, cv::IMREAD_UNCHANGED);
    if (eye_depth.empty()) throw std::runtime_error(path + ": cannot be read");

    frame.display = limpid::window_of(picture);
    frame.scene.camera = camera_of(fov, height, pitch, picture.size());
    frame.scene.time = frames / per_second;
    limpid::set_color(frame, picture);  // B, G, R of OpenCV become R, G, B
    limpid::set_plane(frame, limpid::PlaneId::kDepth, eye_depth);
    water.run(frame, limpid::picture_of(picture));  // in place

    const cv::Mat result = srgb_from_linear(picture);
    if (frames == 0) {
      writer.open(wet, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                  per_second, result.size());
    }
    if (!writer.isOpened()) throw std::runtime_error(wet + ": cannot be written");
    writer.write(result);
    changed = cv::countNonZero(cv::Mat(result != bytes).reshape(1));
  }
  if (changed == 0) throw std::runtime_error(dry + ": no water came to lie in its last frame");
  std::printf("%s: %d frames of %dx%d, %.0f %% of the last one's values changed\n", wet.c_str(),
              frames, frame.display.width(), frame.display.height(),
              100.0 * changed / (3.0 * static_cast<double>(frame.display.area())));
}

}  // namespace

int main(int count, char** words) try {
  if (count == 1) {
    const cv::Size size(384, 216);
    make_demo("dry.avi", "depth_##.tiff", camera_of(50, 2.2, 34, size), size, 36, 24);
    composite("dry.avi", "depth_##.tiff", "wet.avi", 50, 2.2, 34);
  } else if (count == 7) {
    composite(words[1], words[2], words[3], std::stod(words[4]), std::stod(words[5]),
              std::stod(words[6]));
  } else {
    throw std::runtime_error("usage: opencv_video [DRY.avi DEPTH WET.avi FOV HEIGHT PITCH]");
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "opencv_video: %s\n", error.what());
  return 1;
}
