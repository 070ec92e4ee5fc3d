#pragma once
// What a scene file says, in SI units and double precision. Absent optional = none of it, and it costs nothing.
#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "welkin/core/result.h"

namespace welkin {

using Spectrum3 = std::array<double, 3>;  // values at 680, 550, 440 nm

struct Planet {
  double radius_m = 6'371'000;
  Spectrum3 albedo{0.06, 0.07, 0.10};
  std::filesystem::path albedoMap;  // optional picture, equirectangular; empty = plain albedo
};

struct ExponentialProfile {
  double scaleHeight_m;
  bool operator==(const ExponentialProfile&) const = default;
};
struct TentProfile {
  double peak_m, halfWidth_m;
  bool operator==(const TentProfile&) const = default;
};
struct UniformProfile {
  double base_m, top_m;
  bool operator==(const UniformProfile&) const = default;
};
enum class PhaseType { Rayleigh, CornetteShanks, HenyeyGreenstein, Isotropic };
struct AirLayer {
  std::string name;
  std::variant<ExponentialProfile, TentProfile, UniformProfile> profile;
  Spectrum3 scattering_per_m{}, absorption_per_m{};
  PhaseType phase = PhaseType::Rayleigh;
  double g = 0;
  bool operator==(const AirLayer&) const = default;
};
struct Atmosphere {
  double top_m = 100'000;  // height of the shell above the ground
  std::string model = "auto";
  std::vector<AirLayer> layers;
  bool operator==(const Atmosphere&) const = default;
};

struct Sun {
  Spectrum3 irradiance{1.0, 1.0, 1.0};  // at the planet, of a plane facing the sun: W/m2/nm, or relative (docs/exposure.md)
  double angularRadius_rad = 0.004675;
  glm::dvec3 direction_planet{1, 0, 0};  // unit, towards the sun, planet frame, at the scene's time 0
  double day_s = 0;                      // from noon to noon; below 0: it rises in the west; 0: it stands still
};

// One procedural cloud layer: cover says where, the layer says how high, how thick and how it looks.
struct CloudLayer {
  std::string name;
  double base_m = 1000, top_m = 2000;
  double baseFade_m = 100, topFade_m = 400;   // the vertical profile rises and falls linearly over these
  double extinction_per_m = 0.04;             // greatest
  double coverGain = 1, coverBias = 0;        // cover of this layer = clamp(gain * cover + bias)
  double typeLow = 0, typeHigh = 0;           // 0,0: any weather type; else fades in where the type field is in [low, high]
  double cell_m = 8000;                       // greatest noise cell (rounded to a power of two of octree steps)
  int octaves = 8;
  double gain = 0.5;                          // amplitude ratio of successive octaves
  double billow = 0;                          // 0 plain, 1 billowy (cauliflower)
  double softness = 0.3;                      // width of the cover threshold, in noise units
  double taper = 0.3;                         // how much the threshold rises from base to top: rounds the tops
  double topFollowsCover = 0;                 // 0: top fixed; 1: top falls to the base where cover is thin
  int streak = 0;                             // noise is squeezed 2^streak times along the planet's axis: wisps along parallels
  double warp_m = 0;                          // noise is taken up to so far away, following slow noise: bends the wisps
};

struct LayersSource {  // type "layers" (procedural weather) or "cover-map" (a picture says where)
  std::filesystem::path coverMap;  // empty: procedural weather
  std::vector<CloudLayer> layers;
};
struct SphereSource { glm::dvec3 centre_m; double radius_m, extinction_per_m; };  // tests; also with an edge over 10 % of the radius
struct SlabSource { double base_m, top_m, extinction_per_m; };                     // a uniform shell; tests
using CloudSource = std::variant<LayersSource, SphereSource, SlabSource>;
struct Clouds {
  std::vector<CloudSource> sources;
  bool combineMax = true;  // max or add
  double windEast_m_per_s = 0;  // mean wind: all clouds turn about the axis as one; at the equator, at the ground
};

struct View {
  glm::dvec3 position_m{0, 0, 0};                // planet frame
  glm::dquat orientation{1, 0, 0, 0};            // planetFromView; the view looks along -Z, +X right, +Y up
  double fov_deg = 58;                           // vertical
  std::optional<double> exposure_ev;             // overrides the scene's, metered or not
};

// How the march adds up a segment (shared/integrators.glsl.h) and how long its segments are (shared/step_rules.glsl.h).
enum class Integrator { Rectangle, Trapezoid, Simpson, Simpson38, ExponentialConstant, ExponentialLinear, Adaptive };
inline constexpr std::array<const char*, 7> kIntegratorNames{"rectangle",           "trapezoid",          "simpson", "simpson-3/8",
                                                             "exponential-constant", "exponential-linear", "adaptive"};
enum class StepRule { Uniform, Geometric, Optical, Pixel, Node };
inline constexpr std::array<const char*, 5> kStepRuleNames{"uniform", "geometric", "optical", "pixel", "node"};

struct Quality {
  std::uint64_t budget_bytes = 512ull << 20;
  int depth = 16;
  Integrator integrator = Integrator::ExponentialLinear;
  StepRule stepRule = StepRule::Optical;
  double step = 0.32;       // length of a march segment, in units of its rule
  bool skipEmpty = true;    // false: empty nodes are marched like others; for comparisons
  double spread = 0;        // how unlike marched neighbours may look, 0-255, for pixels between them to be interpolated; 0: every pixel is marched
  double detail = 0;        // node size over distance wanted (nodes a radian); 0: as fine as the budget allows
  std::uint32_t seed = 1;
};

// How linear radiance becomes the colours of a display (shared/tonemap.glsl.h has the curves and their sources).
enum class ToneCurve { Aces, Reinhard, Lottes, Uchimura };
inline constexpr std::array<const char*, 4> kToneCurveNames{"aces", "reinhard", "lottes", "uchimura"};  // in files and on the command line

// A metered exposure: the mean of the picture's log luminance between two percentiles is shown as middle grey (0.18 of white).
struct AutoExposure {
  double compensation_ev = 0;                           // stops brighter than that
  double adaptToBright_s = 0.4, adaptToDark_s = 1.2;    // time constants: 63 % of the way to a darker and to a brighter exposure
  double lowPercentile = 10, highPercentile = 90;       // of the pixels that are not black
  double min_ev = -40, max_ev = 40;                     // no limits
};

struct Output {
  std::optional<double> exposure_ev = 0.0;  // stops over kBaseExposure; none ("auto"): metered
  ToneCurve toneCurve = ToneCurve::Aces;
  AutoExposure autoExposure;
};

struct Scene {
  std::string name;
  std::filesystem::path file;  // where it came from; relative data paths start at its folder
  Planet planet;
  std::optional<Atmosphere> atmosphere;
  std::optional<Sun> sun;
  std::optional<Clouds> clouds;
  Quality quality;
  Output output;
  std::map<std::string, View> views;
};

}  // namespace welkin
