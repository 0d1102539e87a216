#include "plan/cell_rules.h"

#include <algorithm>
#include <numeric>

#include "plan/predict.h"

namespace limpid {
namespace {

constexpr StateSet kLight = kOutputTerms | StateSet{StatePart::kSunScatter};
/// Where refraction looked, and what comes of that.
constexpr StateSet kFound{StatePart::kPosition, StatePart::kPath, StatePart::kConfidence,
                          StatePart::kTransmittance};

template <class Wanted>
constexpr int index_in_chain() {
  int found = -1;
  Chain::for_each([&]<class Op, int I>() {
    if constexpr (std::is_same_v<Op, Wanted>) found = I;
  });
  return found;
}
constexpr int kRefraction = index_in_chain<Refraction>(), kFog = index_in_chain<DepthFog>(),
              kShadow = index_in_chain<WaterShadow>(),
              kMirror = index_in_chain<FresnelReflection>();

struct Links {
  StateSet uses, makes;
};
constexpr std::array<Links, Chain::kCount> kLinks = [] {
  std::array<Links, Chain::kCount> links;
  Chain::for_each([&]<class Op, int I>() { links[I] = {Op::kUses, Op::kMakes}; });
  return links;
}();

/// What is another when an operator is left out: what it makes and what later ones make of that.
/// Light makes nothing but light.
StateSet changed_by(const Plan& plan, int index) {
  StateSet changed = kLinks[static_cast<std::size_t>(index)].makes;
  for (int i = index + 1; i < Chain::kCount; ++i) {
    const Links& later = kLinks[static_cast<std::size_t>(i)];
    if (!plan.keeps(i)) continue;
    if ((changed - kLight).meets(later.uses)) {
      changed = changed | later.makes;
    } else if (changed.meets(later.uses)) {
      changed = changed | (later.makes & kLight);
    }
  }
  return changed;
}

constexpr bool has(std::uint16_t mask, int index) { return ((mask >> index) & 1u) != 0; }
constexpr std::uint16_t bit(int index) { return static_cast<std::uint16_t>(1u << index); }

}  // namespace

CellRules::CellRules(const Plan& plan, const Pass& pass) : plan_(plan), pass_(pass) {
  std::array<double, Chain::kCount> cost;
  bool known = true;  // all that reads what refraction found is known to beyond() and displaced()
  for (int i = 0; i < Chain::kCount; ++i) {
    cost[static_cast<std::size_t>(i)] = predicted_ns(plan, i);
    if (!plan.keeps(i)) continue;
    const Links& links = kLinks[static_cast<std::size_t>(i)];
    kept_ = kept_ | bit(i);
    if (kOutputTerms.covers(links.makes)) exact_ = exact_ | bit(i);
    if (!(changed_by(plan, i) - kOutputTerms).meets(plan.outputs)) loose_ = loose_ | bit(i);
    const bool ours = i == kRefraction || i == kFog || i == kShadow || i == kMirror;
    known = known && (ours || !links.uses.meets(kFound));
  }
  if (!known) loose_ = loose_ & static_cast<Mask>(~bit(kRefraction));
  may_hide_ = has(kept_, kFog) && has(loose_, kRefraction);
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](int a, int b) {
    const double of_a = cost[static_cast<std::size_t>(a)], of_b = cost[static_cast<std::size_t>(b)];
    return of_a > of_b || (of_a == of_b && a < b);
  });
}

Ranges CellRules::reckoned(const Ranges& planes, bool endless) const {
  Ranges ranges = planes;
  ranges.hit = ranges.own;
  ranges.path = {0, 0};
  ranges.light = ranges.brightest();
  Chain::for_each([&]<class Op, int I>() {
    if constexpr (requires { Op::reckon(plan_.look.of<Op>(), pass_, ranges); }) {
      if (!has(kept_, I)) return;
      if (I == kFog && endless) ranges.hit = ranges.path = {HUGE_VAL, HUGE_VAL};
      Op::reckon(plan_.look.of<Op>(), pass_, ranges);
    }
  });
  return ranges;
}

double CellRules::displaced(Mask skips, const Ranges& ranges) const {
  if (!has(kept_, kShadow) || has(skips, kShadow)) return 0;
  return WaterShadow::displaced(plan_.look.of<WaterShadow>(), ranges);
}

double CellRules::bound_of(int index, Mask skips, const Ranges& ranges) const {
  double bound = 0;
  Chain::for_each([&]<class Op, int I>() {
    if (I == index) bound = Op::bound(plan_.look.of<Op>(), pass_, ranges);
  });
  return index == kRefraction ? bound + displaced(skips, ranges) : bound;
}

/// Backwards from what is written, as the rule drop_unread does for a whole plan.
CellRules::Mask CellRules::with_unread(Mask skips) const {
  StateSet live = kOutputTerms | plan_.outputs;
  for (int i = Chain::kCount - 1; i >= 0; --i) {
    if (!has(kept_, i) || has(skips, i)) continue;
    const Links& links = kLinks[static_cast<std::size_t>(i)];
    if (links.makes.meets(live)) {
      live = live | links.uses;
    } else {
      skips = skips | bit(i);
    }
  }
  return skips;
}

CellNeeds CellRules::dry() const {
  CellNeeds needs;
  needs.dry = true;
  needs.skips = kept_;
  return needs;
}

CellNeeds CellRules::decide(const Ranges& planes, bool no_foreground, Weighed& weighed) const {
  CellNeeds needs;
  needs.open = no_foreground;
  Ranges ranges = reckoned(planes, false);
  Mask skips = 0;
  double spent = 0;
  // Compared with a little less than the budget, for sums round.
  const auto affords = [&](int index, double bound) {
    if (!(spent + bound <= plan_.max_error * (1 - 1e-6))) return false;
    float& most = weighed.bounds[static_cast<std::size_t>(index)];
    most = std::max(most, static_cast<float>(bound));
    weighed.operators = weighed.operators | bit(index);
    spent += bound;
    return true;
  };
  if (may_hide_) {
    const double bound =
        DepthFog::beyond(plan_.look.of<DepthFog>(), pass_, ranges) + displaced(skips, ranges);
    if (affords(kRefraction, bound)) {
      needs.opaque = true;
      needs.open = false;
      skips = skips | bit(kRefraction);
      ranges = reckoned(planes, true);
    }
  }
  for (int i : order_) {
    if (!has(exact_ | loose_, i) || has(skips, i)) continue;
    const double bound = bound_of(i, skips, ranges);
    if ((bound > 0 && !has(loose_, i)) || !affords(i, bound)) continue;
    skips = skips | bit(i);
    if (i == kFog) ranges.through = 1;
  }
  needs.skips = with_unread(skips);
  if (has(needs.skips, kRefraction)) needs.open = false;
  needs.bound = static_cast<float>(spent * (1 + 1e-6));
  return needs;
}

}  // namespace limpid
