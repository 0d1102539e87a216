#pragma once
#include <string>
#include <vector>

#include "limpid/ops/look.h"

namespace limpid {

/// A look with one parameter changed.
struct Choice {
  std::string parameter, value;  ///< "refraction.steps", "2"
  Look look;
};

/// All alternatives for computing the same water: every other model of each operator of a look, and
/// effects turned off by a number.
std::vector<Choice> choices_of(const Look& look);

}  // namespace limpid
