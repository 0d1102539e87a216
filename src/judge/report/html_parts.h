#pragma once
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "judge/report/report.h"

namespace limpid {

/// A cell: text, and the number that it stands for, by which rows are sorted.
struct Cell {
  Cell(std::string words) : text(std::move(words)) {}
  Cell(const char* words) : text(words) {}
  /// To three digits.
  explicit Cell(double number);
  Cell(double number, std::string words) : text(std::move(words)), value(number) {}

  std::string text;
  double value = std::numeric_limits<double>::quiet_NaN();
};

/// A share as "12.5 %", with so many digits after the point.
Cell percent(double share, int digits = 0);

struct Column {
  std::string name, unit;
  bool is_number = true;
  bool wraps = false;  ///< texts may be long
};

/// A table whose rows can be sorted by a click on a column's head.
class HtmlTable {
 public:
  HtmlTable(std::string caption, std::vector<Column> columns);
  /// As many cells as columns. A `marked` row is set off, as those of a Pareto front.
  void add(const std::vector<Cell>& cells, bool marked = false);
  /// Sets the next row off from those above it, until the table is sorted.
  void begin_group() { starts_group_ = true; }
  std::string html() const;

 private:
  std::string caption_;
  std::vector<Column> columns_;
  std::string rows_;
  bool starts_group_ = false;
};

/// <section> with a numbered heading; `id` is what links name.
std::string section(std::string_view id, std::string_view heading, const std::string& content);
/// <p>; `html` may hold markup.
std::string paragraph(const std::string& html);
std::string code(std::string_view text);
/// A plot with its caption, which may hold markup.
std::string plot_figure(const std::string& svg, const std::string& caption);
/// Pictures side by side, as many in a row as there is room for.
std::string gallery(const std::vector<Figure>& figures);
/// What the colors of heat maps mean: a ramp from 10^-decades to 1.
std::string heat_legend(int decades);

}  // namespace limpid
