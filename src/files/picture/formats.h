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

/// The module, found and loaded at the first call and kept until the program ends. Looked for in
/// the folder LIMPID_MODULE_DIR (environment; when set, only there), else beside the program or the
/// library that limpid is part of, in a folder `limpid` there, and in their ../lib/limpid, where
/// `install` puts it. Throws Error, which says what `wanted_for` asked for, when it is not there or
/// is of another version: "a.tif: NEEDS limpid_formats.so, which is not in ...".
const Module& module(const std::string& wanted_for,
                     const std::string& needs = "formats other than EXR, PNG and JPEG need");

}  // namespace limpid::formats
