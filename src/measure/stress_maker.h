#pragma once
// Views and scenes of which the shots of the stability matrix are made.
#include "stress_shots.h"

namespace welkin::measure {

constexpr double kEarth_m = 6'360'000;
// Cloud so high that voxels are small against it: what is measured is the march, not the voxels.
constexpr double kBase_m = 2000, kTop_m = 18'000, kInside_m = 9000;

View look(glm::dvec3 position, glm::dvec3 forward, double fov_deg = 58);
View from(double radius, double altitude, double heading_deg, double pitch_deg, double fov_deg = 58, double lat = 20, double lon = 10);
// From so far that the planet just fills the picture.
View whole(double radius, double altitude, double lat = 20, double lon = 10);

Scene bare(double radius = kEarth_m);
// One exponential layer, of this optical depth straight up; single scattering, which the reference knows.
Scene clearAir(double radius, double scale_m, double depth, PhaseType phase = PhaseType::Rayleigh, double g = 0);
Scene slabClouds(double extinction_per_m, double radius = kEarth_m);
Scene earth(const char* model = "tables-2d");

struct ShotMaker {
  bool quick;
  std::deque<ShotStage> stages;  // of which references stay good

  std::vector<double> some(std::vector<double> all) const;  // of a list, in small: the first, the last and the middle
  ShotStage& stage(Scene scene);

  void radii(), altitudes(), places(), suns(), fields(), sizes(), grazing();  // where one looks from, and how
  void depths(), times(), densities(), airs();                                // what there is to be seen
};

}  // namespace welkin::measure
