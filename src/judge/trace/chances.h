#pragma once
#include <algorithm>
#include <array>

#include "limpid/core/vec.h"

namespace limpid::trace {

inline std::array<double, 3> channels_of(const Rgb<double>& c) { return {c.r, c.g, c.b}; }

/// Weights of a random path in each channel. The path is drawn by the probabilities of one channel,
/// which is drawn itself, and carries light of all channels: a channel's own probability of the
/// path over the mean of all, at most 3. So no channel gets a bright dot from a path that is likely
/// only in another. Wilkie et al. 2014, "Hero Wavelength Spectral Sampling".
class Chances {
 public:
  /// `mask`: 1 for the channels of the path, else 0; at least one. `random` in 0 ... 1.
  Chances(const Rgb<double>& mask, double random) : own_(channels_of(mask)) {
    for (const double own : own_) count_ += own;
    double left = random * count_;
    for (std::size_t c = 0; c < 3; ++c) {
      if (own_[c] == 0) continue;
      drawn_ = c;
      if ((left -= own_[c]) < 0) break;
    }
  }

  /// The value in the channel by which the path is drawn.
  double drawn(const Rgb<double>& of) const { return channels_of(of)[drawn_]; }

  /// Extends the path by an event of these probabilities; that of drawn() is above 0.
  void go_on(const Rgb<double>& chance) {
    const std::array<double, 3> by = channels_of(chance);
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, own_[c] *= by[c]);
    for (double& own : own_) own /= largest;  // the probabilities of long paths are tiny
  }

  Rgb<double> worth() const {
    const double share = count_ / (own_[0] + own_[1] + own_[2]);
    return {share * own_[0], share * own_[1], share * own_[2]};
  }

 private:
  std::array<double, 3> own_;
  double count_ = 0;
  std::size_t drawn_ = 0;
};

}  // namespace limpid::trace
