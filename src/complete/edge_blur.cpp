#include "complete/edge_blur.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace limpid {
namespace {

/// Growth that tells of a blur: the narrowest, of one pixel's own box, has 1.28.
constexpr double kGrows = 1.12;
/// A ramp that is not full at a distance has more than doubled on the way there; what grows slowly
/// is light and texture of the two sides.
constexpr double kRamp = 1.6;

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

}  // namespace

void EdgeBlur::Growth::add(const Growth& other) {
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i] += other.own[i];
    next[i] += other.next[i];
  }
  for (std::size_t i = 0; i < after.size(); ++i) after[i] += other.after[i];
}

bool EdgeBlur::Growth::grows_at(int rung) const {
  const auto i = static_cast<std::size_t>(rung);
  return next[i] > kGrows * own[i] || (i < after.size() && after[i] > kGrows * own[i]);
}

int EdgeBlur::Growth::full_at() const {
  for (int rung = 0; rung < kWidths; ++rung) {
    const auto i = static_cast<std::size_t>(rung);
    if (!(own[i] > 0)) return 0;
    if (!grows_at(rung) || (i > 0 && next[i - 1] < kRamp * own[i - 1])) return rung;
  }
  return 0;
}

EdgeBlur::Growth EdgeBlur::growth_of(const Step& step, int rungs) const {
  const Along along{step, picture_.window};
  const auto color = [&](int x, int y) { return picture_.color_at(x, y); };
  const auto difference = [&](int rung) {
    const int distance = kLadder[static_cast<std::size_t>(rung)];
    return along.dry(distance, color) - along.wet(distance, color);
  };
  const Rgb<double> dry = along.dry(1, color), wet = along.wet(1, color);
  const double size = dot(dry, dry) + dot(wet, wet) + 1e-12;
  Growth growth;
  std::array<Rgb<double>, 3> seen{difference(0), difference(1), difference(2)};
  for (int rung = 0; rung < rungs; ++rung) {
    const auto i = static_cast<std::size_t>(rung);
    const int farthest = std::min(rung < 2 ? rung + 2 : rung + 1, kWidths);
    if (!along.inside(kLadder[static_cast<std::size_t>(farthest)])) break;
    growth.own[i] = dot(seen[0], seen[0]) / size;
    growth.next[i] = dot(seen[0], seen[1]) / size;
    if (i < growth.after.size()) growth.after[i] = dot(seen[0], seen[2]) / size;
    seen = {seen[1], seen[2], rung + 3 <= kWidths ? difference(rung + 3) : seen[2]};
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
  return growth.grows_at(0);
}

}  // namespace limpid
