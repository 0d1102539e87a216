#include "looks.h"

#include <optional>
#include <string>
#include <vector>

#include "limpid/core/error.h"
#include "limpid/plan/plan.h"

#include "values.h"

namespace limpid::python {
namespace {

namespace py = pybind11;

/// A number, a word, three numbers or rows of numbers. The parameter's declaration checks the kind
/// when it is set.
std::optional<Value> value_of(const py::handle& object) {
  if (const auto number = number_of(object)) return *number;
  if (py::isinstance<py::str>(object)) return object.cast<std::string>();
  if (const auto numbers = numbers_of(object); numbers && numbers->size() == 3) {
    return Rgb<double>{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  }
  if (const auto rows = rows_of(object)) return *rows;
  return std::nullopt;
}

py::object object_of(const Value& value) {
  if (const double* x = std::get_if<double>(&value)) return py::float_(*x);
  if (const std::string* word = std::get_if<std::string>(&value)) return py::str(*word);
  if (const Rgb<double>* c = std::get_if<Rgb<double>>(&value)) {
    return py::make_tuple(c->r, c->g, c->b);
  }
  const Rows& rows = std::get<Rows>(value);
  py::tuple table(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    py::tuple row(rows[i].size());
    for (std::size_t k = 0; k < rows[i].size(); ++k) row[k] = rows[i][k];
    table[i] = row;
  }
  return table;
}

const char* kind_name(FieldKind kind) {
  switch (kind) {
    case FieldKind::kReal:
      return "real";
    case FieldKind::kChoice:
      return "choice";
    case FieldKind::kColor:
      return "color";
    case FieldKind::kText:
      return "text";
    case FieldKind::kCountOrWord:
      return "count or word";
    case FieldKind::kTable:
      return "table";
    case FieldKind::kDirection:
      return "direction";
    case FieldKind::kMatrix:
      return "matrix";
    case FieldKind::kFile:
      return "file";
  }
  return "";
}

std::vector<std::string> table_names() {
  std::vector<std::string> names;
  for (const Parameter& p : parameters(Look{})) {
    if (names.empty() || names.back() != p.table) names.emplace_back(p.table);
  }
  return names;
}

py::tuple words(std::span<const std::string_view> list) {
  py::tuple result(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) result[i] = py::str(std::string(list[i]));
  return result;
}

py::dict dict_of(const Parameter& p) {
  const bool numbers = p.kind != FieldKind::kChoice && p.kind != FieldKind::kText;
  py::dict dict;
  dict["name"] = p.name;
  dict["kind"] = kind_name(p.kind);
  dict["unit"] = p.unit;
  dict["range"] = numbers ? py::object(py::make_tuple(p.range.min, p.range.max)) : py::none();
  dict["choices"] = words(p.choices);
  dict["columns"] = words(p.columns);
  dict["default"] = object_of(p.value);
  dict["about"] = p.about;
  return dict;
}

py::dict table_of(std::string_view name, std::string_view about, PlaneSet reads) {
  py::list parameters_of_it, roles_read;
  for (const Parameter& p : parameters(Look{})) {
    if (p.table == name) parameters_of_it.append(dict_of(p));
  }
  for (const Role& role : roles()) {
    if (reads.meets(role.planes())) roles_read.append(role.name);
  }
  py::dict dict;
  dict["name"] = name;
  dict["about"] = about;
  dict["reads"] = roles_read;
  dict["parameters"] = parameters_of_it;
  return dict;
}

}  // namespace

void change(Look& look, const py::dict& changes) {
  Look changed = look;
  const std::vector<std::string> tables = table_names();
  for (const auto& [table, keys] : changes) {
    const std::string name = word_of(table, "look: a table");
    choice_of(name, "look", tables);
    if (!py::isinstance<py::dict>(keys)) {
      throw Error("look: " + name + " is a " + type_name(keys) +
                  ", expected a dict of its parameters");
    }
    for (const auto& [key, object] : py::reinterpret_borrow<py::dict>(keys)) {
      const std::string key_name = word_of(key, "look: a parameter of " + name);
      const std::optional<Value> value = value_of(object);
      if (!value) {
        throw Error(name + "." + key_name + " is a " + type_name(object) +
                    ", expected a number, a str, three numbers, or rows of numbers");
      }
      changed.set(name, key_name, *value);
    }
  }
  look = changed;
}

py::dict dict_of(const Look& look) {
  py::dict tables;
  for (const Parameter& p : parameters(look)) {
    const py::str table{std::string(p.table)};
    if (!tables.contains(table)) tables[table] = py::dict();
    tables[table][py::str(std::string(p.name))] = object_of(p.value);
  }
  return tables;
}

py::list operators() {
  const Look look;
  py::list all;
  for (const OperatorInfo& op : limpid::operators()) {
    all.append(table_of(op.name, op.about, op.reads(look)));
  }
  all.append(table_of(Water::kName, Water::kAbout, {}));
  return all;
}

}  // namespace limpid::python
