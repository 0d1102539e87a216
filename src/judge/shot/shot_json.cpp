#include "judge/shot/shot_json.h"

#include <cmath>

#include "judge/report/json_parts.h"

namespace limpid {
namespace {

constexpr int kSchemaVersion = 1;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }

Json json_of(const ShotError& e) {
  return {{"error", json_of(e.pixels)},
          {"rmse", number(e.rmse)},
          {"relative_error_wet", number(e.relative_wet)},
          {"ssim", number(e.ssim)},
          {"flip", number(e.flip)}};
}

Json json_of(const std::optional<ShotError>& e) { return e ? json_of(*e) : Json(); }

Json json_of(const ShotLook& row) {
  return {{"look", row.name},
          {"picture", row.picture},
          {"milliseconds", number(row.milliseconds)},
          {"beside_shot", json_of(row.error)},
          {"beside_truth", json_of(row.truth)},
          {"differs", row.differs}};
}

Json json_of(const ShotOperator& row) {
  Json json{{"operator", row.name}, {"planned", row.planned}, {"runs", row.runs}};
  if (!row.runs) return json;
  json.update({{"milliseconds", number(row.milliseconds)},
               {"milliseconds_without", number(row.without_milliseconds)},
               {"falls_with_it", row.falls},
               {"picture", row.picture},
               {"difference", row.difference},
               {"without_beside_shot", json_of(row.error)},
               {"without_beside_truth", json_of(row.truth)}});
  return json;
}

Json json_of(const ShotPicture& p) {
  return {{"file", p.file},
          {"name", p.name},
          {"about", p.about},
          {"group", p.group},
          {"scale", p.scale ? Json(*p.scale) : Json()}};
}

Json json_of(const OffFrameLookups& b) {
  return {
      {"share_of_wet", b.share},
      {"overscan", {{"left", b.left}, {"right", b.right}, {"top", b.top}, {"bottom", b.bottom}}},
      {"advice", to_text(b)}};
}

Json word(const std::string& text) { return text.empty() ? Json() : Json(text); }

template <class Row>
Json rows(const std::vector<Row>& list) {
  Json array = Json::array();
  for (const Row& row : list) array.push_back(json_of(row));
  return array;
}

}  // namespace

std::string to_json(const Shot& shot) {
  const Json fast = shot.fast_error ? Json{{"time_share", number(shot.fast_time_share)},
                                           {"beside_physical", json_of(*shot.fast_error)}}
                                    : Json();
  return text_of(Json{{"schema", "limpid-shot"},
                      {"schema_version", kSchemaVersion},
                      {"made", shot.made},
                      {"machine", json_of(shot.machine)},
                      {"build", json_of(shot.build)},
                      {"plate", shot.files},
                      {"scene", word(shot.scene)},
                      {"truth", word(shot.truth)},
                      {"look", shot.look},
                      {"width", shot.size.width},
                      {"height", shot.size.height},
                      {"time_s", shot.time},
                      {"settings",
                       {{"rounds", shot.rounds},
                        {"threads", shot.threads},
                        {"samples", shot.samples},
                        {"simd", shot.simd}}},
                      {"wet_share", shot.wet_share},
                      {"confidence",
                       {{"mean_of_wet", number(shot.confidence_mean)},
                        {"guessed_share_of_wet", number(shot.guessed_share)}}},
                      {"off_frame", json_of(shot.off_frame)},
                      {"warnings", shot.warnings},
                      {"dry", json_of(shot.dry)},
                      {"looks", rows(shot.looks)},
                      {"fast", fast},
                      {"chain_milliseconds", number(shot.chain_milliseconds)},
                      {"rest_milliseconds", number(shot.rest_milliseconds)},
                      {"operators", rows(shot.operators)},
                      {"pictures", rows(shot.pictures)},
                      {"heat_scale", heat_scale()}});
}

}  // namespace limpid
