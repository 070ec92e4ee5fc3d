// Layered procedural clouds, with or without a cover map.
#include "welkin/shared/cloud_layers.glsl.h"
float sourceDensity(uvec3 p, uint level) { return layersDensity(p, level); }
