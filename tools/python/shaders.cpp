#include "shaders.h"

#include <limits>
#include <string>
#include <vector>

#include <pybind11/numpy.h>

#include "limpid/core/error.h"

#include "values.h"

namespace limpid::python {
namespace {

namespace py = pybind11;

const std::vector<std::string> kStages = {"function", "compute", "fragment"};
const std::vector<std::string> kSources = {"planes", "rows", "made"};

int whole_in(const py::handle& object, const std::string& name) {
  const double number = number_in(object, name);
  const bool fits = number >= std::numeric_limits<int>::min() &&
                    number <= std::numeric_limits<int>::max() && number == static_cast<int>(number);
  if (fits) return static_cast<int>(number);
  throw Error(name + " is " + py::repr(object).cast<std::string>() + ", expected a whole number");
}

py::object optional(const std::string& word) {
  return word.empty() ? py::object(py::none()) : py::str(word);
}

py::tuple number_tuple(const ShaderNumber& number) {
  const py::object range = number.range
                               ? py::object(py::make_tuple(number.range->min, number.range->max))
                               : py::object(py::none());
  return py::make_tuple(number.name, number.offset, number.value, range);
}

/// (rows, columns[, channels]), read-only.
py::object texels_array(const ShaderTexture& texture) {
  if (texture.texels.empty()) return py::none();
  std::vector<py::ssize_t> shape{texture.height, texture.width};
  if (texture.channels > 1) shape.push_back(texture.channels);
  py::array_t<float> copy(shape, texture.texels.data());
  copy.attr("flags").attr("writeable") = false;
  return copy;
}

py::tuple texture_tuple(const ShaderTexture& texture) {
  return py::make_tuple(texture.name, texture.binding,
                        kSources[static_cast<std::size_t>(texture.source)], optional(texture.role),
                        texture.channels, texture.width, texture.height, texels_array(texture));
}

template <class Thing, class Make>
py::list list_of(const std::vector<Thing>& things, Make make) {
  py::list list;
  for (const Thing& thing : things) list.append(make(thing));
  return list;
}

}  // namespace

ShaderOptions shader_options_of(const py::dict& keywords) {
  ShaderOptions options;
  options.stage = static_cast<ShaderOptions::Stage>(
      choice_of(word_of(keywords["stage"], "stage"), "stage", kStages));
  options.function = word_of(keywords["function"], "function");
  options.set = whole_in(keywords["set"], "set");
  options.first_binding = whole_in(keywords["first_binding"], "first_binding");
  for (const py::handle name : keywords["aovs"]) {
    options.aovs.push_back(aov_named(word_of(name, "an AOV")));
  }
  return options;
}

py::dict dict_of(const ShaderText& shader) {
  const ShaderOptions& options = shader.options();
  const Rect& work = shader.work();
  py::dict dict;
  dict["text"] = shader.text();
  dict["id"] = shader.id();
  dict["stage"] = kStages[static_cast<std::size_t>(options.stage)];
  dict["function"] = options.function;
  dict["set"] = options.set;
  dict["block_binding"] = shader.block_binding();
  dict["block"] =
      py::bytes(reinterpret_cast<const char*>(shader.block().data()), shader.block().size());
  dict["numbers"] = list_of(shader.numbers(), number_tuple);
  dict["textures"] = list_of(shader.textures(), texture_tuple);
  dict["outputs"] = list_of(shader.outputs(), [](const ShaderOutput& output) {
    return py::make_tuple(output.name, output.channels, output.binding);
  });
  dict["work"] = py::make_tuple(work.x0, work.y0, work.x1, work.y1);
  return dict;
}

}  // namespace limpid::python
