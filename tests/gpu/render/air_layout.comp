// Test: a block with an instance name, so that reflection gives full names.
#include "lib/air.glsl"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 1) in;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirParams params; AirViewFrame view; AirLayer layers[6]; } u_air;
layout(std430, binding = 0) buffer Answers { float answers[]; };

void main() {
  AirBlock air = AirBlock(u_air.params, u_air.view, u_air.layers);
  answers[0] = airExtinction(air, air.view.upX).x;
}
