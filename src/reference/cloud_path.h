#pragma once
// One path of the cloud path tracer.
#include "welkin/reference/cloud_path_tracer.h"
#include "welkin/reference/random.h"

namespace welkin::reference {

class CloudPath {
 public:
  CloudPath(const CloudPathTracer& tracer, const PathRay& ray, const PathSettings& settings);
  // Radiance that a path brings; `hero`: the wavelength that draws it.
  Spectrum draw(int hero, PathNumbers& numbers);

 private:
  enum class Meets { Space, Ground, Cloud, Air };
  bool begin();  // at the shell's edge; false: the ray misses it
  Meets fly(int hero, PathNumbers& numbers, double limit_m);
  Meets collide(double altitude_m, double cloud_per_m, double place, double majorant_per_m, int hero);
  Spectrum sunAt(PathNumbers& numbers);  // transmittance; on the ground times the zenith cosine
  double cloudTransmittance(glm::dvec3 towards, PathNumbers& numbers);
  void turn(Meets met, PathNumbers& numbers);

  const CloudPathTracer& t_;
  PathRay ray_;
  PathSettings settings_;
  SourceSettings source_;
  SourceWalk walk_, sunWalk_;
  glm::dvec3 position_{}, direction_{};
  double altitude_m_ = 0;
  bool onGround_ = false;
  const MediumLayer* layer_ = nullptr;  // of the air, that was met
  // What the path carries, and the density that each wavelength would have drawn it with, both over the hero's.
  Spectrum carried_{}, densities_{};
  glm::dvec3 toSun_{};  // to the point of the disc that was looked at
  std::vector<double> edges_, scratch_;
};

}  // namespace welkin::reference
