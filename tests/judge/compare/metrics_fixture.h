#pragma once
#include <cstring>
#include <fstream>

#include <gtest/gtest.h>

#include "judge/compare/flip.h"
#include "paths.h"

/// Two synthetic pictures and the numbers of tests/tools/metrics_numpy.py for them.

namespace limpid::test {

struct MetricsFixture {
  MetricsFixture() {
    std::ifstream file(LIMPID_TEST_DATA "/metrics_36x32.bin", std::ios::binary);
    char magic[8];
    file.read(magic, 8);
    EXPECT_EQ(std::memcmp(magic, "limpid-m", 8), 0);
    std::int32_t width = 0, height = 0, count = 0;
    const auto number = [&](auto& value) {
      file.read(reinterpret_cast<char*>(&value), sizeof value);
    };
    number(width), number(height);
    number(exposures.start), number(exposures.stop), number(count);
    exposures.count = count;
    for (int i = 0; i < 9; ++i) {
      const View<float> plane = planes_.emplace_back(rect_of({width, height})).view();
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) number(plane.at(x, y));
      }
    }
    EXPECT_TRUE(file.good());
  }

  ColorPair pictures() const { return {views(0), views(3)}; }
  View<const float> ssim() const { return planes_[6].view(); }
  View<const float> flip() const { return planes_[7].view(); }
  View<const float> hdr_flip() const { return planes_[8].view(); }

  Exposures exposures;

 private:
  ColorViews views(std::size_t first) const {
    return {planes_[first].view(), planes_[first + 1].view(), planes_[first + 2].view()};
  }
  std::vector<Plane> planes_;
};

}  // namespace limpid::test
