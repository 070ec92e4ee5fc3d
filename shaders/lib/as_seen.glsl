// A texel of the clouds as it will be seen: its brightness, `exposure` over the base exposure, and half of its transmittance.
vec2 asSeen(vec4 texel, float exposure) {
  float bright = 8.0 * exposure * texel.g;
  return vec2(bright / (1.0 + bright), texel.a * 0.5);
}
