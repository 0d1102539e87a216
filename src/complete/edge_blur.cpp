#include "complete/edge_blur.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace limpid {
namespace {

/// Growth that tells of a blur: the narrowest, of one pixel's own box, has 1.28.
constexpr double kBlurred = 1.12;
/// And of one that goes on: at more than so much the contrast is not full.
constexpr double kGrows = 1.06;

double dot(const Rgb<double>& a, const Rgb<double>& b) { return a.r * b.r + a.g * b.g + a.b * b.b; }

/// The pixel so far from the dry or the wet end of a step, and kept in the window.
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

}  // namespace

void EdgeBlur::Growth::add(const Growth& other) {
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i] += other.own[i];
    next[i] += other.next[i];
    after[i] += other.after[i];
  }
}

int EdgeBlur::Growth::full_at() const {
  for (int i = 0; i < kWidths - 1; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double grown = (i == 0 ? kBlurred : kGrows) * own[at];
    if (next[at] <= grown && after[at] <= grown) return i;
  }
  return kWidths - 1;
}

EdgeBlur::Growth EdgeBlur::growth_of(const Step& step, int widths) const {
  const Along along{step, picture_.window};
  const auto color = [&](int x, int y) { return picture_.color_at(x, y); };
  std::array<Rgb<double>, kLadder.size()> difference;
  double size = 1e-12;
  for (std::size_t i = 0; i < static_cast<std::size_t>(widths) + 2; ++i) {
    const Rgb<double> dry = along.dry(kLadder[i], color), wet = along.wet(kLadder[i], color);
    difference[i] = dry - wet;
    if (i <= 2) size += dot(dry, dry) + dot(wet, wet);
  }
  Growth growth;
  for (std::size_t i = 0; i < static_cast<std::size_t>(widths); ++i) {
    growth.own[i] = dot(difference[i], difference[i]) / size;
    growth.next[i] = dot(difference[i], difference[i + 1]) / size;
    growth.after[i] = dot(difference[i], difference[i + 2]) / size;
  }
  return growth;
}

/// A shore is no edge: there the ground goes on from before the water to behind it, and its inverse
/// depth, linear along a plane, changes as it does beside.
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
    const Step step{w.x0 + i, y, down, dry_first};
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
  Growth growth;
  for (int i = 0; i * apart < w.height(); ++i) {
    // Not at even distances, which edges of a model could have, too.
    const int y = w.y0 + i * apart + i * 5 % apart;
    if (y >= w.y1) break;
    const bool last = y + 1 == w.y1;
    picture_.sides(y, w.x0, w.x1, upper);
    if (!last) picture_.sides(y + 1, w.x0, w.x1, lower);
    steps.clear();
    find(y, upper, last ? nullptr : lower, steps);
    for (const Step& step : steps) growth.add(growth_of(step, 1));
  }
  return growth.next[0] > kBlurred * growth.own[0] || growth.after[0] > kBlurred * growth.own[0];
}

}  // namespace limpid
