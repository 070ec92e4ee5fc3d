#pragma once
// How a camera sees a node: how far, outside the picture, hidden behind the planet. Double precision, planet frame, metres.
#include <glm/glm.hpp>
#include <limits>

#include "welkin/octree/tree.h"
#include "welkin/physics/root_frame.h"

namespace welkin {

inline constexpr double kOutsidePenalty = 2;  // outside the picture; through a telescope more
inline constexpr double kHiddenPenalty = 4;   // behind the planet

// A camera for selection. It flies on until what is asked for now is generated: it is then within slack_m of position_m. What is there
// already is drawn before: then it is within drawnSlack_m of position_m + drawnOffset_m.
struct SelectionView {
  glm::dvec3 position_m{};
  double slack_m = 0;
  glm::dvec3 drawnOffset_m{};
  double drawnSlack_m = 0;
  double near_m = 0;  // nothing is refined further than this distance asks for (rays sample as if they were at least this far)
  glm::dvec3 forward{0, 0, -1}, right{1, 0, 0}, up{0, 1, 0};  // unit
  double tanHalfFovX = 0.5, tanHalfFovY = 0.5;
  double cloudBase_m = 0, cloudTop_m = 0;  // altitudes between which cloud can be
  // From above deckTop_m nothing is seen that is below deckFloor_m. No deck:
  double deckTop_m = std::numeric_limits<double>::infinity(), deckFloor_m = -std::numeric_limits<double>::infinity();
};

class NodeView {
 public:
  struct Seen {
    double distance_m = 0;  // at most that to any cloud in the node, and at least near_m
    double drawn_m = 0;     // the same from where the camera is when it is drawn
    bool outside = false;   // of the picture, enlarged a little
    bool hidden = false;    // behind the planet's horizon, or below a deck
    bool deep = false;      // so far behind it that the whole penalty holds, for all of its children too
    double penalty = 1;     // on the key: 1 if visible, rising beyond the borders to the penalties below
    bool visible() const { return !outside && !hidden; }
  };

  NodeView(const RootFrame& root, const SelectionView& view);
  // `above`: what is known of the parent. Outside and hidden hold for all of a node's children.
  Seen look(const NodeAddress& node, const Seen& above) const;
  // Greatest distance at which a ray could meet cloud in the node: its far corner, or where the planet hides the cloud shell.
  double farDistance_m(const NodeAddress& node) const;

 private:
  double leastDistance_m(glm::dvec3 offset_m, double half_m, double altitude_m) const;
  double beyondPicture_m(glm::dvec3 centre_view, double radius_m) const;
  bool belowDeck(glm::dvec3 centre_planet, double radius_m, double size_m) const;
  double beyondHorizon_rad(glm::dvec3 centre_planet, double radius_m, double size_m) const;

  RootFrame root_;
  SelectionView view_;
  double cameraRadius_m_, drawnAltitude_m_;
  bool aboveDeck_;
  glm::dvec3 zenith_;
  double horizonAngle_rad_, cosHorizon_;
  double slackAngle_rad_, narrow_;
  double farthestCloud_m_;
  glm::dvec3 planeX_, planeY_;  // (distance along forward, along right or up, 0) weights of the picture's side planes
};

}  // namespace welkin
