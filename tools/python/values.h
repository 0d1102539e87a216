#pragma once
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <pybind11/numpy.h>

#include "limpid/core/field.h"
#include "limpid/core/scene.h"

/// Numbers, words, matrices and the parts of a scene, from objects of Python. A function with a
/// parameter `name` throws Error that begins with the name.

namespace limpid::python {

std::string type_name(const pybind11::handle& object);

/// Whatever has a value as a float, but for bool and text.
std::optional<double> number_of(const pybind11::handle& object);
double number_in(const pybind11::handle& object, const std::string& name);
bool flag_in(const pybind11::handle& object, const std::string& name);
std::optional<std::vector<double>> numbers_of(const pybind11::handle& object);
std::optional<Rows> rows_of(const pybind11::handle& object);

std::string word_of(const pybind11::handle& object, const std::string& name);
/// Where in `words` the word is.
std::size_t choice_of(const std::string& word, const std::string& name,
                      const std::vector<std::string>& words);
ClipSpace clip_named(const std::string& word);

/// Rows of an array or of lists are rows of the matrix.
glm::dmat4 matrix_of(const pybind11::handle& object, const std::string& name);
pybind11::array_t<double> array_of(const glm::dmat4& matrix);
glm::dvec3 point_of(const pybind11::handle& object, const std::string& name);

/// {"up": , "height": , "waves": }, as files have them: `up` need not be unit.
WaterPlane water_of(const pybind11::handle& object);
/// {"direction": , "color": , "diameter": }, likewise.
Sun sun_of(const pybind11::handle& object);
/// Three numbers, likewise.
Rgb<double> color_of(const pybind11::handle& object, const std::string& name);
SkyLight sky_of(const pybind11::handle& object);
/// The name of a space, or eight numbers, as text or as a sequence.
Primaries primaries_of(const pybind11::handle& object, const std::string& name);

}  // namespace limpid::python
