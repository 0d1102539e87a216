#pragma once
#include <cstdint>
#include <string>

#include "judge/compare/color_pair.h"

namespace limpid {

/// Structural similarity of two pictures.
struct Ssim {
  Plane map;        ///< 1 where they are equal, down to -1; -inf at mismatches (color_pair.h)
  double mean = 0;  ///< over pixels whose window lies in the picture: 5 from each side
  double min = 0;   ///< over these pixels
  std::int64_t mismatches = 0;  ///< pixels of the whole picture; one makes the mean -inf
};

/// Structural similarity (Wang, Bovik, Sheikh & Simoncelli 2004 "Image Quality Assessment: From
/// Error Visibility to Structural Similarity"): window 11x11, Gaussian of sigma 1.5, K1 = .01, K2 =
/// .03, population variances, like the authors' own program and scikit-image (gaussian_weights, no
/// sample covariance). For one channel with values 0 ... 1; others are not clamped. Sums in double,
/// in a fixed order: the same bits for any number of threads. Throws Error for different windows
/// and for pictures smaller than 11x11.
Ssim ssim(View<const float> a, View<const float> b);

/// The same for the luminance (.2126 .7152 .0722), clamped to 0 ... 1 and encoded as sRGB, as on a
/// display.
Ssim ssim(const ColorPair& pictures);

/// "0.981, min 0.32".
std::string to_text(const Ssim& ssim);

}  // namespace limpid
