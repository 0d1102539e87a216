#include "complete/edge_blur.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace limpid {
namespace {

/// Growth that indicates a blur: the narrowest, the box of one pixel, grows by 1.28.
constexpr double kGrows = 1.12;
/// Of the steps of sharp pictures a tenth to a third grow by chance, of antialiased ones two thirds
/// and more. Their share is independent of their contrast: a bright line along one edge outweighs
/// all other edges in the sums.
constexpr double kMostGrow = 0.45;
/// A ramp that is not yet full at a distance has more than doubled up to there; slower growth is
/// light and texture of the two sides.
constexpr double kRamp = 1.6;
/// This share of the squared contrast on both sides of the band indicates light that rises evenly:
/// it has ((k + 1) / (2 k + 1))^2, at least 0.25.
constexpr double kBeside = 0.2;
/// Share of steps at single pixels: for random sides it is larger if either side has a tenth.
constexpr double kSpeckled = 0.3;

double dot(const Rgb<double>& a, const Rgb<double>& b) { return a.r * b.r + a.g * b.g + a.b * b.b; }

/// The pixel at a distance from the dry or the wet end of a step, clamped to the window.
struct Along {
  const EdgeBlur::Step& step;
  const Rect& window;

  template <class At>
  auto dry(int distance, const At& at) const {
    return step.dry_first ? before(distance, at) : after(distance, at);
  }
  template <class At>
  auto wet(int distance, const At& at) const {
    return step.dry_first ? after(distance, at) : before(distance, at);
  }
  bool inside(int distance) const {
    const int at = step.down ? step.y : step.x;
    const int begin = step.down ? window.y0 : window.x0, end = step.down ? window.y1 : window.x1;
    return at - distance >= begin && at + 1 + distance < end;
  }

 private:
  template <class At>
  auto before(int distance, const At& at) const {
    if (step.down) return at(step.x, std::max(step.y - distance, window.y0));
    return at(std::max(step.x - distance, window.x0), step.y);
  }
  template <class At>
  auto after(int distance, const At& at) const {
    if (step.down) return at(step.x, std::min(step.y + 1 + distance, window.y1 - 1));
    return at(std::min(step.x + 1 + distance, window.x1 - 1), step.y);
  }
};

/// Calls found(i) for each i below count where a[i] and b[i] differ.
template <class Found>
void each_difference(const std::uint8_t* a, const std::uint8_t* b, int count, const Found& found) {
  constexpr int kWord = sizeof(std::uint64_t);
  int i = 0;
  for (; i + kWord <= count; i += kWord) {
    std::uint64_t left, right;
    std::memcpy(&left, a + i, kWord);
    std::memcpy(&right, b + i, kWord);
    if (left == right) continue;
    for (int k = i; k < i + kWord; ++k) {
      if (a[k] != b[k]) found(k);
    }
  }
  for (; i < count; ++i) {
    if (a[i] != b[i]) found(i);
  }
}

/// Whether both neighbours of a pixel in a row are of another side.
bool alone(const std::uint8_t* sides, int i, int count) {
  return i > 0 && i + 1 < count && sides[i - 1] != sides[i] && sides[i + 1] != sides[i];
}

}  // namespace

void EdgeBlur::Growth::add(const Growth& other) {
  steps += other.steps;
  speckled += other.speckled;
  grown += other.grown;
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i] += other.own[i];
    next[i] += other.next[i];
    dry[i] += other.dry[i];
    wet[i] += other.wet[i];
  }
  for (std::size_t i = 0; i < after.size(); ++i) after[i] += other.after[i];
}

bool EdgeBlur::Growth::grows_at(int rung) const {
  const auto i = static_cast<std::size_t>(rung);
  return next[i] > kGrows * own[i] || (i < after.size() && after[i] > kGrows * own[i]);
}

bool EdgeBlur::Growth::is_blurred() const {
  const double chance = std::sqrt(steps);
  return grows_at(0) || grown > kMostGrow * steps + chance;
}

bool EdgeBlur::Growth::is_speckled() const { return steps > 0 && speckled >= kSpeckled * steps; }

int EdgeBlur::Growth::full_at() const {
  for (int rung = 0; rung < kWidths; ++rung) {
    const auto i = static_cast<std::size_t>(rung);
    if (!(own[i] > 0)) return 0;  // nothing is seen at that distance
    const bool goes_on = grows_at(rung) && (i == 0 || next[i - 1] > kRamp * own[i - 1]);
    if (goes_on) continue;
    // An object thinner than its blur changes beside the step, too, but the water behind it does
    // not.
    const bool beside = std::min(dry[i], wet[i]) > kBeside * own[i];
    return beside && !is_speckled() ? 0 : rung;
  }
  return 0;
}

