#include "welkin/octree/node_view.h"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

// The picture is taken wider than it is, so that a turning camera finds refined what it turns to: by a fifth and 5 degrees. Through a
// telescope less: all angles shrink with the picture below this half angle's tangent, and what is outside gets no more than a view
// without it would give.
constexpr double kWider = 1.2, kWiderTan = 0.087, kWideTan = 0.5;
// Stored cloud reaches beyond the source's altitudes: up to one and a half voxels by band limiting, one by interpolation. A voxel is a
// seventh of a node.
constexpr double kLeakNodes = 2.5 / 7.0;

// Penalties rise over this much beyond the border, so that a node on it does not come and go with each tremble of the camera: about
// 6 degrees of turning; 130 km of ground for an Earth.
constexpr double kOutsideRamp = 0.1, kHiddenRamp_rad = 0.02;

}  // namespace

NodeView::NodeView(const RootFrame& root, const SelectionView& view) : root_(root), view_(view) {
  cameraRadius_m_ = glm::length(view.position_m);
  drawnAltitude_m_ = glm::length(view.position_m + view.drawnOffset_m) - root.planetRadius_m;
  aboveDeck_ = std::min(cameraRadius_m_ - root.planetRadius_m - view.slack_m, drawnAltitude_m_ - view.drawnSlack_m) > view.deckTop_m;
  zenith_ = cameraRadius_m_ > 0 ? view.position_m / cameraRadius_m_ : glm::dvec3(0, 0, 1);
  horizonAngle_rad_ = std::acos(std::min(1.0, root.planetRadius_m / std::max(cameraRadius_m_, 1.0)));
  cosHorizon_ = std::cos(horizonAngle_rad_);
  // Along the ray that touches the ground: from the camera to there, and on to the top of the shell.
  const double R = root.planetRadius_m, top = R + view.cloudTop_m;
  farthestCloud_m_ = std::sqrt(std::max(0.0, (cameraRadius_m_ - R) * (cameraRadius_m_ + R))) + std::sqrt((top - R) * (top + R));
  slackAngle_rad_ = view.slack_m / std::max(cameraRadius_m_, 1.0);
  narrow_ = std::min(1.0, view.tanHalfFovY / kWideTan);
  const double tanX = view.tanHalfFovX * kWider + kWiderTan * narrow_, tanY = view.tanHalfFovY * kWider + kWiderTan * narrow_;
  planeX_ = glm::dvec3(tanX, 1, 0) / std::sqrt(1 + tanX * tanX);
  planeY_ = glm::dvec3(tanY, 1, 0) / std::sqrt(1 + tanY * tanY);
}

// How far the sphere is outside the side planes; not over 0: it may be in the picture.
double NodeView::beyondPicture_m(glm::dvec3 centre, double radius_m) const {
  const double ahead = glm::dot(centre, view_.forward);
  return std::max(std::abs(glm::dot(centre, view_.right)) * planeX_.y - ahead * planeX_.x,
                  std::abs(glm::dot(centre, view_.up)) * planeY_.y - ahead * planeY_.x) -
         radius_m;
}

// From radius r one sees a point at radius q over a sphere R up to acos(R/r) + acos(R/q) away, as angles at the centre.
double NodeView::beyondHorizon_rad(glm::dvec3 centre, double radius_m, double size_m) const {
  const double c = glm::length(centre);
  if (c <= radius_m) return 0;
  const double cosine = glm::dot(centre, zenith_) / c;
  if (cosine >= cosHorizon_) return 0;
  const double highest_m = std::min(root_.planetRadius_m + view_.cloudTop_m + size_m * kLeakNodes, c + radius_m);
  const double reach_rad = horizonAngle_rad_ + std::acos(std::min(1.0, root_.planetRadius_m / highest_m)) + slackAngle_rad_;
  return std::acos(std::clamp(cosine, -1.0, 1.0)) - std::asin(radius_m / c) - reach_rad;
}

// Stored cloud leaks by a few voxels, so it is not the node alone that must be below.
bool NodeView::belowDeck(glm::dvec3 centre, double radius_m, double size_m) const {
  return aboveDeck_ && glm::length(centre) + radius_m + size_m * kLeakNodes < root_.planetRadius_m + view_.deckFloor_m;
}

// To the node, but not nearer than the shell that holds cloud.
double NodeView::leastDistance_m(glm::dvec3 offset_m, double half_m, double altitude_m) const {
  const double leak_m = 2 * half_m * kLeakNodes;
  return std::max({glm::length(glm::max(glm::abs(offset_m) - half_m, 0.0)), altitude_m - view_.cloudTop_m - leak_m,
                   view_.cloudBase_m - leak_m - altitude_m});
}

NodeView::Seen NodeView::look(const NodeAddress& node, const Seen& above) const {
  const double size_m = root_.nodeSize_m(node.level), half_m = size_m / 2;
  const glm::dvec3 centre = root_.toPlanet(node.corner) + half_m;
  const glm::dvec3 offset = centre - view_.position_m;
  Seen seen;
  seen.distance_m = std::max(leastDistance_m(offset, half_m, cameraRadius_m_ - root_.planetRadius_m) - view_.slack_m, view_.near_m);
  seen.drawn_m = std::max(leastDistance_m(offset - view_.drawnOffset_m, half_m, drawnAltitude_m_) - view_.drawnSlack_m, view_.near_m);
  const double radius_m = half_m * std::sqrt(3.0);
  // A child's sphere is within its parent's: what is beyond stays beyond.
  const double outside_m = beyondPicture_m(offset, radius_m + view_.slack_m);
  seen.outside = above.outside || outside_m > 0;
  const double outside = std::clamp(outside_m / (kOutsideRamp * narrow_ * glm::length(offset)), 0.0, 1.0);
  const bool deep = above.deep || belowDeck(centre, radius_m, size_m);
  const double hidden_rad = deep ? kHiddenRamp_rad : beyondHorizon_rad(centre, radius_m, size_m);
  seen.deep = hidden_rad >= kHiddenRamp_rad;
  seen.hidden = above.hidden || hidden_rad > 0;
  const double hidden = std::clamp(hidden_rad / kHiddenRamp_rad, 0.0, 1.0);
  seen.penalty = (1 + (kOutsidePenalty / narrow_ - 1) * outside) * (1 + (kHiddenPenalty - 1) * hidden);
  return seen;
}

double NodeView::farDistance_m(const NodeAddress& node) const {
  const double half_m = root_.nodeSize_m(node.level) / 2;
  const glm::dvec3 offset = root_.toPlanet(node.corner) + half_m - view_.position_m;
  return std::min(glm::length(glm::abs(offset) + half_m), farthestCloud_m_) + view_.slack_m;
}

}  // namespace welkin
