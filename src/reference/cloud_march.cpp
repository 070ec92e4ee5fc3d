#include "welkin/reference/cloud_march.h"

#include <array>
#include <glm/glm.hpp>

namespace welkin::reference {
namespace {

constexpr double kNothingLeft = 1e-9;  // of transmittance
constexpr int kMostHalvings = 60;

// Gauss-Legendre rule of four points on [0, 1]: of degree 7, and the integral from 0 to each point of the cubic through all four, which is
// exact for the density within a voxel.
struct Gauss4 {
  std::array<double, 4> x, w;
  std::array<std::array<double, 4>, 4> upTo;
  Gauss4() {
    const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2)), outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
    const double heavy = (18 + std::sqrt(30.0)) / 72, light = (18 - std::sqrt(30.0)) / 72;
    x = {0.5 - 0.5 * outer, 0.5 - 0.5 * inner, 0.5 + 0.5 * inner, 0.5 + 0.5 * outer};
    w = {light, heavy, heavy, light};
    for (std::size_t j = 0; j < 4; ++j) {
      // Lagrange's polynomial of point j, by its coefficients
      std::array<double, 4> c{1, 0, 0, 0};
      std::size_t degree = 0;
      double scale = 1;
      for (std::size_t k = 0; k < 4; ++k) {
        if (k == j) continue;
        for (std::size_t n = ++degree; n > 0; --n) c[n] = c[n - 1] - x[k] * c[n];
        c[0] *= -x[k];
        scale *= x[j] - x[k];
      }
      for (std::size_t i = 0; i < 4; ++i) {
        double sum = 0, power = x[i];
        for (std::size_t n = 0; n < 4; ++n, power *= x[i]) sum += c[n] * power / double(n + 1);
        upTo[i][j] = sum / scale;
      }
    }
  }
};
const Gauss4 kGauss;

// What a piece adds where all light is left at its front: integrals of sigma exp(-tau) times the sun's source, the share of the sky, and
// the distance; and of sigma exp(-tau) alone, which is known: a piece so thick that no point of it sees light would else pass for dark.
struct Piece {
  glm::dvec4 brings{};
  double depth = 0;
};

struct Integrand {
  const CloudAlong& field;
  CloudPhases phases;
  double length;  // distances are taken as a share of it
  glm::dvec3 start, direction, towardsSun;

  // Of the sun's and the sky's light at a distance.
  glm::dvec2 sources(double t, const CloudSample& sample) const {
    const glm::dvec3 up = glm::normalize(start + direction * t);
    const CloudSlab slab = cloudSlab(decodeDepth(sample.sunChord), decodeDepth(sample.upChord), glm::dot(up, towardsSun),
                                     glm::dot(up, direction), glm::dot(direction, towardsSun));
    const double tau = decodeDepth(sample.encodedDepth);
    return {sunSource(phases, tau, slab), openShare(tau, slab)};
  }

  Piece piece(double from, double to) const {
    const double h = to - from;
    std::array<CloudSample, 4> samples;
    for (std::size_t i = 0; i < 4; ++i) samples[i] = field.at(from + h * kGauss.x[i]);
    Piece out;
    for (std::size_t i = 0; i < 4; ++i) {
      double tau = 0;
      for (std::size_t j = 0; j < 4; ++j) tau += kGauss.upTo[i][j] * samples[j].extinction_per_m;
      const double weight = kGauss.w[i] * h * samples[i].extinction_per_m;
      out.depth += weight;
      const double gain = weight * std::exp(-tau * h), at = from + h * kGauss.x[i];
      out.brings += gain * glm::dvec4(sources(at, samples[i]), at / length, 1);
    }
    return out;
  }
};

struct Sum {
  glm::dvec4 brought{};
  double transmittance = 1, error = 0;
  bool converged = true;
};

// Halves the piece until both ways of computing it agree to its share of the tolerance: half of that by length, half by the light that it
// takes away.
void add(const Integrand& f, double from, double to, const Piece& whole, double tolerance, int halvings, Sum& sum) {
  const double middle = 0.5 * (from + to);
  const Piece near = f.piece(from, middle), far = f.piece(middle, to);
  const double kept = std::exp(-near.depth);
  const double taken = -std::expm1(-near.depth - far.depth);
  const glm::dvec4 both = near.brings + kept * far.brings;
  const glm::dvec4 off = glm::abs(both - glm::dvec4(whole.brings.x, whole.brings.y, whole.brings.z, taken));
  // an error of the depth is one of all that comes behind: opacity times itself
  const double depthOff = std::abs(near.depth + far.depth - whole.depth) * std::exp(-near.depth - far.depth);
  const double error = sum.transmittance * std::max({off.x, off.y, off.z, off.w, depthOff});
  const double allowed = tolerance * 0.5 * ((to - from) / f.length + sum.transmittance * taken);
  const bool last = halvings >= kMostHalvings || !(middle > from && middle < to);
  if (error <= allowed || last) {
    sum.brought += sum.transmittance * both;
    sum.transmittance *= kept * std::exp(-far.depth);
    sum.error += error;
    if (error > allowed) sum.converged = false;
    return;
  }
  add(f, from, middle, near, tolerance, halvings + 1, sum);
  if (sum.transmittance >= kNothingLeft) add(f, middle, to, far, tolerance, halvings + 1, sum);
}

}  // namespace

shared::CloudWeights rounded(const CloudTruth& t) {
  return {float(t.sun), float(t.sky), float(t.ground), float(t.transmittance), float(t.distance_m)};
}

CloudTruth marchClouds(const CloudField& field, const CameraRay& ray, double tolerance) {
  CloudTruth out;
  out.distance_m = ray.ground_m >= 0 ? ray.ground_m : double(shared::kSkyDistance_m);
  const Stretch stretch = field.stretchOf(ray);
  if (stretch.empty()) return out;
  const auto along = field.along(ray, stretch.near);
  const double end = stretch.far - stretch.near;
  const glm::dvec3 sun = field.towardsSun();
  const Integrand integrand{
      *along, cloudPhases(glm::dot(ray.direction, sun)), end, ray.position_planet + ray.direction * stretch.near, ray.direction, sun};
  Sum sum;
  for (double t = 0; t < end && sum.transmittance >= kNothingLeft;) {
    const double next = along->enter(t, end);
    if (!along->empty()) add(integrand, t, next, integrand.piece(t, next), tolerance, 0, sum);
    t = next;
  }
  const double opacity = 1 - sum.transmittance;
  out.transmittance = sum.transmittance;
  out.error = sum.error, out.converged = sum.converged;
  if (!(opacity > 0)) return out;
  out.sun = sum.brought.x;
  out.sky = skySource(sum.brought.y);
  out.ground = groundSource(opacity, sum.brought.y);
  out.distance_m = stretch.near + sum.brought.z * end / opacity;
  return out;
}

}  // namespace welkin::reference
