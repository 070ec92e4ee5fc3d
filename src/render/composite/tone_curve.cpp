#include "welkin/render/tone_curve.h"

#include <array>

#include "welkin/shared/tonemap.glsl.h"

namespace welkin {
namespace {

struct Curve {
  const char* function;
  glm::vec3 (*value)(glm::vec3);
};
// In the order of ToneCurve.
constexpr std::array<Curve, 4> kCurves{{{"acesFilmic", shared::acesFilmic},
                                        {"reinhardExtended", shared::reinhardExtended},
                                        {"lottes", shared::lottes},
                                        {"uchimura", shared::uchimura}}};

}  // namespace

const char* toneCurveFunction(ToneCurve curve) { return kCurves[std::size_t(curve)].function; }

glm::vec3 toned(ToneCurve curve, glm::vec3 exposed) { return kCurves[std::size_t(curve)].value(exposed); }

double middleGrey(ToneCurve curve) {
  double low = 0, high = 1;  // every curve is over 0.18 at 1
  for (int i = 0; i < 30; ++i) {
    const double middle = (low + high) / 2;
    (toned(curve, glm::vec3(float(middle))).y < 0.18f ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace welkin
