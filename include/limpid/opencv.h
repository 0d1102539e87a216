#pragma once
#include <array>
#include <cstddef>
#include <string>

#include <opencv2/core.hpp>

#include "limpid/compositor.h"
#include "limpid/core/error.h"

/// @file
/// Adapter for pictures of OpenCV, without copies. A matrix must be 2D, with 1, 3 or 4 channels of
/// float or half (CV_32FC1, CV_16FC3 ...); it may have any step and be a part of a larger matrix.
/// Channels of colors are in OpenCV's order, B G R (A). The pixel at row 0, column 0 has the
/// position `at` in the picture, by default 0, 0. Bytes and doubles are refused by an Error such as
/// `cv::Mat of CV_8UC3: expected ...`: 8-bit pictures are not scene-linear, and the adapter does
/// not know their transfer curve. Views do not share the matrix's reference count: the matrix must
/// outlive them.

namespace limpid {

/// Throws Error unless the matrix has a type that can be read without a copy.
inline void validate(const cv::Mat& mat) {
  const int depth = mat.depth(), channels = mat.channels();
  const bool fits = mat.dims == 2 && !mat.empty() && (depth == CV_32F || depth == CV_16F) &&
                    (channels == 1 || channels == 3 || channels == 4);
  if (fits) return;
  const std::string what = mat.empty()     ? "without pixels"
                           : mat.dims != 2 ? "of " + std::to_string(mat.dims) + " dimensions"
                                           : "of " + cv::typeToString(mat.type());
  throw Error("cv::Mat " + what +
              ": expected rows and columns of CV_32F or CV_16F, scene-linear, 1, 3 or 4 channels");
}

inline Rect window_of(const cv::Mat& mat, cv::Point at = {}) {
  return {at.x, at.y, at.x + mat.cols, at.y + mat.rows};
}

/// A channel for reading or writing; type and size of the matrix do not change. Throws Error as
/// validate() does, and for a missing channel.
inline HostOutput channel_of(const cv::Mat& mat, int channel, cv::Point at = {}) {
  validate(mat);
  if (channel < 0 || channel >= mat.channels()) {
    throw Error("cv::Mat of " + cv::typeToString(mat.type()) + ": has no channel " +
                std::to_string(channel));
  }
  return {mat.data + mat.elemSize1() * static_cast<std::size_t>(channel),
          mat.depth() == CV_16F ? Sample::kHalf : Sample::kFloat,
          static_cast<std::ptrdiff_t>(mat.elemSize()), static_cast<std::ptrdiff_t>(mat.step[0]),
          window_of(mat, at)};
}

/// The channels red, green, blue. Throws Error as validate() does, and for a matrix of one channel.
inline std::array<HostOutput, 3> colors_of(const cv::Mat& mat, cv::Point at = {}) {
  validate(mat);
  if (mat.channels() < 3) {
    throw Error("cv::Mat of " + cv::typeToString(mat.type()) +
                ": expected colors, 3 channels B G R or 4 B G R A");
  }
  return {channel_of(mat, 2, at), channel_of(mat, 1, at), channel_of(mat, 0, at)};
}

/// Uses a channel as a plane of the frame, as in set_plane(frame, PlaneId::kDepth, depth).
inline void set_plane(HostFrame& frame, PlaneId id, const cv::Mat& mat, int channel = 0,
                      cv::Point at = {}) {
  frame.plane(id) = channel_of(mat, channel, at);
}

/// Three planes from `red` on, as in set_colors(frame, PlaneId::kReflectionR, mirrored). A fourth
/// channel is ignored.
inline void set_colors(HostFrame& frame, PlaneId red, const cv::Mat& mat, cv::Point at = {}) {
  const std::array<HostOutput, 3> colors = colors_of(mat, at);
  for (int c = 0; c < 3; ++c) frame.plane(plane_after(red, c)) = colors[c];
}

/// Sets the dry picture: with alpha and premultiplied colors if the matrix has four channels,
/// without alpha if it has three.
inline void set_color(HostFrame& frame, const cv::Mat& mat, cv::Point at = {}) {
  set_colors(frame, PlaneId::kColorR, mat, at);
  frame.plane(PlaneId::kColorA) = mat.channels() == 4 ? channel_of(mat, 3, at) : HostOutput{};
}

/// The matrix as the destination of the wet picture, with alpha if it has four channels.
inline HostPicture picture_of(const cv::Mat& mat, cv::Point at = {}) {
  HostPicture picture;
  picture.color = colors_of(mat, at);
  if (mat.channels() == 4) picture.alpha = channel_of(mat, 3, at);
  return picture;
}

/// A tiling map or an environment. Throws Error unless it is CV_32F with 3 or 4 channels.
inline Texture texture_of(const cv::Mat& mat) {
  const std::array<HostOutput, 3> colors = colors_of(mat);
  if (mat.depth() != CV_32F) {
    throw Error("texture of cv::Mat of " + cv::typeToString(mat.type()) + ": expected CV_32F");
  }
  Texture texture;
  for (int c = 0; c < 3; ++c) {
    texture.channels[c] = {static_cast<const float*>(colors[c].data), mat.channels(),
                           static_cast<std::ptrdiff_t>(mat.step1()), colors[c].window};
  }
  return texture;
}

}  // namespace limpid
