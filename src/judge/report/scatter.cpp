#include "judge/report/scatter.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "limpid/core/error.h"

#include "judge/report/labels.h"
#include "judge/report/log_axis.h"
#include "judge/report/markup.h"
#include "judge/report/pareto.h"

namespace limpid {
namespace {

constexpr double kWidth = 760, kPlotHeight = 360, kBand = 30;
constexpr double kLeft = 78, kRight = 20, kBottom = 54, kLegendLine = 22;
constexpr double kLabelSize = 12, kTickSize = 12, kAxisSize = 13;
constexpr std::size_t kStyles = 7;

void check(const Scatter& scatter) {
  if (scatter.points.empty()) throw Error("a plot of no points: expected at least one");
  for (const ScatterPoint& p : scatter.points) {
    if (p.time > 0 && std::isfinite(p.time) && p.error >= 0 && std::isfinite(p.error) &&
        p.series < scatter.series.size()) {
      continue;
    }
    throw Error("a plotted time of " + std::to_string(p.time) + " and error of " +
                std::to_string(p.error) + ": expected finite numbers, the time above 0");
  }
}

LogAxis axis_over(const std::vector<double>& values) {
  if (values.empty()) return {1e-3, 1};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {*least, *most};
}

LogAxis time_axis(const Scatter& scatter) {
  std::vector<double> values;
  for (const ScatterPoint& p : scatter.points) values.push_back(p.time);
  return axis_over(values);
}

LogAxis error_axis(const Scatter& scatter) {
  std::vector<double> values;
  for (const ScatterPoint& p : scatter.points) {
    if (p.error > 0) values.push_back(p.error);
  }
  return axis_over(values);
}

std::string attribute(std::string_view name, double value) {
  return " " + std::string(name) + "=\"" + coordinate(value) + "\"";
}

std::string line(std::string_view type, double x0, double y0, double x1, double y1) {
  return "<line class=\"" + std::string(type) + "\"" + attribute("x1", x0) + attribute("y1", y0) +
         attribute("x2", x1) + attribute("y2", y1) + "/>\n";
}

std::string text(std::string_view type, double x, double y, double size, std::string_view anchor,
                 std::string_view content, const std::string& more = "") {
  return "<text class=\"" + std::string(type) + "\"" + attribute("x", x) + attribute("y", y) +
         attribute("font-size", size) + " text-anchor=\"" + std::string(anchor) + "\"" + more +
         ">" + escaped(content) + "</text>\n";
}

std::string path(std::string_view type, const std::string& d) {
  return "<path class=\"" + std::string(type) + "\" d=\"" + d + "\"/>\n";
}

std::string at(double x, double y) { return coordinate(x) + " " + coordinate(y); }

std::string style_of(std::size_t series) { return "s" + std::to_string(series % kStyles); }

/// The marker of a series: shapes tell series apart where colors do not.
std::string marker(std::size_t series, bool filled, double x, double y) {
  const double r = filled ? 5.5 : 4.5, d = 1.25 * r;
  const std::string type = "m " + style_of(series) + (filled ? " on" : "");
  const auto closed = [&](std::initializer_list<std::pair<double, double>> corners) {
    std::string way;
    for (const auto& [dx, dy] : corners) way += (way.empty() ? "M" : "L") + at(x + dx, y + dy);
    return path(type, way + "Z");
  };
  switch (series % kStyles) {
    case 0:
      return "<circle class=\"" + type + "\"" + attribute("cx", x) + attribute("cy", y) +
             attribute("r", r) + "/>\n";
    case 1:
      return closed({{-r, -r}, {r, -r}, {r, r}, {-r, r}});
    case 2:
      return closed({{0, -d}, {d, 0}, {0, d}, {-d, 0}});
    case 3:
      return closed({{0, -d}, {d, r}, {-d, r}});
    case 4:
      return closed({{0, d}, {d, -r}, {-d, -r}});
    case 5:
      return closed({{-d, 0}, {-r / 2, -d}, {r / 2, -d}, {d, 0}, {r / 2, d}, {-r / 2, d}});
    default:
      return closed({{-r, -d}, {0, -r / 2}, {r, -d}, {r, d}, {0, r / 2}, {-r, d}});
  }
}

class Drawing {
 public:
  explicit Drawing(const Scatter& scatter)
      : scatter_(scatter), time_(time_axis(scatter)), error_(error_axis(scatter)) {
    for (const ScatterPoint& p : scatter.points) has_zero_ |= p.error == 0;
    const std::string legend = draw_legend();  // says how high it is
    frame_ = {kLeft, legend_height_ + 8, kWidth - kRight, legend_height_ + 8 + kPlotHeight};
    bottom_ = frame_.y1 + (has_zero_ ? kBand : 0);
    svg_ = legend;
  }

