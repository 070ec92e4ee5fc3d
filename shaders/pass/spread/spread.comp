// Between marched pixels, `u_spacing` apart: where four of them look alike, what lies halfway is their mean; else it goes to a list that is marched.
#include "lib/as_seen.glsl"
#include "lib/pixel_list.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f, binding = 0) uniform image2D u_light;
#if OPT_AUX
layout(rg32f, binding = 1) uniform image2D u_aux;
#endif
#if OPT_HISTORY
layout(r8ui, binding = 3) uniform writeonly uimage2D u_age;
#endif
uniform ivec2 u_size;
uniform int u_spacing;
uniform float u_exposure;  // times the base exposure
uniform float u_spread;    // 0 to 1, as seen

struct Marched { vec4 light; vec2 aux; vec2 seen; };

Marched marched(ivec2 at) {
  at = min(at, (u_size - 1) / u_spacing * u_spacing);  // past the border nothing is between: its own neighbour stands in
  vec4 light = imageLoad(u_light, at);
  vec2 aux = vec2(0.0, 1.0);
#if OPT_AUX
  aux = imageLoad(u_aux, at).xy;
#endif
  return Marched(light, aux, asSeen(light, u_exposure));
}

// Halfway. A distance counts as much as there is of what is there.
Marched halfway(Marched a, Marched b) {
  vec2 opacity = vec2(1.0 - a.light.a, 1.0 - b.light.a);
  float all = opacity.x + opacity.y, share = all > 0.0 ? opacity.y / all : 0.5;
  return Marched(0.5 * (a.light + b.light), vec2(mix(a.aux.x, b.aux.x, share), 0.5 * (a.aux.y + b.aux.y)), vec2(0.0));
}

// How unlike four look: in brightness, in transmittance, in the shadow on what lies behind.
float apart(Marched a, Marched b, Marched c, Marched d) {
  vec2 seen = max(max(a.seen, b.seen), max(c.seen, d.seen)) - min(min(a.seen, b.seen), min(c.seen, d.seen));
  float shadow = max(max(a.aux.y, b.aux.y), max(c.aux.y, d.aux.y)) - min(min(a.aux.y, b.aux.y), min(c.aux.y, d.aux.y));
  return max(max(seen.x, seen.y), 0.5 * shadow);
}

void put(ivec2 pixel, Marched value, bool alike) {
  if (any(greaterThanEqual(pixel, u_size))) return;
  if (!alike) {
    listPixel(pixel);
    return;
  }
  imageStore(u_light, pixel, value.light);
#if OPT_AUX
  imageStore(u_aux, pixel, vec4(value.aux, 0.0, 0.0));
#endif
#if OPT_HISTORY
  imageStore(u_age, pixel, uvec4(0u));
#endif
}

void between(ivec2 at) {
  int whole = u_spacing, half_ = u_spacing / 2;
  Marched a = marched(at), b = marched(at + ivec2(whole, 0)), c = marched(at + ivec2(0, whole)), d = marched(at + whole);
  bool right = at.x + whole < u_size.x, below = at.y + whole < u_size.y;
  bool alike = apart(a, b, c, d) <= u_spread;  // a NaN goes on into the means, and composite counts it
  Marched top = halfway(a, b);
  put(at + ivec2(half_, 0), top, alike && right);
  put(at + ivec2(0, half_), halfway(a, c), alike && below);
  put(at + half_, halfway(top, halfway(c, d)), alike && right && below);
}

void main() {
  beginList();
  ivec2 at = (ivec2(gl_WorkGroupID.xy) * 8 + listPlace()) * u_spacing;
  if (all(lessThan(at, u_size))) between(at);
  endList();
}
