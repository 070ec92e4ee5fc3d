#include "welkin/render/sky/sky_probe.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/shared/bindings.glsl.h"

namespace welkin {
namespace {

// As probe.comp has it.
struct ProbePath {
  glm::vec4 anchor, ends, rest{0, 0, 0, 0};
};
constexpr int kPieces = 10;  // of each of four stretches

// The ray from where it enters the shell, and the places where the path or its light has a kink: lowest point, edges of the planet's
// shadow. All in double. `length` 0: the ray misses the air.
ProbePath probePath(double radius, double top, const SkyRay& ray) {
  const double observer = std::max(ray.altitude_m, 0.0);
  double muView = std::cos(ray.viewZenith_rad), muSun = std::cos(ray.sunZenith_rad);
  const double sinView = std::sin(ray.viewZenith_rad), sinSun = std::sin(ray.sunZenith_rad);
  const double cosine = std::clamp(muView * muSun + sinView * sinSun * std::cos(ray.azimuth_rad), -1.0, 1.0);
  ProbePath path;
  double h = observer, r = radius + h, left = ray.maxDistance_m;
  const auto none = [&] {
    path.anchor = {float(top), 1, float(muSun), float(cosine)};
    path.ends = glm::vec4(0);
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
  std::sort(kinks.begin(), kinks.end());
  kinks.resize(3, length);
  path.anchor = {float(h), float(muView), float(muSun), float(cosine)};
  path.ends = {float(kinks[0]), float(kinks[1]), float(kinks[2]), float(length)};
  path.rest.x = ground && end <= left ? 1.0f : 0.0f;
  return path;
}

}  // namespace

Result<std::vector<SkyAnswer>> probeSky(gpu::MemoryAccount& account, SkyTables& tables, const Scene& scene, std::span<const SkyRay> rays) {
  gpu::Defines defines = tables.drawDefines();
  defines.emplace_back("PIECES", std::to_string(kPieces));
  auto program = gpu::Program::compute("pass/sky/probe.comp", defines);
  if (!program) return program.error();
  std::vector<ProbePath> paths;
  for (const SkyRay& ray : rays) paths.push_back(probePath(scene.planet.radius_m, scene.atmosphere->top_m, ray));
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
  std::vector<SkyAnswer> result(paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      result[i].radiance[std::size_t(c)] = answers[2 * i][c];
      result[i].transmittance[std::size_t(c)] = std::exp(-double(answers[2 * i + 1][c]));
    }
  return result;
}

}  // namespace welkin
