#pragma once
#include <string>
#include <vector>

#include "plate/layer_candidates.h"

namespace limpid {

/// As views_of() and default_view() for the sources of the groups.
std::vector<std::string> views_of(const std::vector<LayerGroup>& groups);
std::string default_view(const std::vector<LayerGroup>& groups);

/// Whether both are the same view, ignoring letter case.
bool is_same_view(const std::string& a, const std::string& b);

/// The candidates of one view; "": of no view.
std::vector<Candidate> of_view(const std::vector<Candidate>& candidates, const std::string& view);

}  // namespace limpid
