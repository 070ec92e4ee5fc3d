// The linear picture, exposed and tone-mapped, when the exposure is known only after the picture.
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/exposure.glsl.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = WK_EXPOSURE_BINDING) readonly buffer ExposureBuffer { ExposureBlock exposure; };
layout(rgba32f, binding = 0) uniform readonly image2D u_radiance;
layout(rgba8, binding = 1) uniform writeonly image2D u_display;
uniform ivec2 u_size;
uniform float u_fixedScale;  // over 0: a view's own exposure

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, u_size))) return;
  vec3 light = imageLoad(u_radiance, pixel).rgb;
  float scale = u_fixedScale > 0.0 ? u_fixedScale : exposure.scale;
  vec3 shown = displayValues(TONE_CURVE(toneInput(light, scale)), uint(pixel.x), uint(pixel.y));
  imageStore(u_display, pixel, vec4(light == kNanPaint ? kNanPaint : shown, 1.0));
}
