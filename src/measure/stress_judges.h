#pragma once
// What the pictures of the stability matrix are held to: a bound of every pixel, and truths.
#include <cmath>

#include "welkin/physics/scene.h"
#include "welkin/render/renderer.h"

namespace welkin::measure {

struct Camera {
  glm::dvec3 position, forward, right, up;  // right and up times the tangent of half the field
  double r, pixel_rad;
};
// As the renderer has it: below the ground it stands on it.
Camera cameraOf(const View& v, double radius_m, int width, int height);
glm::dvec3 direction(const Camera& c, int x, int y, int width, int height);

// The most that one pixel may show: the sun's disc if it is near, the sun's irradiance times the sharpest phase function of what is there,
// all of it scattered once; and light without direction: ground, sky, and what is scattered more often, of at most the irradiance.
double bound(const Scene& scene, const Camera& c, glm::dvec3 dir);

struct Judged {
  double worst = 0;
  bool any = false;
  void add(double error) { worst = std::isfinite(error) ? std::max(worst, error) : HUGE_VAL, any = true; }
};

// Lambert's ground in the sun; space is black. Left out: pixels at the limb, where a rounding decides, and at the sun's disc.
void judgeGround(const Scene& scene, const Camera& c, const ImageF& image, Judged& judged);
// Root mean square over the picture, of 1: the shell's faces are a voxel deep, so single pixels at its limb differ. Left out: pixels that
// miss it, or are wider there than a quarter of its height: so are the voxels that they see.
void judgeSlab(const Scene& scene, const Camera& c, const ImageF& image, Judged& judged);
// A dozen pixels spread over the picture, over the brightest of their truths, or kNight.
void judgeAir(const Scene& scene, const Camera& c, const ImageF& image, Judged& judged);
// Root mean square of the difference over that of the light.
void judgeMarch(const ImageF& image, const ImageF& fine, Judged& judged);

}  // namespace welkin::measure
