// Components opencv and oiio bring the libraries whose types the adapters take, and the core.
#include <cstdio>

#include <OpenImageIO/imagebuf.h>
#include <opencv2/core.hpp>

#include "limpid/core/rect.h"
#include "limpid/core/simd.h"

int main() {
  const limpid::Size size{3, 2};
  const cv::Mat mat(size.height, size.width, CV_32FC4, cv::Scalar(1));
  const OIIO::ImageBuf image(OIIO::ImageSpec(size.width, size.height, 4, OIIO::TypeDesc::FLOAT));
  const limpid::Size of_mat{mat.cols, mat.rows}, of_image{image.spec().width, image.spec().height};
  const bool right = of_mat == size && of_image == size && cv::sum(mat)[0] == 6;
  if (!right) std::fputs("a picture is not 3x2\n", stderr);
  return right && !limpid::simd_targets().empty() ? 0 : 1;
}
