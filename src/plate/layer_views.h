#pragma once
#include <string>
#include <vector>

#include "plate/layer_candidates.h"

namespace limpid {

/// As views_of() and default_view() of the sources that the groups were made from.
std::vector<std::string> views_of(const std::vector<LayerGroup>& groups);
std::string default_view(const std::vector<LayerGroup>& groups);

/// Whether both are the same view: letter case does not count.
bool is_same_view(const std::string& a, const std::string& b);

/// The candidates of one view, "" of none.
std::vector<Candidate> of_view(const std::vector<Candidate>& candidates, const std::string& view);

}  // namespace limpid
