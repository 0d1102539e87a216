#pragma once
#include <pybind11/pybind11.h>

#include "limpid/ops/look.h"

/// Looks, and the tables that declare them, as plain data of Python.

namespace limpid::python {

/// Applies a dict of dicts: {"refraction": {"steps": 2}}. Throws Error, with the look unchanged,
/// for unknown names and for values that their declarations refuse.
void change(Look& look, const pybind11::dict& changes);

/// All parameters, as a dict of dicts.
pybind11::dict dict_of(const Look& look);

/// A dict for each operator in the order of the chain, and the last for `water`.
pybind11::list operators();

}  // namespace limpid::python