  std::string run() {
    draw_grid();
    draw_axes();
    std::vector<std::size_t> front;
    if (scatter_.front) front = front_of_points();
    if (!front.empty()) draw_front(front);
    if (scatter_.connected) draw_connections();
    draw_points(front);
    draw_labels(front);
    const double height = bottom_ + kBottom;
    return "<svg class=\"plot\" role=\"img\" viewBox=\"0 0 " + at(kWidth, height) + "\"" +
           attribute("width", kWidth) + attribute("height", height) + " aria-label=\"" +
           escaped(scatter_.title) + "\">\n<title>" + escaped(scatter_.title) + "</title>\n" +
           svg_ + "</svg>\n";
  }

 private:
  double x_of(double time) const { return std::lerp(frame_.x0, frame_.x1, time_.place(time)); }
  double y_of(double error) const {
    if (error == 0) return frame_.y1 + kBand / 2;
    return std::lerp(frame_.y1, frame_.y0, error_.place(error));
  }

  std::string draw_legend() {
    legend_height_ = 0;
    if (scatter_.series.size() < 2) return "";
    std::string legend;
    double x = kLeft, y = kLegendLine / 2;
    for (std::size_t i = 0; i < scatter_.series.size(); ++i) {
      const double width = 26 + text_width(scatter_.series[i], kLabelSize);
      if (x + width > kWidth && x > kLeft) {
        x = kLeft;
        y += kLegendLine;
      }
      legend += marker(i, true, x + 7, y);
      legend += text("label", x + 18, y + 4, kLabelSize, "start", scatter_.series[i]);
      x += width;
    }
    legend_height_ = y + kLegendLine / 2;
    return legend;
  }

  void draw_grid() {
    for (const Tick& tick : time_.ticks()) {
      const double x = x_of(tick.value);
      svg_ += line(tick.label.empty() ? "grid" : "grid main", x, frame_.y0, x, bottom_);
      if (tick.label.empty()) continue;
      svg_ += text("tick", x, bottom_ + 18, kTickSize, "middle", tick.label);
    }
    for (const Tick& tick : error_.ticks()) {
      const double y = y_of(tick.value);
      svg_ += line(tick.label.empty() ? "grid" : "grid main", frame_.x0, y, frame_.x1, y);
      if (tick.label.empty()) continue;
      svg_ += text("tick", frame_.x0 - 8, y + 4, kTickSize, "end", tick.label);
    }
    if (!has_zero_) return;
    svg_ += line("break", frame_.x0, frame_.y1, frame_.x1, frame_.y1);
    svg_ += text("tick", frame_.x0 - 8, y_of(0) + 4, kTickSize, "end", "0");
  }

  void draw_axes() {
    svg_ += path("frame", "M" + at(frame_.x0, frame_.y0) + "V" + coordinate(bottom_) + "H" +
                              coordinate(frame_.x1));
    svg_ += text("axis", (frame_.x0 + frame_.x1) / 2, bottom_ + 42, kAxisSize, "middle",
                 scatter_.time_axis);
    const double middle = (frame_.y0 + frame_.y1) / 2;
    svg_ += text("axis", 16, middle, kAxisSize, "middle", scatter_.error_axis,
                 " transform=\"rotate(-90 " + at(16, middle) + ")\"");
  }

