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

/// Every other model that each operator of a look has, and what can be left out by a number: all
/// that is a way to compute the same water.
std::vector<Choice> choices_of(const Look& look);

}  // namespace limpid
