#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace limpid {

/// What a choice costs, each the better the smaller.
struct Costs {
  double time = 0, error = 0;
};

/// The choices that no other one beats: none is as good in both costs and better in one. Equal ones
/// stay together. Indices by rising time, then as given. NaN and infinite costs never count.
std::vector<std::size_t> pareto_front(std::span<const Costs> choices);

}  // namespace limpid
