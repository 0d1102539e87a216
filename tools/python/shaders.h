#pragma once
#include <pybind11/pybind11.h>

#include "limpid/shade/shader_text.h"

namespace limpid::python {

/// {"stage": , "function": , "set": , "first_binding": , "aovs": names}: keywords of
/// limpid.Compositor.shader.
ShaderOptions shader_options_of(const pybind11::dict& keywords);

/// The arguments of limpid.Shader; numbers, textures and outputs are tuples in the order of their
/// fields there.
pybind11::dict dict_of(const ShaderText& shader);

}  // namespace limpid::python
