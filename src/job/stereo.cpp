#include "job/stereo.h"

#include <algorithm>

#include "limpid/core/error.h"

namespace limpid {
namespace {

constexpr std::string_view kOurs = "limpid/";

std::string prefix_of(const std::string& view) { return std::string(kOurs) + "view/" + view + "/"; }

std::string of_view(const std::string& view, const std::string& sentence) {
  return "view " + view + ": " + sentence;
}

bool same_camera(const Camera& a, const Camera& b) {
  return a.view == b.view && a.projection == b.projection;
}

}  // namespace

void expect_views(const CompositeJob& job, const std::vector<PreparedView>& views) {
  if (views.size() < 2) return;
  if (!job.output.deep.empty()) {
    throw Error(job.output.deep.string() + ": a deep file holds one view, and --view names " +
                    std::to_string(views.size()) + ": expected one",
                Fault::kUsage);
  }
  for (auto a = views.begin(); a != views.end(); ++a) {
    for (auto b = a + 1; b != views.end(); ++b) {
      const std::string both = "views " + a->name + " and " + b->name;
      if (a->name == b->name) throw Error(both + ": expected each once", Fault::kUsage);
      if (a->plate.display() != b->plate.display()) {
        throw Error(both + " have different display windows: expected one");
      }
      if (same_camera(*a->scene.camera, *b->scene.camera)) {
        throw Error(
            both +
            " have the same camera: expected worldToCamera and worldToNDC in a part of each, or a "
            "scene for each (--scene shot_%V.toml, where %V is the name of the view)");
      }
    }
  }
}

void add_view(CompositeReport& report, const std::string& view, const CompositeReport& other) {
  report.replaced += other.replaced;
  for (const std::string& warning : other.warnings) {
    const auto& known = report.warnings;
    if (std::find(known.begin(), known.end(), warning) == known.end()) {
      report.warnings.push_back(of_view(view, warning));
    }
  }
  for (const std::string& layer : other.left_out) {
    auto& known = report.left_out;
    if (std::find(known.begin(), known.end(), layer) == known.end()) known.push_back(layer);
  }
}

void add_view(Record& record, const std::string& view, const Record& other) {
  for (const auto& [name, text] : other) {
    record[prefix_of(view) + name.substr(kOurs.size())] = text;
  }
}

Record record_of_view(const Record& record, const std::string& view) {
  const std::string prefix = prefix_of(view);
  Record found;
  for (const auto& [name, text] : record) {
    if (name.starts_with(prefix)) found[std::string(kOurs) + name.substr(prefix.size())] = text;
  }
  return found;
}

}  // namespace limpid
