#pragma once
#include <string_view>

#include "limpid/core/field.h"

#include "files/text/toml.h"

namespace limpid {

/// The node as a value of the field's kind. Throws Error for another type, for a direction or
/// matrix of another shape, and if its numbers are not finite; assign() checks ranges.
Value value_of(const TomlNode& node, const FieldInfo& field);

/// The value of a setting of a command line, `name` = `text`: TOML, but words need no quotes,
/// colors no brackets, and numbers no digit before or after the point. Throws Error of
/// Fault::kUsage as value_of() does.
Value value_of_setting(std::string_view name, std::string_view text, const FieldInfo& field);

/// `text` without the white space around it.
std::string_view trimmed(std::string_view text);

/// Reads the keys of `table` that are fields into `params`; absent keys leave their field
/// unchanged, other keys are ignored. Throws Error with the place in front, as value_of() and
/// assign() do.
template <class P>
void read_fields(const TomlNode& table, std::span<const Field<P>> fields, P& params) {
  for (const Field<P>& field : fields) {
    const TomlNode* node = table.find(field.name);
    if (!node) continue;
    const Value value = value_of(*node, field);
    at_place(node->place, [&] { assign(table.path, field, params, value); });
  }
}

}  // namespace limpid
