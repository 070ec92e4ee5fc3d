#include "welkin/render/sky/sky_probe.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/physics/air.h"
#include "welkin/shared/bindings.glsl.h"

namespace welkin {
namespace {

// As probe.comp has it.
constexpr int kStretches = 16, kPieces = 6;
struct ProbePath {
  glm::vec4 anchor{0}, rest{0};
  std::array<float, kStretches> ends{};
};

// Altitudes where a profile has a corner, and a scale height's fivefold, below which it changes fastest.
std::vector<double> cornerAltitudes(const Atmosphere& atmosphere) {
  std::vector<double> corners;
  for (const AirLayer& layer : atmosphere.layers) {
    if (const auto* e = std::get_if<ExponentialProfile>(&layer.profile)) corners.push_back(5 * e->scaleHeight_m);
    if (const auto* t = std::get_if<TentProfile>(&layer.profile))
      corners.insert(corners.end(), {t->peak_m - t->halfWidth_m, t->peak_m, t->peak_m + t->halfWidth_m});
    if (const auto* u = std::get_if<UniformProfile>(&layer.profile)) corners.insert(corners.end(), {u->base_m, u->top_m});
  }
  return corners;
}

// The ray from where it enters the shell, and the places where the path or its light has a kink: lowest point, edges of the planet's
// shadow. All in double. A ray that misses the air has no length.
ProbePath probePath(double radius, double top, const std::vector<double>& corners, const ProbeRay& ray) {
  const double observer = std::max(ray.altitude_m, 0.0);
  double muView = std::cos(ray.viewZenith_rad), muSun = std::cos(ray.sunZenith_rad);
  const double sinView = std::sin(ray.viewZenith_rad), sinSun = std::sin(ray.sunZenith_rad);
  const double cosine = std::clamp(muView * muSun + sinView * sinSun * std::cos(ray.azimuth_rad), -1.0, 1.0);
  ProbePath path;
  double h = observer, r = radius + h, left = ray.maxDistance_m;
  const auto none = [&] {
    path.anchor = {float(top), 1, float(muSun), float(cosine)};
    return path;
  };
  if (h > top) {
    const double b = r * muView, c = (h - top) * (r + radius + top);
    if (b >= 0 || b * b <= c) return none();
    const double entry = c / (std::sqrt(b * b - c) - b);
    if (entry >= left) return none();
    left -= entry;
    muSun = (r * muSun + entry * cosine) / (radius + top);
    muView = -std::sqrt(b * b - c) / (radius + top);
    h = top, r = radius + top;
  }
  // The horizon at the ground itself: rays that go down at all meet it at once.
  const double b = r * muView, horizon2 = h * (2 * radius + h), toTop = (top - h) * (r + radius + top);
  const bool ground = muView < 0 && b * b >= horizon2;
  const double end = ground ? horizon2 / (std::sqrt(b * b - horizon2) - b)
                     : muView > 0 ? toTop / (std::sqrt(b * b + toTop) + b) : std::sqrt(b * b + toTop) - b;
  const double length = std::min(end, left);
  std::vector<double> kinks{std::clamp(-b, 0.0, length)};
  // The shadow's cylinder: distance from the sun's axis equal to the planet's radius, on the night's side.
  const double sine = std::sqrt(1 - muSun * muSun);
  const double a = 1 - cosine * cosine, half = r * (muView - muSun * cosine);
  const double rest = (h * sine - radius * muSun * muSun / (1 + sine)) * (r * sine + radius);
  const double disc = half * half - a * rest;
  if (disc > 0 && a > 0) {
    const double q = -(half + std::copysign(std::sqrt(disc), half));
    for (const double t : {q / a, q != 0 ? rest / q : 0.0})
      if (t > 0 && t < length && r * muSun + t * cosine < 0) kinks.push_back(t);
  }
  for (const double corner : corners) {
    const double c = (h - corner) * (r + radius + corner), square = b * b - c;
    if (square <= 0) continue;
    const double q = -(b + std::copysign(std::sqrt(square), b));
    for (const double t : {q, q != 0 ? c / q : 0.0})
      if (t > 0 && t < length) kinks.push_back(t);
  }
  if (kinks.size() >= kStretches) kinks.resize(kStretches - 1);  // the last ones are the corners of layers beyond the sixth
  std::sort(kinks.begin(), kinks.end());
  kinks.resize(kStretches, length);
  path.anchor = {float(h), float(muView), float(muSun), float(cosine)};
  std::transform(kinks.begin(), kinks.end(), path.ends.begin(), [](double t) { return float(t); });
  path.rest.x = ground && end <= left ? 1.0f : 0.0f;
  return path;
}

}  // namespace

Result<std::vector<ProbeResult>> probeSky(gpu::MemoryAccount& account, SkyTables& tables, const Scene& scene, std::span<const ProbeRay> rays) {
  gpu::Defines defines = tables.drawDefines();
  defines.emplace_back("STRETCHES", std::to_string(kStretches));
  defines.emplace_back("PIECES", std::to_string(kPieces));
  auto program = gpu::Program::compute("pass/sky/probe.comp", defines);
  if (!program) return program.error();
  const std::vector<double> corners = cornerAltitudes(*scene.atmosphere);
  std::vector<ProbePath> paths;
  for (const ProbeRay& ray : rays) paths.push_back(probePath(scene.planet.radius_m, airTop_m(scene), corners, ray));
  auto in = gpu::Buffer::create(account, "probe", std::max<std::size_t>(paths.size(), 1) * sizeof(ProbePath));
  if (!in) return in.error();
  auto out = gpu::Buffer::create(account, "probe", std::max<std::size_t>(paths.size(), 1) * 2 * sizeof(glm::vec4));
  if (!out) return out.error();
  in->upload(0, paths);
  tables.bind();
  in->bind(GL_SHADER_STORAGE_BUFFER, 0);
  out->bind(GL_SHADER_STORAGE_BUFFER, 1);
  program->set("u_count", int(paths.size()));
  program->dispatch(unsigned(paths.size() + 7) / 8);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<glm::vec4> answers(2 * paths.size());
  out->download(0, std::as_writable_bytes(std::span(answers)));
  std::vector<ProbeResult> result(paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      result[i].radiance[std::size_t(c)] = answers[2 * i][c];
      result[i].transmittance[std::size_t(c)] = std::exp(-double(answers[2 * i + 1][c]));
    }
  return result;
}

}  // namespace welkin
