#include "run/shared_bytes.h"

#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support.h"

namespace limpid {
namespace {

/// All bytes that the pixels have, one by one.
std::multiset<const std::byte*> bytes_in(const HostOutput& view, const Rect& pixels) {
  std::multiset<const std::byte*> bytes;
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      const std::byte* sample = static_cast<const std::byte*>(view.data) +
                                (x - view.window.x0) * view.x_stride +
                                (y - view.window.y0) * view.y_stride;
      for (std::ptrdiff_t i = 0; i < bytes_of(view.sample); ++i) bytes.insert(sample + i);
    }
  }
  return bytes;
}

bool is_twice(const std::multiset<const std::byte*>& bytes) {
  return std::set<const std::byte*>(bytes.begin(), bytes.end()).size() != bytes.size();
}

TEST(SharedBytes, AreThoseThatCountingFinds) {
  static std::byte memory[4096];
  int own = 0, shared = 0, apart = 0;
  for (int seed = 0; seed < 30000; ++seed) {
    int next = 0;
    const auto any = [&](int count) {
      return static_cast<int>(test::noise(seed, next++, 31) * 0.9999f * static_cast<float>(count));
    };
    const Rect pixels = {any(3), any(3), 3 + any(4), 3 + any(4)};
    const auto view = [&] {
      HostOutput made;
      made.data = memory + 2048 + any(120) - 60;
      made.sample = any(2) == 0 ? Sample::kHalf : Sample::kFloat;
      made.window = {0, 0, 8, 8};
      const int small = 1 + any(9), large = 1 + any(60);
      made.x_stride = (any(2) == 0 ? small : large) * (any(4) == 0 ? -1 : 1);
      made.y_stride = (std::abs(made.x_stride) == small ? large : small) * (any(4) == 0 ? -1 : 1);
      return made;
    };
    const HostOutput a = view();
    HostOutput b = view();
    if (any(2) == 0) b.x_stride = a.x_stride, b.y_stride = a.y_stride;
    auto bytes = bytes_in(a, pixels);
    const auto more = bytes_in(b, pixels);
    const bool one = is_twice(bytes), other = is_twice(more);
    // A view that is interlaced with itself, without shared bytes, may count as sharing; a view
    // that shares bytes always counts.
    ASSERT_TRUE(!one || shares_bytes(a, pixels)) << seed;
    own += shares_bytes(a, pixels);
    if (shares_bytes(a, pixels) || shares_bytes(b, pixels) || other) continue;
    ASSERT_FALSE(one);
    bytes.insert(more.begin(), more.end());
    ASSERT_EQ(share_bytes(a, b, pixels), is_twice(bytes)) << seed;
    ASSERT_EQ(share_bytes(b, a, pixels), is_twice(bytes)) << seed;
    (is_twice(bytes) ? shared : apart)++;
  }
  EXPECT_GT(own, 1000);
  EXPECT_GT(shared, 1000);
  EXPECT_GT(apart, 1000);
}

TEST(SharedBytes, ChannelsOfInterleavedPixelsHaveNone) {
  std::vector<float> memory(4 * 64 * 32);
  const Rect all = rect_of({64, 32});
  for (int i = 0; i < 4; ++i) {
    const HostOutput a = interleaved<void>(memory.data(), Sample::kFloat, 4, i, {64, 32});
    EXPECT_FALSE(shares_bytes(a, all));
    for (int j = 0; j < i; ++j) {
      const HostOutput b = interleaved<void>(memory.data(), Sample::kFloat, 4, j, {64, 32});
      EXPECT_FALSE(share_bytes(a, b, all));
    }
  }
}

}  // namespace
}  // namespace limpid
