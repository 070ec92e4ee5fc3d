#pragma once
// What one ray through a field of cloud brings, integrated adaptively in double precision: the same five numbers as
// shaders/lib/cloud_march.glsl makes, of the same field and the same light model, without its steps and cut-offs.
#include <memory>

#include "welkin/reference/camera_ray.h"
#include "welkin/reference/cloud_light.h"
#include "welkin/shared/cloud_weights.glsl.h"

namespace welkin::reference {

struct CloudSample {
  double extinction_per_m = 0;
  double encodedDepth = 0;           // towards the sun, as bricks store it
  double sunChord = 0, upChord = 0;  // of the whole lines along the sun's direction and upright, as bricks store them
};

// A field of cloud along one ray, cut into stretches in which it is smooth. Distances in metres from where the ray was begun.
class CloudAlong {
 public:
  virtual ~CloudAlong() = default;
  // Goes on to the stretch that begins at t; returns where it ends, after t and not after `end`.
  virtual double enter(double t, double end) = 0;
  virtual bool empty() const = 0;              // of the stretch: nothing is there
  virtual CloudSample at(double t) const = 0;  // within the stretch
};

class CloudField {
 public:
  virtual ~CloudField() = default;
  // Where along a ray (distances from its position) cloud can be: within its altitudes, and before the ground.
  virtual Stretch stretchOf(const CameraRay& ray) const = 0;
  // The field along the ray from a distance on; t = 0 is there.
  virtual std::unique_ptr<CloudAlong> along(const CameraRay& ray, double from_m) const = 0;
  virtual glm::dvec3 towardsSun() const = 0;  // unit, planet frame
  // A name for all that rays can see of the field: equal names, equal pictures.
  virtual std::uint64_t contentHash() const = 0;
};

struct CloudTruth {
  double sun = 0, sky = 0, ground = 0;  // in-scatter weights, 1/sr (shared/cloud_weights.glsl.h)
  double transmittance = 1;
  double distance_m = 0;  // weighted by opacity; of the ground, or kSkyDistance_m, where there is no cloud
  double error = 0;       // estimate: of weights and opacity, and of the distance as a share of the ray's stretch; pessimistic
  bool converged = true;  // false: a stretch could not be halved any further
};
shared::CloudWeights rounded(const CloudTruth& truth);

// Each of the weights to `tolerance`, absolute, and the distance to that share of the stretch that can hold cloud. Ends where less than
// 1e-9 of the light is left.
CloudTruth marchClouds(const CloudField& field, const CameraRay& ray, double tolerance);

}  // namespace welkin::reference
