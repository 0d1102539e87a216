#include "judge/report/html_parts.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "judge/compare/heat_map.h"
#include "judge/report/jpeg.h"
#include "judge/report/markup.h"

namespace limpid {
namespace {

std::string exact_number(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

std::string head_of(const Column& column) {
  std::string html = std::string("<th scope=\"col\"") + (column.is_number ? " class=\"n\"" : "") +
                     "><button type=\"button\">" + escaped(column.name);
  if (!column.unit.empty()) html += " <span class=\"unit\">" + escaped(column.unit) + "</span>";
  return html + "</button></th>";
}

}  // namespace

Cell::Cell(double number) : text(short_number(number)), value(number) {}

Cell percent(double share, int digits) {
  std::array<char, 64> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), 100 * share,
                                 std::chars_format::fixed, digits);
  Cell cell(std::string(text.data(), end.ptr) + " %");
  cell.value = share;
  return cell;
}

HtmlTable::HtmlTable(std::string caption, std::vector<Column> columns)
    : caption_(std::move(caption)), columns_(std::move(columns)) {}

void HtmlTable::add(const std::vector<Cell>& cells, bool marked) {
  const bool parted = std::exchange(starts_group_, false) && !rows_.empty();
  rows_ += marked ? "<tr class=\"marked\">" : parted ? "<tr class=\"first\">" : "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Column& column = columns_[i];
    rows_ += column.is_number ? "<td class=\"n\"" : column.wraps ? "<td class=\"wrap\"" : "<td";
    if (std::isfinite(cells[i].value)) rows_ += " data-v=\"" + exact_number(cells[i].value) + "\"";
    rows_ += ">" + escaped(cells[i].text) + "</td>";
  }
  rows_ += "</tr>\n";
}

std::string HtmlTable::html() const {
  std::string html =
      "<div class=\"scroll\"><table>\n<caption>" + escaped(caption_) + "</caption>\n<thead><tr>";
  for (const Column& column : columns_) html += head_of(column);
  return html + "</tr></thead>\n<tbody>\n" + rows_ + "</tbody></table></div>\n";
}

std::string section(std::string_view id, std::string_view heading, const std::string& content) {
  return "<section id=\"" + std::string(id) + "\">\n<h2>" + escaped(heading) + "</h2>\n" + content +
         "</section>\n";
}

std::string paragraph(const std::string& html) { return "<p>" + html + "</p>\n"; }

std::string code(std::string_view text) { return "<code>" + escaped(text) + "</code>"; }

std::string plot_figure(const std::string& svg, const std::string& caption) {
  return "<figure class=\"chart\"><div class=\"scroll\">" + svg + "</div><figcaption>" + caption +
         "</figcaption></figure>\n";
}

std::string gallery(const std::vector<Figure>& figures) {
  std::string html = "<div class=\"gallery\">\n";
  for (const Figure& figure : figures) {
    html += "<figure><img alt=\"" + escaped(figure.caption) + "\" width=\"" +
            std::to_string(figure.size.width) + "\" height=\"" +
            std::to_string(figure.size.height) + "\" src=\"" + data_uri(figure.jpeg) +
            "\"/><figcaption>" + escaped(figure.caption) + "</figcaption></figure>\n";
  }
  return html + "</div>\n";
}

std::string heat_legend(int decades) {
  constexpr double kLeft = 24, kWidth = 320, kHeight = 12;
  std::string stops;
  for (int i = 0; i <= 8; ++i) {
    const std::array<float, 3> color = heat_color(i / 8.0);
    std::string rgb;
    for (float c : color) rgb += (rgb.empty() ? "" : ",") + coordinate(std::round(255 * c));
    stops += "<stop offset=\"" + coordinate(i / 8.0) + "\" stop-color=\"rgb(" + rgb + ")\"/>";
  }
  std::string marks;
  for (int i = 0; i <= decades; ++i) {
    const double x = kLeft + kWidth * i / decades;
    marks += "<line class=\"frame\" x1=\"" + coordinate(x) + "\" y1=\"12\" x2=\"" + coordinate(x) +
             "\" y2=\"18\"/><text class=\"tick\" x=\"" + coordinate(x) +
             "\" y=\"32\" font-size=\"12\" text-anchor=\"middle\">" + tick_number(1, i - decades) +
             "</text>";
  }
  return "<figure class=\"legend\"><svg role=\"img\" aria-label=\"color scale\" viewBox=\"0 0 " +
         coordinate(2 * kLeft + kWidth) + " 38\" width=\"" + coordinate(2 * kLeft + kWidth) +
         "\" height=\"38\"><defs><linearGradient id=\"heat\">" + stops +
         "</linearGradient></defs><rect x=\"" + coordinate(kLeft) + "\" y=\"0\" width=\"" +
         coordinate(kWidth) + "\" height=\"" + coordinate(kHeight) + "\" fill=\"url(#heat)\"/>" +
         marks +
         "</svg><figcaption>largest |difference| of the three channels, white = 1; beyond the ends "
         "as at the ends, NaN and infinity magenta</figcaption></figure>\n";
}

}  // namespace limpid