  std::vector<std::size_t> front_of_points() const {
    std::vector<Costs> costs;
    for (const ScatterPoint& p : scatter_.points) costs.push_back({p.time, p.error});
    return pareto_front(costs);
  }

  void draw_front(const std::vector<std::size_t>& front) {
    double x = x_of(scatter_.points[front.front()].time), y = frame_.y0;
    std::string way = "M" + at(x, y);
    for (std::size_t i : front) {
      const double to_x = x_of(scatter_.points[i].time), to_y = y_of(scatter_.points[i].error);
      way += "H" + coordinate(to_x) + "V" + coordinate(to_y);
      lines_.insert(lines_.end(), {{x, y, to_x, y}, {to_x, y, to_x, to_y}});
      x = to_x;
      y = to_y;
    }
    lines_.push_back({x, y, frame_.x1, y});
    svg_ += path("front", way + "H" + coordinate(frame_.x1));
  }

  void draw_connections() {
    for (std::size_t s = 0; s < scatter_.series.size(); ++s) {
      std::string way;
      for (const ScatterPoint& p : scatter_.points) {
        if (p.series == s) way += (way.empty() ? "M" : "L") + at(x_of(p.time), y_of(p.error));
      }
      if (!way.empty()) svg_ += path("link " + style_of(s), way);
    }
  }

  void draw_points(const std::vector<std::size_t>& front) {
    for (std::size_t i = 0; i < scatter_.points.size(); ++i) {
      const ScatterPoint& p = scatter_.points[i];
      const bool filled =
          !scatter_.front || std::find(front.begin(), front.end(), i) != front.end();
      svg_ += "<g><title>" + escaped(p.about) + "</title>" +
              marker(p.series, filled, x_of(p.time), y_of(p.error)) + "</g>\n";
    }
  }

  /// The front's labels are the most wanted.
  void draw_labels(const std::vector<std::size_t>& front) {
    std::vector<std::size_t> order = front;
    for (std::size_t i = 0; i < scatter_.points.size(); ++i) {
      if (std::find(front.begin(), front.end(), i) == front.end()) order.push_back(i);
    }
    std::vector<LabelWish> wishes;
    for (std::size_t i : order) {
      const ScatterPoint& p = scatter_.points[i];
      wishes.push_back({x_of(p.time), y_of(p.error), text_width(p.label, kLabelSize), 15});
    }
    const auto places =
        place_labels(wishes, {frame_.x0 + 2, frame_.y0, frame_.x1, bottom_ - 1}, lines_);
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (!places[k]) continue;
      const LabelPlace& place = *places[k];
      const LabelWish& wish = wishes[k];
      if (place.led) svg_ += line("lead", wish.x, wish.y, place.lead_x, place.lead_y);
      // Towards the marker, for the true width is smaller than the one reserved.
      const bool left = place.box.x1 <= wish.x + 1, right = place.box.x0 >= wish.x - 1;
      svg_ += text("label",
                   left    ? place.box.x1
                   : right ? place.box.x0
                           : (place.box.x0 + place.box.x1) / 2,
                   place.box.y0 + 11.5, kLabelSize,
                   left    ? "end"
                   : right ? "start"
                           : "middle",
                   scatter_.points[order[k]].label);
    }
  }

  const Scatter& scatter_;
  LogAxis time_, error_;
  bool has_zero_ = false;
  double legend_height_ = 0, bottom_ = 0;
  Box frame_;                   ///< of the axes, without the band for 0
  std::vector<Segment> lines_;  ///< that labels shall not cover
  std::string svg_;
};

}  // namespace

std::string to_svg(const Scatter& scatter) {
  check(scatter);
  return Drawing(scatter).run();
}

}  // namespace limpid
