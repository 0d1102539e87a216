#pragma once
#include <array>

#include "limpid/ops/look.h"
#include "limpid/plan/plan.h"

#include "op/operator.h"

namespace limpid {

/// The declarations of any operator of the chain (op/operator.h), with the default for each member
/// that it lacks.
struct OperatorEntry {
  std::string_view name;
  StateSet uses, makes;
  bool looks_above;
  bool hides;        ///< it has `beyond`
  bool rejects;      ///< it has `foreground_free`
  CellKind skipped;  ///< named "" if it has none
  PlaneSet (*reads)(const Look&);
  Needs (*needs)(const Look&);
  double (*reach)(const Look&);
  void (*work_in)(const Primaries&, Look&);
  bool (*neutral)(const Look&, StateSet made);
  double (*bound)(const Look&, const Pass&, const Ranges&);
  void (*propagate_ranges)(const Look&, const Pass&, Ranges&);
  double (*displaced)(const Look&, const Ranges&);
  double (*beyond)(const Look&, const Pass&, const Ranges&);
  bool (*foreground_free)(const Look&, const InReach&);
  double (*stretch)(const Look&, const Pass&);
  std::string_view (*prefer)(Look&, const AtHand&);
  std::string_view (*looks_around)(const Look&, const AtHand&);
  std::string_view (*warning)(const Look&, const AtHand&);
  PlaneSet (*wants)(const Look&, const AtHand&);
  bool (*lit_by_sky)(const Look&);
  Swell (*swell)(const Look&);
  std::optional<WaterMedium> (*medium)(const Look&, const Pass&);
  std::optional<PathMeasure> (*path_measure)(const Look&);
  double (*ns)(const Look&, const Running&);
};

/// The chain, in order.
const std::array<OperatorEntry, Chain::kCount>& operator_table();

}  // namespace limpid
