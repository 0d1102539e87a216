#include "limpid/files/text/scene_keys.h"

#include <cmath>

#include "limpid/core/frame.h"

#include "files/text/scene_tables.h"

namespace limpid {
namespace {

/// Matrices and files have no default, nor have numbers with NaN as default.
std::string unset_text(const FieldInfo& field, const Value& value, bool required) {
  if (required) return "required";
  const double* number = std::get_if<double>(&value);
  const bool nothing = field.kind == FieldKind::kFile || field.kind == FieldKind::kMatrix ||
                       (number && std::isnan(*number));
  return nothing ? "" : to_string(value);
}

template <class P>
SceneTable listed(const FieldTable<P>& table) {
  SceneTable list{table.name, table.about, {}};
  for (const Field<P>& field : table.fields) {
    list.keys.push_back({field, unset_text(field, field.get(P{}), field.name == table.required)});
  }
  return list;
}

/// The roles of frames are keys, too.
SceneTable listed_plates() {
  SceneTable plates = listed(kPlatesTable);
  for (const Role& role : roles()) plates.keys.push_back({role_field(role), ""});
  return plates;
}

}  // namespace

std::vector<SceneTable> scene_tables() {
  return {listed(kGeometryTable), listed_plates(),   listed(kCameraTable), listed(kWaterTable),
          listed(kSunTable),      listed(kSkyTable), listed(kSceneTable)};
}

}  // namespace limpid
