#pragma once
// One path of the path tracer.
#include "guide.h"
#include "welkin/reference/path_tracer.h"
#include "welkin/reference/random.h"

namespace welkin::reference {

// A segment of a path: a ray of the air, its cells, and how probable each is as the place of the next event. Index cells.count() is the
// ground.
struct PathSegment {
  ShellRay ray;
  glm::dvec3 up, direction;  // unit, at its start
  double length_m;
  RayEnd end;
  Cells cells;
  std::vector<Spectrum> cumulative;  // of probabilities by wavelength, n + 1 (with the ground): ascends to 1, or is 0 throughout
};

class PathDrawer {
 public:
  // What all paths of a ray share. `first` is filled once.
  PathDrawer(const Medium& medium, const std::vector<double>& altitudes_m, const Guide& guide, const LitRay& ray,
             const PathSettings& settings);

  // Radiance that one path brings; `hero`: the wavelength that draws it.
  Spectrum draw(int hero, PathNumbers& numbers);

 private:
  struct Event {
    bool ground;
    double altitude_m;
    glm::dvec3 up;
  };
  void fill(PathSegment& segment, bool directCounts);
  Spectrum expected(double altitude_m, double muSun, bool directCounts) const;
  Spectrum expectedOfGround(double muSun, bool directCounts) const;
  Event drawEvent(const PathSegment& segment, int hero, PathNumbers& numbers);
  Spectrum sunAt(const Event& event, PathNumbers& numbers);
  bool turn(const Event& event, int hero, PathNumbers& numbers);

  const Medium& medium_;
  const std::vector<double>& altitudes_m_;
  const Guide& guide_;
  PathSettings settings_;
  glm::dvec3 toSun_;
  PathSegment first_, next_;
  std::vector<Spectrum> plain_, guided_;
  std::vector<double> scratch_;
  // Of the path so far, both over the density that the hero has drawn it with: what it carries, and the density that each wavelength
  // would have drawn it with.
  Spectrum carried_, densities_;
};

}  // namespace welkin::reference
