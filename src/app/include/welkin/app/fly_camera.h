#pragma once
// The camera that people fly: a pure function of its state, what the hands do, and time. Any frame rate gives the same flight.
//
// Speed is k (h + h0) for a height h above the ground, so that holding one key brings one from orbit (400 km) to the ground in half a
// minute: dh/dt = -k (h + h0) has the solution h + h0 = (h1 + h0) exp(-k t).
#include <functional>
#include <optional>

#include "welkin/app/view_flight.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {

constexpr double kEyeHeight_m = 1.5;     // never nearer to the ground
constexpr double kGroundScale_m = 30;    // h0: at eye height one flies at 10 m/s, as fast as a bird
constexpr double kSpeed_per_s = 0.315;   // k: ln((400 km + h0) / (1.5 m + h0)) / 30 s
constexpr double kDriveTime_s = 0.25;    // speed follows the keys with this time constant
constexpr double kLevelTime_s = 0.5;     // a roll dies away with this one, looking level; slower the steeper one looks
constexpr double kRollRate_rad_s = 1.2;  // of a full roll input
constexpr double kFastFactor = 5;
constexpr double kWheelFactor = 1.25;       // of speed, a notch
constexpr double kSpeedFactorRange = 1024;  // up and down

struct FlyInput {
  glm::dvec3 move{0};      // right, up, back; -1..1 each. Up is away from the planet with `level`, else along the picture
  glm::dvec2 turn_rad{0};  // of this frame: right, up
  double roll = 0;         // clockwise; -1..1
  double wheel = 0;        // notches of this frame, up is faster
  bool fast = false;
  bool level = true;  // the horizon comes level by itself once one steers, and turning keeps it so
};

class FlyCamera {
 public:
  explicit FlyCamera(double planetRadius_m) : radius_m_(planetRadius_m) { setView(view_); }

  // One frame. Input that is not a number counts as none. Long frames are cut to a minute. Moving or turning ends a flight.
  const View& advance(const FlyInput& input, double dt_s);

  const View& view() const { return view_; }
  // Stands still there, at least at eye height above the ground. False, and nothing changes: it is not of finite numbers.
  bool setView(const View& view);
  // The lens alone, while flying too. Nothing changes if it is out of 0..180.
  void setLens(double fov_deg, std::optional<double> exposure_ev);
  void setPlanetRadius(double radius_m);
  // Height of the ground above the planet's radius, m, in a direction from its centre; must be finite. Default: 0.
  void setGround(std::function<double(const glm::dvec3& direction)> altitude_m);

  double altitude_m() const;        // above the planet's radius
  double height_m() const;          // above the ground
  glm::dvec3 velocity_m_s() const;  // planet frame
  double speedFactor = 1;           // of the wheel
  bool moves() const { return flight_ || drive_ != glm::dvec3(0); }

  // A smooth flight, from a moving camera too. goTo keeps heading, pitch, roll and field of view.
  void flyTo(const View& view);
  void goTo(double latitude_deg, double longitude_deg, double altitude_m);
  bool inFlight() const { return flight_.has_value(); }
  void stop();  // at once

  // Orbit drag: grab the planet's point under the cursor, then drag keeps it there by turning the camera around the planet's centre. Past
  // the limb it is the point of the limb below the cursor. False: the cursor points away from the planet. Directions in the view's frame.
  bool grab(const glm::dvec3& direction_view);
  void drag(const glm::dvec3& direction_view);
  void release();

 private:
  double groundAt(const glm::dvec3& direction) const { return ground_ ? ground_(direction) : 0; }
  glm::dvec3 up() const { return view_.position_m / glm::length(view_.position_m); }
  std::optional<glm::dvec3> pointUnder(const glm::dvec3& direction_view) const;  // unit, from the planet's centre
  void turn(const FlyInput& input);
  void roll(const FlyInput& input, double dt_s);
  void move(const FlyInput& input, double dt_s);
  void keepAboveGround();
  double groundScale_m() const;  // h0; less on a planet of a few kilometres

  double radius_m_;
  View view_;
  glm::dvec3 drive_{0};   // velocity over k (h + h0), planet frame
  bool steered_ = false;  // since the view was set: one that was given stays as it is, rolled or not
  std::function<double(const glm::dvec3&)> ground_;
  std::optional<ViewFlight> flight_;
  double flightTime_s_ = 0;
  glm::dvec3 glide_m_{0};              // from the flight's start to where the camera was
  std::optional<glm::dvec3> grabbed_;  // unit, planet frame
};

// Direction of the ray through a point of the picture, view frame, unit; x and y -1..1 from left to right and from bottom to top.
glm::dvec3 directionThrough(const View& view, glm::dvec2 point, double aspect);

}  // namespace welkin::app
