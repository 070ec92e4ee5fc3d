#include "stress_judges.h"

#include <algorithm>
#include <numbers>

#include "welkin/physics/air.h"
#include "welkin/reference/radiance.h"
#include "welkin/shared/cloud_light.glsl.h"
#include "welkin/shared/ground.glsl.h"

namespace welkin::measure {
namespace {

constexpr double kPi = std::numbers::pi;
// Of the sun's irradiance, 1/sr: a hundred thousandth of the day's sky. Light below it is no light to be off from.
constexpr double kNight = 1e-6;

double angleBetween(glm::dvec3 a, glm::dvec3 b) { return 2 * std::asin(std::min(0.5 * glm::length(a - b), 1.0)); }

// Part of the ray in front of the camera that lies inside a sphere; far < near: none. Free of cancellation (shared/camera.glsl.h).
struct Part {
  double near, far;
};
Part inside(const Camera& c, glm::dvec3 dir, double radius) {
  const double b = glm::dot(c.position, dir), q = (c.r - radius) * (c.r + radius), disc = b * b - q;
  if (disc < 0 || (q > 0 && b >= 0)) return {1, 0};
  const double root = std::sqrt(disc);
  if (q > 0) return {q / (root - b), root - b};
  return {0, b < 0 ? root - b : -q / (b + root)};
}

}  // namespace

Camera cameraOf(const View& v, double radius_m, int width, int height) {
  Camera c;
  c.position = v.position_m;
  const double least = radius_m + 0.001, from = glm::length(v.position_m);
  if (from < least) c.position = from > 0 ? v.position_m * (least / from) : glm::dvec3(0, 0, least);
  const double tanY = std::tan(v.fov_deg * kPi / 360);
  c.forward = v.orientation * glm::dvec3(0, 0, -1);
  c.right = v.orientation * glm::dvec3(1, 0, 0) * (tanY * width / height);
  c.up = v.orientation * glm::dvec3(0, 1, 0) * tanY;
  c.r = glm::length(c.position);
  c.pixel_rad = 2 * tanY / height;
  return c;
}
glm::dvec3 direction(const Camera& c, int x, int y, int width, int height) {
  return glm::normalize(c.forward + c.right * ((x + 0.5) / width * 2 - 1) + c.up * (1 - (y + 0.5) / height * 2));
}
double bound(const Scene& scene, const Camera& c, glm::dvec3 dir) {
  if (!scene.sun) return 0;
  const glm::dvec3 sun = scene.sun->direction_planet;
  const double cosSun = glm::dot(dir, sun), angle = angleBetween(dir, sun), pixel_rad = c.pixel_rad;
  double most = 1 + 2 / kPi;
  if (const Part ground = inside(c, dir, scene.planet.radius_m); ground.near <= ground.far) {
    const auto& a = scene.planet.albedo;
    const glm::vec3 normal((c.position + dir * ground.near) / scene.planet.radius_m);
    const float water = shared::waterFraction({float(a[0]), float(a[1]), float(a[2])});
    most += 1.2 * water *
            shared::waterGlint(glm::normalize(normal), glm::vec3(sun), glm::vec3(-dir));  // steep at the horizon: a rounding counts
  }
  const double r = scene.sun->angularRadius_rad, drawn2 = std::max(r * r, pixel_rad * pixel_rad / 3);
  if (r > 0 && angle < r + 2 * pixel_rad) most += 1.36 / (kPi * drawn2);  // limb darkening: 1 / (1 - 0.78 / 3) in the middle
  if (scene.clouds) {
    const auto phases = shared::cloudPhases(float(cosSun));
    // Direct and broadened beam are at most 1 together; of the diffuse part no factor of sunSource is above 1.3 / pi.
    most += 1.01 * std::max(double(phases.single), double(phases.broad)) + 1.3 / kPi;
  }
  if (scene.atmosphere) {
    double air = 0;
    for (const AirLayer& l : scene.atmosphere->layers) {
      const auto phase = shared::phaseValue(shared::uint(l.phase), float(l.g), float(cosSun));
      air = std::max(air, double(phase));
    }
    most += 1.02 * air;  // the phase tables' and half floats' rounding
  }
  return most * *std::max_element(scene.sun->irradiance.begin(), scene.sun->irradiance.end()) + 1e-6;
}

void judgeGround(const Scene& scene, const Camera& c, const ImageF& image, Judged& judged) {
  const glm::dvec3 sun = scene.sun->direction_planet;
  const double albedo = scene.planet.albedo[1], radius = scene.planet.radius_m;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const glm::dvec3 dir = direction(c, x, y, image.width, image.height);
      if (angleBetween(dir, sun) < scene.sun->angularRadius_rad + 2 * c.pixel_rad) continue;
      const double b = glm::dot(c.position, dir), q = (c.r - radius) * (c.r + radius);
      if (std::abs(b * b - q) < 1e-12 * b * b) continue;
      const Part ground = inside(c, dir, radius);
      double light = 0;
      if (ground.near <= ground.far) {
        const glm::dvec3 normal = (c.position + dir * ground.near) / radius;
        light = std::max(glm::dot(normal, sun), 0.0);
      }
      judged.add(std::abs(image.rgba[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4 + 1] * kPi / albedo - light));
    }
  }
}

