#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace limpid {

/// Costs of a choice, the smaller the better.
struct Costs {
  double time = 0, error = 0;
};

/// The choices that no other choice beats: none is as good in both costs and better in one. Equal
/// choices stay together. Indices by rising time, then in the given order. NaN and infinite costs
/// never count.
std::vector<std::size_t> pareto_front(std::span<const Costs> choices);

}  // namespace limpid
