// Views: geographic or explicit in the file, explicit in memory.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scene_io_json.h"
#include "welkin/physics/scene_io.h"

namespace welkin {
namespace {
constexpr double kRad = std::numbers::pi / 180;

// Sine and cosine of degrees, exact at multiples of 90 so that poles and compass points are.
double sinDeg(double a_deg) {
  const double r = std::remainder(a_deg, 360.0);
  if (r == 0 || std::abs(r) == 180) return 0;
  if (std::abs(r) == 90) return r > 0 ? 1 : -1;
  return std::sin(r * kRad);
}
double cosDeg(double a_deg) {
  const double r = std::abs(std::remainder(a_deg, 360.0));
  if (r == 90) return 0;
  return r == 0 ? 1 : r == 180 ? -1 : std::cos(r * kRad);
}
}  // namespace

glm::dvec3 directionTo(double latitude_deg, double longitude_deg) {
  const double c = cosDeg(latitude_deg);
  return {c * cosDeg(longitude_deg), c * sinDeg(longitude_deg), sinDeg(latitude_deg)};
}

View toView(const GeographicView& g, double planetRadius_m) {
  const glm::dvec3 zenith = directionTo(g.latitude_deg, g.longitude_deg);
  const glm::dvec3 east{-sinDeg(g.longitude_deg), cosDeg(g.longitude_deg), 0};
  const glm::dvec3 north = glm::cross(zenith, east);
  const glm::dvec3 level = north * cosDeg(g.heading_deg) + east * sinDeg(g.heading_deg);
  const glm::dvec3 forward = level * cosDeg(g.pitch_deg) + zenith * sinDeg(g.pitch_deg);
  const glm::dvec3 upLevel = zenith * cosDeg(g.pitch_deg) - level * sinDeg(g.pitch_deg);
  const glm::dvec3 rightLevel = glm::cross(forward, upLevel);
  const glm::dvec3 up = upLevel * cosDeg(g.roll_deg) + rightLevel * sinDeg(g.roll_deg);
  View view;
  view.position_m = zenith * (planetRadius_m + g.altitude_m);
  view.orientation = glm::normalize(glm::quat_cast(glm::dmat3(glm::cross(forward, up), up, -forward)));
  view.fov_deg = g.fov_deg;
  view.exposure_ev = g.exposure_ev;
  return view;
}

namespace detail {

bool aboveGround(glm::dvec3 p, double planetRadius_m) {
  return glm::length(p) >= planetRadius_m * (1 - 8 * std::numeric_limits<double>::epsilon());
}

View readView(const JsonPlace& place, double planetRadius_m) {
  View view;
  if (place.has("position_m") || place.has("orientation_xyzw")) {
    place.object({"position_m", "orientation_xyzw", "fov_deg", "exposure_ev"});
    view.position_m = place.at("position_m").vec3({-kFarthest_m, kFarthest_m});
    if (!aboveGround(view.position_m, planetRadius_m)) {
      place.at("position_m")
          .failPlain(fmt::format("expected a position above the ground, at least {} m from the planet's centre, got {} m", planetRadius_m,
                                 glm::length(view.position_m)));
    }
    view.orientation = place.at("orientation_xyzw").orientation();
    view.fov_deg = place.numberOr("fov_deg", view.fov_deg, kFovRange_deg);
  } else {
    place.object({"latitude_deg", "longitude_deg", "altitude_m", "heading_deg", "pitch_deg", "roll_deg", "fov_deg", "exposure_ev"});
    GeographicView g;
    g.latitude_deg = place.at("latitude_deg").number({-90, 90});
    g.longitude_deg = place.at("longitude_deg").number({-360, 360});
    g.altitude_m = place.at("altitude_m").number({0, kFarthest_m});
    g.heading_deg = place.numberOr("heading_deg", 0, {-360, 360});
    g.pitch_deg = place.numberOr("pitch_deg", 0, {-90, 90});
    g.roll_deg = place.numberOr("roll_deg", 0, {-360, 360});
    g.fov_deg = place.numberOr("fov_deg", g.fov_deg, kFovRange_deg);
    view = toView(g, planetRadius_m);
  }
  if (place.has("exposure_ev")) view.exposure_ev = place.at("exposure_ev").number(kExposureRange_ev);
  return view;
}

nlohmann::ordered_json writeView(const View& v) {
  nlohmann::ordered_json out;
  out["position_m"] = {v.position_m.x, v.position_m.y, v.position_m.z};
  out["orientation_xyzw"] = {v.orientation.x, v.orientation.y, v.orientation.z, v.orientation.w};
  out["fov_deg"] = v.fov_deg;
  if (v.exposure_ev) out["exposure_ev"] = *v.exposure_ev;
  return out;
}

}  // namespace detail

std::string viewToJson(const View& view) { return detail::writeView(view).dump(); }

Result<View> parseView(std::string_view text, const std::string& sourceName, const Planet& planet) {
  try {
    const auto value = detail::parseJson(text, sourceName);
    return detail::readView({value, sourceName}, planet.radius_m);
  } catch (const detail::InputError& error) {
    return Error{error.message};
  }
}

}  // namespace welkin
