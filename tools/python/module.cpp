#include <limits>

#include <glm/ext/matrix_transform.hpp>
#include <pybind11/pybind11.h>

#include "limpid/core/error.h"
#include "limpid/run/target.h"
#include "limpid/version.h"

#include "frame_after_frame.h"
#include "looks.h"
#include "values.h"

/// The functions for limpid/__init__.py, which has the public names, keywords and docs.

namespace limpid::python {
namespace {

namespace py = pybind11;

py::list roles_list() {
  py::list all;
  for (const Role& role : roles()) {
    py::dict dict;
    dict["name"] = role.name;
    dict["channels"] = role.count;
    dict["missing"] = role.missing;
    dict["about"] = role.about;
    all.append(dict);
  }
  return all;
}

py::list aovs_list() {
  py::list all;
  for (const AovInfo& info : aovs()) {
    py::dict dict;
    dict["name"] = info.name;
    dict["channels"] = info.suffixes;
    dict["dry"] = info.dry;
    dict["about"] = info.about;
    all.append(dict);
  }
  return all;
}

py::array_t<double> perspective_array(double fov_y, double aspect, double near, double far,
                                      const std::string& clip, std::pair<double, double> shift) {
  return array_of(
      perspective(fov_y, aspect, near, far, clip_named(clip), {shift.first, shift.second}));
}

py::array_t<double> orthographic_array(double width, double height, double near, double far,
                                       const std::string& clip) {
  return array_of(orthographic(width, height, near, far, clip_named(clip)));
}

py::array_t<double> look_at_array(const py::object& eye, const py::object& target,
                                  const py::object& up) {
  const glm::dvec3 from = point_of(eye, "eye"), to = point_of(target, "target");
  const glm::dvec3 upwards = point_of(up, "up");
  if (!(glm::length(glm::cross(to - from, upwards)) > 0)) {
    throw Error("look_at: the way from eye to target is zero or parallel to up");
  }
  return array_of(glm::lookAt(from, to, upwards));
}

py::dict full_look(const py::dict& changes) {
  Look look;
  change(look, changes);
  return dict_of(look);
}

std::string look_toml(const py::dict& changes) {
  Look look;
  change(look, changes);
  return to_toml(look);
}

}  // namespace

PYBIND11_MODULE(_limpid, module) {
  module.attr("__version__") = kVersion;
  py::register_exception<Error>(module, "Error", PyExc_ValueError);
  module.def("roles", roles_list);
  module.def("aovs", aovs_list);
  module.def("operators", operators);
  module.def("full_look", full_look);
  module.def("look_toml", look_toml);
  module.def("perspective", perspective_array);
  module.def("orthographic", orthographic_array);
  module.def("look_at", look_at_array);
  using C = FrameAfterFrame;
  py::class_<C>(module, "Compositor")
      .def(py::init<const py::dict&, const py::dict&, int, const std::string&, double,
                    const py::dict&>())
      .def("change_look", &C::change_look)
      .def("look", &C::look)
      .def("set_wave_map", &C::set_wave_map)
      .def("set_environment", &C::set_environment)
      .def("run", &C::run)
      .def("shader", &C::shader)
      .def("plan", &C::plan)
      .def("replaced", &C::replaced)
      .def("device", &C::device);
}

}  // namespace limpid::python
