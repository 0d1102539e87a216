#pragma once
#include <cstdint>

namespace limpid::trace {

/// Random numbers in 0 ... 1 that depend only on seed, pixel, sample and their index; or, for a
/// single sample in a pixel's middle, always 1/2.
class Samples {
 public:
  Samples() = default;
  Samples(std::uint64_t seed, int x, int y, int sample)
      : key_(mixed(mixed(mixed(mixed(seed) + as_unsigned(x)) + as_unsigned(y)) +
                   as_unsigned(sample))),
        random_(true) {}

  double next() {
    if (!random_) return 0.5;
    return static_cast<double>(mixed(key_ + ++count_) >> 11) * 0x1p-53;
  }

 private:
  static std::uint64_t as_unsigned(int i) { return static_cast<std::uint64_t>(i); }
  /// Steele, Lea & Flood 2014, "Fast Splittable Pseudorandom Number Generators".
  static std::uint64_t mixed(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t key_ = 0, count_ = 0;
  bool random_ = false;
};

}  // namespace limpid::trace
