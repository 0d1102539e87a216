#include "judge/report/page.h"

#include <nlohmann/json.hpp>

#include "judge/report/report_json.h"
#include "show/encoded.h"

namespace limpid {
namespace {

#include "judge/report/pages.inc"  // kReportPage, kHardPage and kShotPage, made by the build of the folder page

/// JSON that cannot end its <script>, and is valid in XML, too.
std::string without_markup(std::string_view json) {
  std::string text;
  for (char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else if (c == '>') {
      text += "\\u003e";
    } else if (c == '&') {
      text += "\\u0026";
    } else {
      text += c;
    }
  }
  return text;
}

void put_in(std::string& page, const std::string& id, std::string_view json) {
  const std::string place = "<script type=\"application/json\" id=\"" + id + "\">";
  page.insert(page.find(place) + place.size(), without_markup(json));
}

std::string pictures(const Report& report) {
  nlohmann::json groups;
  for (const FigureGroup& group : kFigureGroups) {
    nlohmann::json& files = groups[group.name] = nlohmann::json::array();
    for (const Figure& figure : report.*group.figures) files.push_back(base64(figure.jpeg));
  }
  return groups.dump();
}

}  // namespace

std::string to_html(const Report& report) {
  std::string page(kReportPage);
  put_in(page, "pictures", pictures(report));
  put_in(page, "report", to_json(report));
  return page;
}

std::string to_hard_html(std::string_view json) {
  std::string page(kHardPage);
  put_in(page, "report", json);
  return page;
}

std::string to_shot_html(std::string_view json) {
  std::string page(kShotPage);
  put_in(page, "report", json);
  return page;
}

}  // namespace limpid