void judgeSlab(const Scene& scene, const Camera& c, const ImageF& image, Judged& judged) {
  const auto& slab = std::get<SlabSource>(scene.clouds->sources.front());
  const double radius = scene.planet.radius_m;
  double squares = 0, pixels = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const glm::dvec3 dir = direction(c, x, y, image.width, image.height);
      const Part ground = inside(c, dir, radius), outer = inside(c, dir, radius + slab.top_m), inner = inside(c, dir, radius + slab.base_m);
      const double end = ground.near <= ground.far ? ground.near : HUGE_VAL;
      const auto length = [&](const Part& p) { return std::max(std::min(p.far, end) - p.near, 0.0); };
      const double way = (outer.near <= outer.far ? length(outer) : 0) - (inner.near <= inner.far ? length(inner) : 0);
      if (outer.near > outer.far || std::min(outer.far, end) * c.pixel_rad > 0.25 * (slab.top_m - slab.base_m)) continue;
      ++pixels;
      const double difference =
          image.rgba[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4 + 3] + std::expm1(-slab.extinction_per_m * way);
      squares += difference * difference;
    }
  }
  if (pixels > 0) judged.add(std::sqrt(squares / pixels));
}

void judgeAir(const Scene& scene, const Camera& c, const ImageF& image, Judged& judged) {
  const auto medium = reference::makeMedium(scene);
  if (!medium) return judged.add(HUGE_VAL);
  const glm::dvec3 up = c.position / c.r, sun = scene.sun->direction_planet;
  double brightest = kNight, apart = 0;
  for (int i = 0; i < 12; ++i) {
    const int x = int((i % 4 + 0.5) / 4 * image.width), y = int((i / 4 + 0.5) / 3 * image.height);
    const glm::dvec3 dir = direction(c, x, y, image.width, image.height);
    if (angleBetween(dir, sun) < scene.sun->angularRadius_rad + 2 * c.pixel_rad) continue;
    ProbeRay ray;
    ray.altitude_m = c.r - scene.planet.radius_m;
    ray.viewZenith_rad = angleBetween(dir, up), ray.sunZenith_rad = angleBetween(sun, up);
    const glm::dvec3 a = sun - up * glm::dot(sun, up), b = dir - up * glm::dot(dir, up);
    ray.azimuth_rad = glm::length(a) > 1e-12 && glm::length(b) > 1e-12 ? angleBetween(glm::normalize(a), glm::normalize(b)) : 0;
    const double truth = reference::singleOrderRadiance(*medium, ray).radiance[1];
    brightest = std::max(brightest, truth);
    apart = std::max(apart, std::abs(image.rgba[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4 + 1] - truth));
  }
  judged.add(apart / brightest);
}

void judgeMarch(const ImageF& image, const ImageF& fine, Judged& judged) {
  double apart = 0, light = 0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    if (i % 4 == 3) continue;
    apart += std::pow(double(image.rgba[i]) - fine.rgba[i], 2), light += std::pow(double(fine.rgba[i]), 2);
  }
  judged.add(light > 0 ? std::sqrt(apart / light) : apart > 0 ? HUGE_VAL : 0);
}

}  // namespace welkin::measure
