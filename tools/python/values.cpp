#include "values.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "limpid/core/error.h"

namespace limpid::python {
namespace {

namespace py = pybind11;

/// Unit; a vector that is unit to rounding stays as it is, and long vectors do not overflow.
glm::dvec3 direction_of(const py::handle& object, const std::string& name) {
  const glm::dvec3 v = point_of(object, name);
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0) || std::isinf(largest)) {
    throw Error(name + " is " + to_string(Rgb<double>{v.x, v.y, v.z}) +
                ", expected a direction: finite, not zero");
  }
  if (std::abs(glm::dot(v, v) - 1) < 1e-14) return v;
  return glm::normalize(v / largest);
}

std::vector<SineWave> waves_of(const py::handle& object) {
  const auto rows = rows_of(object);
  const auto fits = [](const std::vector<double>& row) {
    return row.size() >= SineWave::kLeastColumns && row.size() <= std::size(SineWave::kColumns);
  };
  if (!rows || !std::all_of(rows->begin(), rows->end(), fits)) {
    throw Error("water.waves: expected rows of amplitude, k_x, k_y, phase and, maybe, omega");
  }
  std::vector<SineWave> waves;
  for (const std::vector<double>& row : *rows) waves.push_back(SineWave::from_row(row));
  return waves;
}

/// Calls visit(key, value) for each; `name` must be a dict of these keys.
template <class Visit>
void for_each_of(const py::handle& object, const std::string& name,
                 const std::vector<std::string>& keys, Visit&& visit) {
  if (!py::isinstance<py::dict>(object)) {
    throw Error(name + " is a " + type_name(object) + ", expected a dict with " + join(keys));
  }
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(object)) {
    const std::string word = word_of(key, name + ": a key");
    choice_of(word, name, keys);
    visit(word, value);
  }
}

}  // namespace

std::string type_name(const py::handle& object) {
  return py::str(py::type::of(object).attr("__name__")).cast<std::string>();
}

std::optional<double> number_of(const py::handle& object) {
  const bool has_value = PyFloat_Check(object.ptr()) || PyIndex_Check(object.ptr()) ||
                         (py::hasattr(object, "__float__") && !py::isinstance<py::array>(object));
  if (!has_value || py::isinstance<py::bool_>(object)) return std::nullopt;
  const double number = PyFloat_AsDouble(object.ptr());
  if (!PyErr_Occurred()) return number;
  PyErr_Clear();
  return std::nullopt;
}

double number_in(const py::handle& object, const std::string& name) {
  if (const auto number = number_of(object)) return *number;
  throw Error(name + " is a " + type_name(object) + ", expected a number");
}

bool flag_in(const py::handle& object, const std::string& name) {
  if (py::isinstance<py::bool_>(object)) return object.cast<bool>();
  throw Error(name + " is a " + type_name(object) + ", expected True or False");
}

std::optional<std::vector<double>> numbers_of(const py::handle& object) {
  if (!py::isinstance<py::sequence>(object) || py::isinstance<py::str>(object)) return {};
  std::vector<double> numbers;
  for (const py::handle& item : object) {
    const auto number = number_of(item);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<Rows> rows_of(const py::handle& object) {
  if (!py::isinstance<py::sequence>(object) || py::isinstance<py::str>(object)) return {};
  Rows rows;
  for (const py::handle& item : object) {
    auto row = numbers_of(item);
    if (!row) return std::nullopt;
    rows.push_back(std::move(*row));
  }
  return rows;
}

std::string word_of(const py::handle& object, const std::string& name) {
  if (py::isinstance<py::str>(object)) return object.cast<std::string>();
  throw Error(name + " is a " + type_name(object) + ", expected a str");
}

std::size_t choice_of(const std::string& word, const std::string& name,
                      const std::vector<std::string>& words) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  throw Error(name + ": unknown '" + word + "', expected one of " + join(words) +
              did_you_mean(word, words));
}

ClipSpace clip_named(const std::string& word) {
  return static_cast<ClipSpace>(choice_of(word, "clip", {"gl", "d3d", "reversed"}));
}

glm::dmat4 matrix_of(const py::handle& object, const std::string& name) {
  std::optional<Rows> rows = rows_of(object);
  const auto is_row = [](const std::vector<double>& row) { return row.size() == 4; };
  if (!rows || rows->size() != 4 || !std::all_of(rows->begin(), rows->end(), is_row)) {
    throw Error(name + ": expected a matrix, 4 rows of 4 numbers");
  }
  glm::dmat4 matrix;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) matrix[c][r] = (*rows)[r][c];
  }
  return matrix;
}

py::array_t<double> array_of(const glm::dmat4& matrix) {
  py::array_t<double> array({4, 4});
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) array.mutable_at(r, c) = matrix[c][r];
  }
  return array;
}

glm::dvec3 point_of(const py::handle& object, const std::string& name) {
  const auto numbers = numbers_of(object);
  if (!numbers || numbers->size() != 3) throw Error(name + ": expected three numbers");
  return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

WaterPlane water_of(const py::handle& object) {
  WaterPlane water;
  for_each_of(object, "water", {"up", "height", "waves"},
              [&](const std::string& key, const py::handle& value) {
                if (key == "up") water.up = direction_of(value, "water.up");
                if (key == "height") water.height = number_in(value, "water.height");
                if (key == "waves") water.waves = waves_of(value);
              });
  return water;
}

Rgb<double> color_of(const py::handle& object, const std::string& name) {
  const glm::dvec3 color = point_of(object, name);
  return {color.x, color.y, color.z};
}

Sun sun_of(const py::handle& object) {
  Sun sun;
  for_each_of(object, "sun", {"direction", "color", "diameter"},
              [&](const std::string& key, const py::handle& value) {
                if (key == "direction") sun.direction = direction_of(value, "sun.direction");
                if (key == "color") sun.color = color_of(value, "sun.color");
                if (key == "diameter") sun.diameter = number_in(value, "sun.diameter");
              });
  return sun;
}

SkyLight sky_of(const py::handle& object) { return {color_of(object, "sky_radiance")}; }

Primaries primaries_of(const py::handle& object, const std::string& name) {
  try {
    if (py::isinstance<py::str>(object)) return color_space_named(object.cast<std::string>());
    const auto n = numbers_of(object);
    if (n && n->size() == 8) {
      const Primaries primaries{
          {(*n)[0], (*n)[1]}, {(*n)[2], (*n)[3]}, {(*n)[4], (*n)[5]}, {(*n)[6], (*n)[7]}};
      primaries.validate();
      return primaries;
    }
  } catch (const Error& error) {
    throw Error(name + ": " + error.what());
  }
  throw Error(
      name + " is " + py::repr(object).cast<std::string>() +
      ", expected the name of a space, or eight numbers: x and y of red, green, blue and white");
}

}  // namespace limpid::python
