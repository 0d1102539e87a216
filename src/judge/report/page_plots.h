#pragma once
#include <string>
#include <vector>

#include "judge/report/scatter.h"

/// What the sections with plots have in common.

namespace limpid {

inline constexpr const char* kTimeAxis = "time, ns/pixel, one thread";
inline constexpr const char* kBandCaption = " What has no error at all stands in the band 0.";

/// What is told of a point where one points at it.
std::string about(const std::string& what, double ns_per_pixel, double error);
/// Where the word stands in the list, at its end if it is new.
std::size_t index_in(std::vector<std::string>& list, const std::string& word);
/// But for an infinite error (of a NaN in one picture), which the table alone tells.
void add_point(Scatter& scatter, ScatterPoint point);
/// The plot as a figure; "" without points. The caption may hold markup.
std::string drawn(const Scatter& scatter, const std::string& caption);

}  // namespace limpid
