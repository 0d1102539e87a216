#include "show/palette.h"

#include <algorithm>
#include <cstddef>

namespace limpid {
namespace {

constexpr int kBits = 5;
constexpr int kBins = 1 << 3 * kBits;

using Rgb8 = std::array<std::uint8_t, 3>;

int bin_of(const std::uint8_t* rgb) {
  constexpr int kRest = 8 - kBits;
  return rgb[0] >> kRest << 2 * kBits | rgb[1] >> kRest << kBits | rgb[2] >> kRest;
}

int part_of(int bin, int channel) { return bin >> (2 - channel) * kBits & ((1 << kBits) - 1); }

/// The pixels of nearly the same color.
struct Bin {
  std::int64_t count = 0;
  std::array<std::int64_t, 3> sum{};
};

/// Bins that become one color: a range of the list of bins.
struct Box {
  std::vector<int>::iterator begin, end;
  int side = 0;  ///< the longest: a channel
  int length = 0;
  std::int64_t count = 0;

  Box(std::vector<int>::iterator from, std::vector<int>::iterator to, const std::vector<Bin>& bins)
      : begin(from), end(to) {
    for (int channel = 0; channel < 3; ++channel) {
      const auto [least, most] = std::minmax_element(
          from, to, [&](int a, int b) { return part_of(a, channel) < part_of(b, channel); });
      const int long_by = part_of(*most, channel) - part_of(*least, channel);
      if (long_by > length) {
        length = long_by;
        side = channel;
      }
    }
    for (auto bin = from; bin != to; ++bin) count += bins[static_cast<std::size_t>(*bin)].count;
  }

  /// The largest is split next: by length, weighted with pixels.
  std::int64_t weight() const { return length * count; }
};

/// The first bin of the second half, by pixels; each half has at least one bin.
std::vector<int>::iterator median_of(Box& box, const std::vector<Bin>& bins) {
  std::sort(box.begin, box.end, [&](int a, int b) {
    return std::pair(part_of(a, box.side), a) < std::pair(part_of(b, box.side), b);
  });
  std::int64_t before = 0;
  for (auto bin = box.begin; bin != box.end - 1; ++bin) {
    before += bins[static_cast<std::size_t>(*bin)].count;
    if (2 * before >= box.count) return bin + 1;
  }
  return box.end - 1;
}

}  // namespace

Paletted paletted(std::span<const std::uint8_t> rgb, int most_colors) {
  std::vector<Bin> bins(kBins);
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    Bin& bin = bins[static_cast<std::size_t>(bin_of(&rgb[i]))];
    ++bin.count;
    for (std::size_t c = 0; c < 3; ++c) bin.sum[c] += rgb[i + c];
  }
  std::vector<int> used;
  for (int i = 0; i < kBins; ++i) {
    if (bins[static_cast<std::size_t>(i)].count > 0) used.push_back(i);
  }
  Paletted result;
  if (used.empty()) return result;

  std::vector<Box> boxes{{used.begin(), used.end(), bins}};
  while (static_cast<int>(boxes.size()) < most_colors) {
    const auto widest =
        std::max_element(boxes.begin(), boxes.end(),
                         [](const Box& a, const Box& b) { return a.weight() < b.weight(); });
    if (widest->length == 0) break;
    const auto middle = median_of(*widest, bins);
    const Box upper(middle, widest->end, bins);
    *widest = Box(widest->begin, middle, bins);
    boxes.push_back(upper);
  }

  std::vector<std::uint8_t> index_of(kBins);
  for (const Box& box : boxes) {
    std::array<std::int64_t, 3> sum{};
    for (auto bin = box.begin; bin != box.end; ++bin) {
      index_of[static_cast<std::size_t>(*bin)] = static_cast<std::uint8_t>(result.colors.size());
      for (std::size_t c = 0; c < 3; ++c) sum[c] += bins[static_cast<std::size_t>(*bin)].sum[c];
    }
    Rgb8 mean;
    for (std::size_t c = 0; c < 3; ++c) {
      mean[c] = static_cast<std::uint8_t>((sum[c] + box.count / 2) / box.count);
    }
    result.colors.push_back(mean);
  }
  result.pixels.reserve(rgb.size() / 3);
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    result.pixels.push_back(index_of[static_cast<std::size_t>(bin_of(&rgb[i]))]);
  }
  return result;
}

}  // namespace limpid
