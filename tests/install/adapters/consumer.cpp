// Components opencv and oiio bring the libraries whose pictures the adapters take, and the core.
#include <cstdio>

#include "limpid/core/simd.h"
#include "limpid/oiio.h"
#include "limpid/opencv.h"

int main() {
  const cv::Mat mat(2, 3, CV_32FC4, cv::Scalar(1));
  const OIIO::ImageBuf image(OIIO::ImageSpec(3, 2, 4, OIIO::TypeDesc::FLOAT));
  limpid::HostFrame frame;
  limpid::set_color(frame, mat);
  limpid::set_plane(frame, limpid::PlaneId::kDepth, image, "R");
  const limpid::Rect window{0, 0, 3, 2};
  const bool right = frame.plane(limpid::PlaneId::kColorB).data == mat.data &&
                     frame.plane(limpid::PlaneId::kDepth).data == image.localpixels() &&
                     limpid::window_of(mat) == window && limpid::window_of(image) == window;
  if (!right) std::fputs("the views are not those of the pictures\n", stderr);
  return right && !limpid::simd_targets().empty() ? 0 : 1;
}
