#pragma once
// All orders of scattering in clouds, the air about them and the ground below them, by Monte Carlo: obvious and slow.
#include <atomic>

#include "welkin/reference/path_tracer.h"
#include "welkin/reference/source_field.h"

namespace welkin::reference {

// Of droplets, whose albedo is 1: two lobes of Henyey and Greenstein, as cloudPhase (shared/cloud_light.glsl.h).
struct Droplets {
  double forwardG = kForwardG, backwardG = kBackwardG, forwardShare = kForwardShare;
};
double phase(const Droplets& droplets, double c);  // 1/sr

struct PathRay {
  glm::dvec3 position_planet{}, direction{}, towardsSun{};         // m, unit
  double maxDistance_m = std::numeric_limits<double>::infinity();  // the ray ends there, with nothing behind it
};

// The scene's air, or a shell without any: what the tracer's clouds float in.
Result<Medium> mediumAround(const Scene& scene, const DensitySource& source);

// Paths go backwards from the observer. Collisions are drawn against bounds of the density, node by node, and most are with nothing
// (Woodcock et al. 1965); the sun is seen from each real one by the air's optical depth and by ratio tracking through the cloud (Novak et
// al. 2014). The wavelengths share a path that one of them draws, by the balance heuristic over the densities that each would have drawn it
// with (Miller et al. 2019). Russian roulette on what a path carries.
class CloudPathTracer {
 public:
  // Keeps references to air, source and root. `detail`: band limit of the density, by distance from the ray's start.
  CloudPathTracer(const Medium& air, const DensitySource& source, const RootFrame& root, const DetailRule& detail,
                  const Droplets& droplets = {});

  // Radiance for a solar irradiance of 1, in 1/sr; settings.withFirstOrder does not matter: all orders are drawn.
  Estimate estimate(const PathRay& ray, const PathSettings& settings) const;

  struct Slab {
    double from_m, to_m;    // altitudes
    double greatest_per_m;  // extinction of its air, of any wavelength
    bool cloudy;
  };
  const std::vector<Slab>& slabs() const { return slabs_; }
  std::uint64_t aboveBounds() const { return aboveBounds_; }  // densities met that were above what was promised: each is a bias

 private:
  friend class CloudPath;
  const Medium& air_;
  const DensitySource& source_;
  const RootFrame& root_;
  DetailRule detail_;
  Droplets droplets_;
  std::vector<double> cells_m_, altitudes_m_;  // of the air's cells; of the slabs' borders
  std::vector<Slab> slabs_;
  double base_m_, top_m_;  // of the clouds
  mutable std::atomic<std::uint64_t> aboveBounds_{0};
};

}  // namespace welkin::reference
