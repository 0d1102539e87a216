#include "limpid/opencv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plain.h"

namespace limpid::test {
namespace {

using testing::HasSubstr;

constexpr Rect kWindow{0, 0, 37, 21};

/// Where a channel lies in OpenCV's pixels.
int place_of(int channel) { return channel == kAlpha ? 3 : 2 - channel; }

/// The pixels as floats; channels are in OpenCV's order.
cv::Mat dry_mat(int channels, Rect window = kWindow) {
  cv::Mat mat(window.height(), window.width(), CV_32FC(channels));
  for (int y = 0; y < mat.rows; ++y) {
    for (int x = 0; x < mat.cols; ++x) {
      for (int c = 0; c < channels; ++c) {
        mat.ptr<float>(y, x)[place_of(c)] = dry(window.x0 + x, window.y0 + y, c);
      }
    }
  }
  return mat;
}

cv::Mat depth_mat(Rect window = kWindow) {
  cv::Mat mat(window.height(), window.width(), CV_32FC1);
  for (int y = 0; y < mat.rows; ++y) {
    for (int x = 0; x < mat.cols; ++x) {
      mat.at<float>(y, x) = dry(window.x0 + x, window.y0 + y, kDepth);
    }
  }
  return mat;
}

cv::Mat as(const cv::Mat& mat, int depth) {
  cv::Mat result;
  mat.convertTo(result, depth);
  return result;
}

/// The plain channels as a matrix of OpenCV's order and of that depth.
cv::Mat mat_of(const std::vector<std::vector<float>>& channels, int depth, Rect window = kWindow) {
  cv::Mat mat(window.height(), window.width(), CV_32FC(static_cast<int>(channels.size())));
  for (int y = 0; y < mat.rows; ++y) {
    for (int x = 0; x < mat.cols; ++x) {
      for (int c = 0; c < mat.channels(); ++c) {
        mat.ptr<float>(y, x)[place_of(c)] = channels[c][y * mat.cols + x];
      }
    }
  }
  return as(mat, depth);
}

/// Number of rows that differ in a bit.
int rows_that_differ(const cv::Mat& a, const cv::Mat& b) {
  EXPECT_EQ(a.size(), b.size());
  EXPECT_EQ(a.type(), b.type());
  int count = 0;
  for (int y = 0; y < a.rows; ++y)
    count += std::memcmp(a.ptr(y), b.ptr(y), a.elemSize() * a.cols) != 0;
  return count;
}

TEST(OpenCv, EveryTypeGivesTheBitsOfPlainArrays) {
  for (const int depth : {CV_32F, CV_16F}) {
    for (const int channels : {3, 4}) {
      SCOPED_TRACE(cv::typeToString(CV_MAKETYPE(depth, channels)));
      const Plain plain(kWindow);
      const cv::Mat color = as(dry_mat(channels), depth), eye = as(depth_mat(), depth);
      cv::Mat wet = cv::Mat::zeros(color.size(), color.type());
      HostFrame frame = plain.empty_frame();
      set_color(frame, color);
      set_plane(frame, PlaneId::kDepth, eye);
      composite(frame, picture_of(wet));
      EXPECT_EQ(rows_that_differ(wet, mat_of(plain.wet(channels == 4), depth)), 0);
      EXPECT_GT(rows_that_differ(wet, color), kWindow.height() / 2) << "there is water";
    }
  }
}

TEST(OpenCv, InPlace) {
  const Plain plain(kWindow);
  cv::Mat color = dry_mat(4);
  const cv::Mat eye = depth_mat();
  HostFrame frame = plain.empty_frame();
  set_color(frame, color);
  set_plane(frame, PlaneId::kDepth, eye);
  composite(frame, picture_of(color));
  EXPECT_EQ(rows_that_differ(color, mat_of(plain.wet(), CV_32F)), 0);
}

TEST(OpenCv, PartsOfLargerMatricesAreReadAndWrittenWhereTheyLie) {
  const Plain plain(kWindow);
  const cv::Rect part(5, 3, kWindow.width(), kWindow.height());
  cv::Mat large(40, 60, CV_32FC3, cv::Scalar(7, 8, 9)), eyes(30, 70, CV_32FC1);
  dry_mat(3).copyTo(large(part));
  depth_mat().copyTo(eyes(part));
  const cv::Mat before = large.clone();
  HostFrame frame = plain.empty_frame();
  set_color(frame, large(part));
  set_plane(frame, PlaneId::kDepth, eyes(part));
  composite(frame, picture_of(large(part)));

  cv::Mat expected = before.clone();
  mat_of(plain.wet(false), CV_32F).copyTo(expected(part));
  EXPECT_EQ(rows_that_differ(large, expected), 0);
  EXPECT_GT(rows_that_differ(large, before), 0);
}

TEST(OpenCv, OverscanBeginsAtAPlaceOfItsOwn) {
  const Rect overscan{-4, -3, 45, 29};
  const Plain plain(kWindow, overscan);
  const cv::Point at(overscan.x0, overscan.y0);
  cv::Mat color = dry_mat(4, overscan);
  const cv::Mat eye = depth_mat(overscan);
  HostFrame frame = plain.empty_frame();
  set_color(frame, color, at);
  set_plane(frame, PlaneId::kDepth, eye, 0, at);
  EXPECT_EQ(frame.plane(PlaneId::kColorR).window, overscan);
  composite(frame, picture_of(color, at));
  EXPECT_EQ(rows_that_differ(color, mat_of(plain.wet(), CV_32F, overscan)), 0);
}

TEST(OpenCv, ChannelsAreInTheOrderOfOpenCv) {
  const cv::Mat pixel(1, 1, CV_32FC4, cv::Scalar(0.1, 0.2, 0.3, 0.4));
  HostFrame frame;
  set_color(frame, pixel);
  EXPECT_EQ(sample_at(frame.plane(PlaneId::kColorR), 0, 0), 0.3f);
  EXPECT_EQ(sample_at(frame.plane(PlaneId::kColorG), 0, 0), 0.2f);
  EXPECT_EQ(sample_at(frame.plane(PlaneId::kColorB), 0, 0), 0.1f);
  EXPECT_EQ(sample_at(frame.plane(PlaneId::kColorA), 0, 0), 0.4f);
  set_colors(frame, PlaneId::kReflectionR, pixel);
  EXPECT_EQ(sample_at(frame.plane(PlaneId::kReflectionR), 0, 0), 0.3f);
  EXPECT_EQ(sample_at(frame.plane(PlaneId::kReflectionB), 0, 0), 0.1f);
  set_plane(frame, PlaneId::kShadow, pixel, 1);
  EXPECT_EQ(sample_at(frame.plane(PlaneId::kShadow), 0, 0), 0.2f);
  const HostPicture picture = picture_of(pixel);
  EXPECT_EQ(sample_at(picture.color[0], 0, 0), 0.3f);
  EXPECT_EQ(sample_at(picture.color[2], 0, 0), 0.1f);
  EXPECT_EQ(sample_at(picture.alpha, 0, 0), 0.4f);
  EXPECT_EQ(texture_of(pixel).channels[0].at(0, 0), 0.3f);
  EXPECT_EQ(texture_of(pixel).channels[2].at(0, 0), 0.1f);
}

TEST(OpenCv, ThreeChannelsTakeTheAlphaAway) {
  HostFrame frame;
  set_color(frame, dry_mat(4));
  EXPECT_TRUE(frame.plane(PlaneId::kColorA));
  set_color(frame, dry_mat(3));
  EXPECT_FALSE(frame.plane(PlaneId::kColorA));
  EXPECT_FALSE(picture_of(dry_mat(3)).alpha);
}

TEST(OpenCv, TexturesHaveTheirSteps) {
  const cv::Mat large = dry_mat(3);
  const Texture texture = texture_of(large(cv::Rect(4, 2, 9, 5)));
  EXPECT_EQ(texture.channels[0].window, (Rect{0, 0, 9, 5}));
  EXPECT_EQ(texture.channels[0].at(3, 4), dry(7, 6, kRed));
  EXPECT_EQ(texture.channels[2].at(8, 0), dry(12, 2, kBlue));
}

std::string refusal(const cv::Mat& mat) {
  try {
    channel_of(mat, 0);
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

TEST(OpenCv, OtherTypesAreRefusedInASentence) {
  EXPECT_EQ(refusal(cv::Mat(2, 2, CV_8UC3)),
            "cv::Mat of CV_8UC3: expected rows and columns of CV_32F or CV_16F, scene-linear, 1, 3 "
            "or 4 channels");
  EXPECT_THAT(refusal(cv::Mat(2, 2, CV_64FC1)), HasSubstr("of CV_64FC1: expected"));
  EXPECT_THAT(refusal(cv::Mat(2, 2, CV_32FC2)), HasSubstr("of CV_32FC2: expected"));
  EXPECT_THAT(refusal(cv::Mat()), HasSubstr("without pixels: expected"));
  const int sizes[] = {2, 2, 2};
  EXPECT_THAT(refusal(cv::Mat(3, sizes, CV_32FC1)), HasSubstr("of 3 dimensions: expected"));
  EXPECT_EQ(refusal(cv::Mat(2, 2, CV_16FC1)), "taken");
}

TEST(OpenCv, ChannelsThatAreNotThereAreRefused) {
  const cv::Mat gray(2, 2, CV_32FC1), half(2, 2, CV_16FC3);
  HostFrame frame;
  EXPECT_THROW(set_color(frame, gray), Error);
  EXPECT_THROW(picture_of(gray), Error);
  EXPECT_THROW(set_plane(frame, PlaneId::kDepth, gray, 1), Error);
  EXPECT_THROW(set_plane(frame, PlaneId::kDepth, gray, -1), Error);
  EXPECT_FALSE(frame.plane(PlaneId::kDepth));
  EXPECT_THROW(texture_of(half), Error);
}

}  // namespace
}  // namespace limpid::test
