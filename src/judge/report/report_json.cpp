#include "judge/report/report_json.h"

#include <cmath>

#include "judge/report/json_parts.h"
#include "judge/report/pareto.h"

namespace limpid {
namespace {

constexpr int kSchemaVersion = 2;

Json json_of(const ReportSubject& s) {
  return {{"name", s.name},        {"kind", s.kind},          {"file", s.file},
          {"width", s.size.width}, {"height", s.size.height}, {"wet_share", s.wet_share}};
}

Json json_of(const RunnerRow& row) {
  return {{"subject", row.subject},
          {"look", row.look},
          {"runner", row.runner},
          {"simd", row.simd.empty() ? Json() : Json(row.simd)},
          {"threads", row.threads},
          {"rounds", row.rounds},
          {"ns_per_pixel", row.ns_per_pixel},
          {"error", json_of(row.error)}};
}

Json json_of(const LookRow& row) {
  return {{"subject", row.subject},
          {"look", row.look},
          {"ns_per_pixel", row.ns_per_pixel},
          {"error", json_of(row.error)},
          {"differs", row.differs}};
}

Json json_of(const TruthRow& row) {
  return {{"choice", row.choice},
          {"ns_per_pixel", row.ns_per_pixel > 0 ? Json(row.ns_per_pixel) : Json()},
          {"relative_error_wet", row.wet},
          {"relative_error_in_frame", row.in_frame}};
}

Json json_of(const ModelRow& row) {
  return {{"subject", row.subject},
          {"look", row.look},
          {"parameter", row.parameter.empty() ? Json() : Json(row.parameter)},
          {"value", row.parameter.empty() ? Json() : Json(row.value)},
          {"ns_per_pixel", row.ns_per_pixel},
          {"error", json_of(row.error)},
          {"rmse", row.rmse},
          {"rel_mse", row.rel_mse},
          {"ssim", row.ssim},
          {"flip", row.flip},
          {"hdr_flip", row.hdr_flip},
          {"flicker", row.flicker},
          {"offset_pixels", {{"median", row.offset_median}, {"p95", row.offset_p95}}},
          {"wrongly_rejected", row.wrongly_rejected},
          {"wrongly_accepted", row.wrongly_accepted}};
}

Json json_of(const BroughtSubject& s) {
  return {{"subject", s.subject},
          {"wave_length", s.wave_length},
          {"wet_share", s.wet_share},
          {"near_share_of_wet", s.near_share}};
}

Json json_of(const BroughtRow& row) {
  return {{"subject", row.subject},        {"look", row.look},
          {"brought", row.brought},        {"ns_per_pixel", row.ns_per_pixel},
          {"relative_error_wet", row.wet}, {"relative_error_near", row.near},
          {"relative_error_far", row.far}, {"flip_wet", row.flip}};
}

Json json_of(const ChoiceRow& row) {
  return {{"parameter", row.parameter.empty() ? Json() : Json(row.parameter)},
          {"value", row.parameter.empty() ? Json() : Json(row.value)},
          {"ns_per_pixel", row.ns_per_pixel},
          {"error", json_of(row.error)}};
}

Json json_of(const BudgetRow& row) {
  return {{"subject", row.subject},      {"water", row.water},
          {"max_error", row.max_error},  {"ns_per_pixel", row.ns_per_pixel},
          {"error", json_of(row.error)}, {"bound", row.bound},
          {"dry_share", row.dry_share},  {"opaque_share", row.opaque_share},
          {"full_share", row.full_share}};
}

Json json_of(const Figure& f) {
  return {
      {"name", f.name}, {"caption", f.caption}, {"width", f.size.width}, {"height", f.size.height}};
}

template <class Row>
Json rows(const std::vector<Row>& list) {
  Json array = Json::array();
  for (const Row& row : list) array.push_back(json_of(row));
  return array;
}

/// Sets in each row under this key whether it is on the Pareto front; rows without a time are not.
template <class Row>
void mark_front(Json& array, const char* key, const std::vector<Row>& list,
                double (*error)(const Row&)) {
  std::vector<Costs> costs;
  for (const Row& row : list) {
    costs.push_back({row.ns_per_pixel > 0 ? row.ns_per_pixel : HUGE_VAL, error(row)});
  }
  for (Json& row : array) row[key] = false;
  for (const std::size_t i : pareto_front(costs)) array[i][key] = true;
}

Json truth_rows(const std::vector<TruthRow>& list) {
  Json array = rows(list);
  mark_front<TruthRow>(array, "on_front_wet", list, [](const TruthRow& row) { return row.wet; });
  mark_front<TruthRow>(array, "on_front_in_frame", list,
                       [](const TruthRow& row) { return row.in_frame; });
  return array;
}

Json choice_rows(const std::vector<ChoiceRow>& list) {
  Json array = rows(list);
  mark_front<ChoiceRow>(array, "on_front", list,
                        [](const ChoiceRow& row) { return row.error.mean; });
  return array;
}

Json figures(const Report& report) {
  Json groups;
  for (const FigureGroup& group : kFigureGroups) groups[group.name] = rows(report.*group.figures);
  return groups;
}

}  // namespace

std::string to_json(const Report& report) {
  const Json json{{"schema", "limpid-report"},
                  {"schema_version", kSchemaVersion},
                  {"made", report.made},
                  {"machine", json_of(report.machine)},
                  {"build", json_of(report.build)},
                  {"settings",
                   {{"width", report.size.width},
                    {"height", report.size.height},
                    {"rounds", report.rounds},
                    {"threads", report.threads}}},
                  {"simd", report.simd},
                  {"looks", report.looks},
                  {"subjects", rows(report.subjects)},
                  {"looks_by_runner", rows(report.runners)},
                  {"looks_beside_physical", rows(report.look_rows)},
                  {"refraction_beside_truth",
                   {{"width", report.truth_size.width},
                    {"height", report.truth_size.height},
                    {"in_frame_share", report.truth_in_frame_share},
                    {"rows", truth_rows(report.truth)}}},
                  {"models_beside_traced_light", rows(report.models)},
                  {"looks_by_what_is_brought",
                   {{"samples_a_pixel", kBroughtSamples * kBroughtSamples},
                    {"subjects", rows(report.brought_subjects)},
                    {"rows", rows(report.brought)}}},
                  {"choices_of_physical",
                   {{"subject", report.choices_subject}, {"rows", choice_rows(report.choices)}}},
                  {"error_budgets", rows(report.budgets)},
                  {"figures", figures(report)},
                  {"heat_scale", heat_scale()}};
  return text_of(json);
}

}  // namespace limpid
