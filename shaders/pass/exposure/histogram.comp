// Counts the pixels of a picture by luminance.
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/exposure.glsl.h"
layout(local_size_x = 16, local_size_y = 16) in;
layout(std430, binding = WK_EXPOSURE_BINDING) buffer ExposureBuffer { ExposureBlock exposure; };
layout(rgba32f, binding = 0) uniform readonly image2D u_radiance;
uniform ivec2 u_size;
uniform float u_unitInverse;  // one over the scene's unit of light

shared uint s_bins[kExposureBins];

void main() {
  s_bins[gl_LocalInvocationIndex] = 0u;
  barrier();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(pixel, u_size))) {
    vec3 light = imageLoad(u_radiance, pixel).rgb;
    precise float y = luminance(light) * u_unitInverse;
    // Black is where nothing shines: space, a night without air. An eye does not adapt to the share of it in the picture.
    if (y > 0.0 && light != kNanPaint) atomicAdd(s_bins[exposureBin(y)], 1u);
  }
  barrier();
  uint count = s_bins[gl_LocalInvocationIndex];
  if (count > 0u) atomicAdd(exposure.bins[gl_LocalInvocationIndex], count);
}
