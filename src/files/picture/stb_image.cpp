// The one place where stb_image is compiled, with as little of it as textures need.
#define STB_IMAGE_IMPLEMENTATION
#include "files/picture/stb_image.h"
