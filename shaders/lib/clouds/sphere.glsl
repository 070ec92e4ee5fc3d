// One ball of cloud (tests).
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/cloud_sphere.glsl.h"
layout(std430, binding = WK_SOURCE_PARAMS_BINDING) readonly buffer SourceParams { SphereParams sourceSphere; };
float sourceDensity(uvec3 p, uint level) { return sphereDensity(sourceSphere, p, level); }
