#pragma once
// A smooth flight from one view to another: up, over and down, slow at both ends.
#include "welkin/physics/scene.h"

namespace welkin::app {

// Along the great circle, with the altitude of the best path of van Wijk and Nuij, "Smooth and efficient zooming and panning", InfoVis
// 2003: altitude stands for their width of the view, so that what is seen passes at one pace. The view turns against the horizon, which
// follows the planet's curve. Velocity is 0 at both ends. Never lower than the lower end, in altitude above a sphere.
class ViewFlight {
 public:
  ViewFlight(const View& from, const View& to, double planetRadius_m);
  double duration_s() const { return duration_s_; }  // 1 s and what the way asks for: half a minute at most on any planet
  View at(double time_s) const;                      // from before the start, to after the end

 private:
  View from_, to_;
  double radius_m_, duration_s_;
  glm::dvec3 up_, axis_;  // where the great circle starts, and what it turns around
  double angle_rad_;      // along it
  double offset_m_;       // width = altitude + offset
  double width0_m_, width1_m_;
  double r0_ = 0, length_ = 0;  // of the paper: where the path starts on its hyperbola, and its length times rho
  bool straight_ = false;       // up or down only
  glm::dquat arrived_;          // the end's orientation, brought back to the start along the way
};

}  // namespace welkin::app
