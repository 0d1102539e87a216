#pragma once
#include <string>

#include "files/picture/formats_abi.h"

namespace limpid::formats {

/// The functions of limpid_formats.so.
struct Module {
  decltype(&limpid_formats_read) read;
  decltype(&limpid_formats_write8) write8;
  decltype(&limpid_formats_config) config;
  decltype(&limpid_formats_open_display) open_display;
  decltype(&limpid_formats_display) display;
  decltype(&limpid_formats_close_display) close_display;
};

/// The module, found and loaded at the first call and kept until the program ends. Searched in the
/// folder LIMPID_MODULE_DIR (environment; if set, only there), else in `limpid` beside the program
/// or the library that contains limpid, and in their ../lib/limpid, where `install` puts it. Throws
/// Error, which names `wanted_for`, if it is missing or of another version: "a.tif: NEEDS
/// limpid_formats.so, which is not in ...".
const Module& module(const std::string& wanted_for,
                     const std::string& needs = "formats other than EXR, PNG and JPEG need");

}  // namespace limpid::formats
