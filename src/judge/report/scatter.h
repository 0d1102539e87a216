#pragma once
#include <string>
#include <vector>

namespace limpid {

/// One measured choice: its time, and its error, both better the smaller.
struct ScatterPoint {
  double time = 0;   ///< above 0
  double error = 0;  ///< 0 or above; 0 is drawn in a band of its own under the axis
  std::size_t series = 0;
  std::string label;  ///< beside the point; "" for none
  std::string about;  ///< shown when one points there
};

/// A picture of time (across) against error (up), both axes logarithmic.
struct Scatter {
  std::string title;  ///< for those who cannot see it
  std::string time_axis, error_axis;
  /// A color and a marker each, the eighth as the first; told in a legend where there are several.
  std::vector<std::string> series;
  std::vector<ScatterPoint> points;
  bool front = true;       ///< the Pareto front as a stepped line, its points filled
  bool connected = false;  ///< a line through the points of each series, in their order
};

/// An <svg> element, which takes its colors from the style of the page (page_style.h). Throws Error
/// for no points, and for costs that are not as said above.
std::string to_svg(const Scatter& scatter);

}  // namespace limpid
