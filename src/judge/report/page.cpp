#include "judge/report/page.h"

#include "judge/report/html_parts.h"
#include "judge/report/markup.h"
#include "judge/report/page_sections.h"
#include "judge/report/page_style.h"

namespace limpid {
namespace {

struct Link {
  const char *id, *name;
};
constexpr Link kLinks[] = {
    {"subjects", "Plates and scenes"},
    {"runners", "Runners"},
    {"looks", "Looks"},
    {"truth", "Truth"},
    {"traced", "Traced light"},
    {"brought", "Buffers"},
    {"choices", "Choices"},
    {"budgets", "Error budgets"},
    {"method", "Method"},
    {"machine", "Machine"},
};

std::string navigation(const std::string& body) {
  std::string html = "<nav aria-label=\"sections\">";
  for (const Link& link : kLinks) {
    if (body.find("<section id=\"" + std::string(link.id) + "\"") == std::string::npos) continue;
    html += "<a href=\"#" + std::string(link.id) + "\">" + link.name + "</a>";
  }
  return html + "</nav>\n";
}

}  // namespace

std::string to_html(const Report& report) {
  const std::string body = subjects_section(report) + runners_section(report) +
                           looks_section(report) + truth_section(report) + traced_section(report) +
                           brought_section(report) + choices_section(report) +
                           budgets_section(report) + method_section(report) + facts_section(report);
  return std::string("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n") +
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n" +
         "<title>limpid report</title>\n<style>" + kPageStyle + "</style>\n</head>\n<body>\n" +
         "<header>\n<h1>limpid: speed and error</h1>\n<p class=\"sub\">" + escaped(report.made) +
         ", limpid " + escaped(report.build.version) + ", " + escaped(report.machine.processor) +
         ", " + std::to_string(report.machine.cores) + " cores</p>\n" + summary(report) +
         navigation(body) + "</header>\n<main>\n" + body +
         "</main>\n<footer>Made by limpid report.</footer>\n<script>" + kPageScript +
         "</script>\n</body>\n</html>\n";
}

}  // namespace limpid