EdgeBlur::Growth EdgeBlur::growth_of(const Step& step, int rungs) const {
  const Along along{step, picture_.window};
  const auto color = [&](int x, int y) { return picture_.color_at(x, y); };
  std::array<Rgb<double>, kLadder.size()> dry, wet, across;
  std::size_t known = 0;
  const auto see = [&](std::size_t rung) {
    for (; known <= rung; ++known) {
      dry[known] = along.dry(kLadder[known], color);
      wet[known] = along.wet(kLadder[known], color);
      across[known] = dry[known] - wet[known];
    }
  };
  see(1);
  const double size = dot(dry[1], dry[1]) + dot(wet[1], wet[1]) + 1e-12;
  Growth growth;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rungs); ++i) {
    const bool has_after = i < growth.after.size();
    const std::size_t farthest = i + (has_after ? 2 : 1);
    if (!along.inside(kLadder[farthest])) break;
    see(farthest);
    const Rgb<double> dry_beyond = dry[i + 1] - dry[i], wet_beyond = wet[i + 1] - wet[i];
    growth.own[i] = dot(across[i], across[i]) / size;
    growth.next[i] = dot(across[i], across[i + 1]) / size;
    growth.dry[i] = dot(dry_beyond, dry_beyond) / size;
    growth.wet[i] = dot(wet_beyond, wet_beyond) / size;
    if (has_after) growth.after[i] = dot(across[i], across[i + 2]) / size;
  }
  growth.steps = along.inside(kLadder[2]);  // sees the first distance
  growth.speckled = growth.steps > 0 && step.speckle;
  growth.grown = growth.next[0] > kGrows * growth.own[0];
  return growth;
}

/// A shore is no edge: the ground continues from in front of the water to behind it, and its
/// inverse depth, linear along a plane, changes as it does beside the step.
bool EdgeBlur::occludes(const Step& step) const {
  const Along along{step, picture_.window};
  const auto inverse = [&](int x, int y) { return picture_.inverse_depth(x, y); };
  for (const int from : {0, 3}) {
    const double dry = along.dry(from, inverse), wet = along.wet(from, inverse);
    const double beside = std::min(std::abs(along.dry(from + 1, inverse) - dry),
                                   std::abs(along.wet(from + 1, inverse) - wet));
    if (dry - wet > 0.02 * dry + 4 * (2 * from + 1) * beside) return true;
  }
  return false;
}

void EdgeBlur::find(int y, const std::uint8_t* sides, const std::uint8_t* below,
                    std::vector<Step>& steps) const {
  const Rect& w = picture_.window;
  const auto add = [&](int i, std::uint8_t first, std::uint8_t second, bool down) {
    constexpr auto kDry = static_cast<std::uint8_t>(Side::kDry);
    constexpr auto kWet = static_cast<std::uint8_t>(Side::kWet);
    const bool dry_first = first == kDry && second == kWet;
    if (!dry_first && !(first == kWet && second == kDry)) return;
    const std::uint8_t* row = down ? below : sides;
    const int other = down ? i : i + 1;
    const bool speckle = alone(sides, i, w.width()) || alone(row, other, w.width());
    const Step step{w.x0 + i, y, down, dry_first, speckle};
    if (occludes(step)) steps.push_back(step);
  };
  each_difference(sides, sides + 1, w.width() - 1,
                  [&](int i) { add(i, sides[i], sides[i + 1], false); });
  if (!below) return;
  each_difference(sides, below, w.width(), [&](int i) { add(i, sides[i], below[i], true); });
}

bool EdgeBlur::any(std::vector<std::uint8_t>& sides, std::vector<Step>& steps) const {
  const Rect& w = picture_.window;
  const int apart = std::max(w.height() / 64, 1);
  sides.resize(2 * static_cast<std::size_t>(w.width()));
  std::uint8_t *upper = sides.data(), *lower = upper + w.width();
  Growth all, resolved;
  for (int i = 0; i * apart < w.height(); ++i) {
    // At uneven distances, because a model's edges may be evenly spaced.
    const int y = w.y0 + i * apart + i * 5 % apart;
    if (y >= w.y1) break;
    const bool last = y + 1 == w.y1;
    picture_.sides(y, w.x0, w.x1, upper);
    if (!last) picture_.sides(y + 1, w.x0, w.x1, lower);
    steps.clear();
    find(y, upper, last ? nullptr : lower, steps);
    for (const Step& step : steps) {
      const Growth growth = growth_of(step, 1);
      all.add(growth);
      if (!step.speckle) resolved.add(growth);
    }
  }
  return all.is_blurred() || resolved.is_blurred();
}

}  // namespace limpid
