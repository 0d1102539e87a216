// The one place where tinygltf is compiled.
#include <fstream>  // which it uses, but does not include without its own reading of files

#define TINYGLTF_IMPLEMENTATION
#include "load/gltf_parser.h"
