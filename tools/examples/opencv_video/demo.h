#pragma once
#include <string>

#include <opencv2/core.hpp>

#include "limpid/core/camera.h"

/// Draws a short dry video, a ball that bobs in a tiled basin, and the depth of each frame, exact:
/// `depth` is a pattern as depth_path() takes it. The water will be at y = 0.
void make_demo(const std::string& video, const std::string& depth, const limpid::Camera& camera,
               cv::Size size, int frames, double per_second);

/// The pattern with its #s replaced by the number of the frame: depth_##.tiff, 7: depth_07.tiff.
std::string depth_path(const std::string& pattern, int frame);
