// The one place that compiles tinygltf itself.
#include <fstream>  // used by tinygltf also where it is told that there are no files

#define TINYGLTF_IMPLEMENTATION
#include "tiny_gltf_config.h"
