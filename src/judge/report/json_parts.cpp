#include "judge/report/json_parts.h"

#include <cmath>

#include "show/heat_color.h"

namespace limpid {

Json json_of(const PixelError& e) {
  return {{"mean", e.mean}, {"p99", e.p99}, {"p99_99", e.p99_99}, {"max", e.max}};
}

Json json_of(const ReportMachine& m) {
  return {{"processor", m.processor},
          {"cores", m.cores},
          {"simd", m.simd},
          {"system", m.system},
          {"kernel", m.kernel}};
}

Json json_of(const ReportBuild& b) {
  return {{"limpid", b.version},
          {"compiler", b.compiler},
          {"type", b.type},
          {"libraries", b.libraries}};
}

Json heat_scale() {
  constexpr int kSteps = 8;
  Json colors = Json::array();
  for (int i = 0; i <= kSteps; ++i) {
    Json rgb = Json::array();
    for (const float c : heat_color(i / double{kSteps})) rgb.push_back(std::lround(255 * c));
    colors.push_back(rgb);
  }
  return {{"decades", kHeatDecades}, {"colors", colors}};
}

std::string text_of(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace limpid
