#include "plan/operator_table.h"

#include "ops/kernels.h"

namespace limpid {
namespace {

/// State derived from the position that an operator finds.
constexpr StateSet kFound{StatePart::kPosition, StatePart::kPath, StatePart::kConfidence,
                          StatePart::kTransmittance};

template <class Op>
constexpr OperatorEntry entry_of() {
  using P = typename Op::Params;
  OperatorEntry e{};
  e.name = Op::kName;
  e.uses = Op::kUses;
  e.makes = Op::kMakes;
  e.reads = [](const Look& look) { return Op::reads(look.of<Op>()); };
  e.needs = [](const Look& look) { return Op::needs(look.of<Op>()); };
  e.reach = [](const Look& look) { return Op::reach(look.of<Op>()); };
  e.neutral = [](const Look& look, StateSet made) { return Op::neutral(look.of<Op>(), made); };
  e.bound = [](const Look& look, const Pass& pass, const Ranges& ranges) {
    return Op::bound(look.of<Op>(), pass, ranges);
  };
  if constexpr (requires { Op::kLooksAbove; }) e.looks_above = Op::kLooksAbove;
  if constexpr (requires { Op::kSkipped; }) e.skipped = Op::kSkipped;
  e.propagate_ranges = [](const Look& look, const Pass& pass, Ranges& ranges) {
    if constexpr (requires(const P& p) { Op::propagate_ranges(p, pass, ranges); }) {
      Op::propagate_ranges(look.of<Op>(), pass, ranges);
    }
  };
  e.displaced = [](const Look& look, const Ranges& ranges) -> double {
    if constexpr (requires(const P& p) { Op::displaced(p, ranges); }) {
      return Op::displaced(look.of<Op>(), ranges);
    }
    return Op::kUses.meets(kFound) ? HUGE_VAL : 0;
  };
  e.hides = requires(const P& p, const Pass& pass, const Ranges& ranges) {
    Op::beyond(p, pass, ranges);
  };
  e.beyond = [](const Look& look, const Pass& pass, const Ranges& ranges) -> double {
    if constexpr (requires(const P& p) { Op::beyond(p, pass, ranges); }) {
      return Op::beyond(look.of<Op>(), pass, ranges);
    }
    return HUGE_VAL;
  };
  e.rejects = requires(const P& p, const InReach& reach) { Op::foreground_free(p, reach); };
  e.foreground_free = [](const Look& look, const InReach& reach) {
    if constexpr (requires(const P& p) { Op::foreground_free(p, reach); }) {
      return Op::foreground_free(look.of<Op>(), reach);
    }
    return true;
  };
  e.stretch = [](const Look& look, const Pass& pass) -> double {
    if constexpr (requires(const P& p) { Op::stretch(p, pass); }) {
      return Op::stretch(look.of<Op>(), pass);
    }
    return 1;
  };
  e.prefer = [](Look& look, const AtHand& has) -> std::string_view {
    if constexpr (requires(P & p) { Op::prefer(p, has); }) return Op::prefer(look.of<Op>(), has);
    return "";
  };
  e.looks_around = [](const Look& look, const AtHand& has) -> std::string_view {
    if constexpr (requires(const P& p) { Op::looks_around(p, has); }) {
      return Op::looks_around(look.of<Op>(), has);
    }
    return "";
  };
  e.warning = [](const Look& look, const AtHand& has) -> std::string_view {
    if constexpr (requires(const P& p) { Op::warning(p, has); }) {
      return Op::warning(look.of<Op>(), has);
    }
    return "";
  };
  e.wants = [](const Look& look, const AtHand& has) -> PlaneSet {
    if constexpr (requires(const P& p) { Op::wants(p, has); }) {
      return Op::wants(look.of<Op>(), has);
    }
    return {};
  };
  e.work_in = []([[maybe_unused]] const Primaries& primaries, [[maybe_unused]] Look& look) {
    if constexpr (requires(P & p) { Op::work_in(primaries, p); }) {
      Op::work_in(primaries, look.of<Op>());
    }
  };
  e.lit_by_sky = [](const Look& look) {
    if constexpr (requires(const P& p) { Op::lit_by_sky(p); }) {
      return Op::lit_by_sky(look.of<Op>());
    }
    return false;
  };
  e.medium = [](const Look& look, const Pass& pass) -> std::optional<WaterMedium> {
    if constexpr (requires(const P& p) { Op::medium(p, pass); }) {
      return Op::medium(look.of<Op>(), pass);
    }
    return {};
  };
  e.swell = [](const Look& look) -> Swell {
    if constexpr (requires(const P& p) { Op::swell(p); }) return Op::swell(look.of<Op>());
    return {};
  };
  e.path_measure = [](const Look& look) -> std::optional<PathMeasure> {
    if constexpr (requires(const P& p) { Op::path_measure(p); })
      return Op::path_measure(look.of<Op>());
    return std::nullopt;
  };
  e.ns = [](const Look& look, const Running& running) -> double {
    if constexpr (requires(const P& p) { Op::ns(p, running); }) {
      return Op::ns(look.of<Op>(), running);
    }
    return 1;
  };
  return e;
}

constexpr std::array<OperatorEntry, Chain::kCount> kTable = [] {
  std::array<OperatorEntry, Chain::kCount> table{};
  Kernels::for_each([&]<class Op, int I>() { table[I] = entry_of<Op>(); });
  return table;
}();

}  // namespace

std::span<const OperatorInfo> operators() {
  static constexpr std::array<OperatorInfo, Chain::kCount> kInfos = [] {
    std::array<OperatorInfo, Chain::kCount> infos{};
    Kernels::for_each([&]<class Op, int I>() {
      infos[I] = {Op::kName, Op::kAbout, Op::kUses, Op::kMakes,
                  [](const Look& look) { return Op::reads(look.of<Op>()); }};
    });
    return infos;
  }();
  return kInfos;
}

const std::array<OperatorEntry, Chain::kCount>& operator_table() { return kTable; }

}  // namespace limpid
