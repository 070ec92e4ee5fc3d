#include "welkin/render/sky/sky_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "sky_cache.h"
#include "welkin/physics/air.h"
#include "welkin/physics/quadrature.h"
#include "welkin/shared/bindings.glsl.h"

namespace welkin {
namespace {

using namespace shared;

constexpr GLuint kDirections = 0, kRadiance = 1, kMoments = 2;

struct DirectionList {
  std::vector<glm::vec4> all;
  int aboutVertical = 0;
};

// gather.comp says what the numbers mean.
DirectionList directionList(const SkyModel& model, const AirBlock& air) {
  constexpr double pi = std::numbers::pi;
  DirectionList list;
  // Half a circle of azimuths, the other half is its mirror image; midpoints, as the light is periodic in it.
  const auto azimuths = [&](int n, auto&& put) {
    for (int a = 0; a < n; ++a) put(std::cos(pi * (a + 0.5) / n), 2 * pi / n);
  };
  for (const int side : {1, -1})
    for (const QuadratureNode& node : gaussLegendre(side > 0 ? model.above : model.below))
      azimuths(model.azimuths, [&](double cosine, double weight) { list.all.emplace_back(side * node.x, cosine, node.weight * weight, 0); });
  list.aboutVertical = static_cast<int>(list.all.size());
  std::vector<glm::vec4> straightOn;  // what a layer scatters straight on is in the sun's own light: taken off, last
  for (std::uint32_t i = 0; i < air.params.layerCount; ++i) {
    const shared::AirLayer& layer = air.layers[i];
    if (!isPeaked(layer)) continue;
    // Angles by the inverse of Henyey and Greenstein's cumulative distribution, so that each node carries the same light of the peak.
    const double g = layer.g;
    const auto first = list.all.size();
    double total = 0;
    for (const QuadratureNode& node : gaussLegendre(model.peakAngles)) {
      const double s = (1 - g * g) / (1 - g + 2 * g * node.x);
      const double c = std::clamp((1 + g * g - s * s) / (2 * g), -1.0, 1.0);
      const double ratio = phaseValue(layer.phase, layer.g, float(c)) / phaseHenyeyGreenstein(float(c), layer.g);
      total += node.weight * ratio;
      azimuths(model.peakAzimuths, [&](double cosine, double weight) {
        list.all.emplace_back(c, cosine, node.weight * ratio * weight / (2 * pi), float(i));
      });
    }
    for (auto d = first; d < list.all.size(); ++d) list.all[d].z /= float(total);  // no light is made or lost by the quadrature
    if (layer.forward > 0) straightOn.emplace_back(1, 1, -layer.forward, float(i));
  }
  list.all.insert(list.all.end(), straightOn.begin(), straightOn.end());
  return list;
}

// g with sum 1 that makes g' gram g least: gram g = (1, 1, ...), scaled. Empty if there is nothing. Gaussian elimination with pivots: the matrix
// is tiny, and nearly singular once steps say nothing new; the diagonal is raised by the rounding of the floats it is made of. A
// combination that would magnify that rounding past 1e-4 gives way to the last step alone.
constexpr double kGreatestSize = 1000;
std::vector<double> leastCombination(std::vector<double> gram, std::size_t n) {
  std::vector<double> g(n, 1.0);
  for (std::size_t i = 0; i < n; ++i) gram[i * n + i] *= 1 + 1e-12;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t r = k + 1; r < n; ++r)
      if (std::abs(gram[r * n + k]) > std::abs(gram[pivot * n + k])) pivot = r;
    for (std::size_t j = 0; j < n; ++j) std::swap(gram[k * n + j], gram[pivot * n + j]);
    std::swap(g[k], g[pivot]);
    if (gram[k * n + k] == 0) return {};
    for (std::size_t r = 0; r < n; ++r) {
      if (r == k) continue;
      const double f = gram[r * n + k] / gram[k * n + k];
      for (std::size_t j = k; j < n; ++j) gram[r * n + j] -= f * gram[k * n + j];
      g[r] -= f * g[k];
    }
  }
  double all = 0;
  for (std::size_t k = 0; k < n; ++k) all += g[k] /= gram[k * n + k];
  double size = 0;
  for (double& v : g) size += std::abs(v /= all);
  if (size < kGreatestSize) return g;  // not for NaN either: all was 0
  g.assign(n, 0.0);
  g.back() = 1;
  return g;
}

std::string cacheKey(const SkyModel& model, const AirBlock& air, const gpu::Defines& defines) {
  std::string shaders;
  for (const char* pass : {"transmittance", "sunlight", "gather", "project"})
    if (const auto source = gpu::loadShaderSource(std::string("pass/sky/") + pass + ".comp", defines)) shaders += *source;
  const auto text = [](GLenum name) { return std::string(reinterpret_cast<const char*>(glGetString(name))); };
  return fieldKey(air, model, shaders, text(GL_RENDERER) + text(GL_VERSION));
}

constexpr std::size_t kWindow = 8;  // steps that an extrapolation looks back: floats hold few more that are independent

}  // namespace

Result<SkyField> SkyField::create(gpu::MemoryAccount& account, const SkyModel& model, const AirBlock& air, const gpu::Defines& defines) {
  SkyField f;
  f.model_ = model;
  const DirectionList list = directionList(model, air);
  f.aboutVertical_ = list.aboutVertical;
  f.directions_ = static_cast<int>(list.all.size());
  const auto layers = static_cast<std::size_t>(model.moments());
  const auto buffer = [&](gpu::Buffer& out, std::size_t vectors) -> Result<void> {
    auto made = gpu::Buffer::create(account, "sky", std::max<std::size_t>(vectors, 1) * sizeof(glm::vec4));
    if (!made) return made.error();
    out = std::move(*made);
    return {};
  };
  const auto texture = [&](gpu::Texture& out, GLenum target, std::uint32_t height, int depth) -> Result<void> {
    gpu::TextureSpec spec;
    spec.target = target, spec.format = GL_RGBA32F;
    spec.width = static_cast<int>(model.sunTexels), spec.height = static_cast<int>(height), spec.depth = depth;
    auto made = gpu::Texture::create(account, "sky", spec);
    if (!made) return made.error();
    out = std::move(*made);
    return {};
  };
  if (auto r = texture(f.field_, GL_TEXTURE_2D_ARRAY, model.altitudeTexels, model.moments()); !r) return r.error();
  if (auto r = texture(f.irradiance_, GL_TEXTURE_2D, 2 * model.altitudeTexels, 1); !r) return r.error();
  if (auto r = buffer(f.moments_, (layers + 2) * f.points()); !r) return r.error();
  auto store = gpu::Program::compute("pass/sky/store.comp", defines);
  if (!store) return store.error();
  f.store_ = std::move(*store);
  if (!model.diffuse()) {
    f.store(Moments((layers + 2) * f.points(), glm::vec4(0)));
    f.done_ = true, f.rest_ = 0;
    return f;
  }
  f.key_ = cacheKey(model, air, defines);
  if (auto kept = loadField(f.key_, (layers + 2) * f.points())) {
    f.store(*kept);
    f.done_ = f.kept_ = true;
    f.rest_ = model.rest;
    return f;
  }
  if (auto r = buffer(f.directionList_, list.all.size()); !r) return r.error();
  f.directionList_.upload(0, list.all);
  if (auto r = buffer(f.radiance_, list.all.size() * f.points()); !r) return r.error();
  const auto program = [&](gpu::Program& out, const char* path, const char* single) -> Result<void> {
    gpu::Defines all = defines;
    all.emplace_back("SINGLE", single);
    all.emplace_back("DIFFUSE", single[0] == '1' ? "0" : "1");
    all.emplace_back("PIECES", std::to_string(model.pieces));
    auto made = gpu::Program::compute(path, all);
    if (!made) return made.error();
    out = std::move(*made);
    return {};
  };
  if (auto r = program(f.firstProgram_, "pass/sky/gather.comp", "1"); !r) return r.error();
  if (auto r = program(f.nextProgram_, "pass/sky/gather.comp", "0"); !r) return r.error();
  if (auto r = program(f.project_, "pass/sky/project.comp", "1"); !r) return r.error();
  return f;
}

bool SkyField::advance(int rows) {
  if (done_) return false;
  gatherRows(std::min(rows, int(model_.altitudeTexels) - row_));
  if (row_ == int(model_.altitudeTexels)) endOrder();
  return !done_;
}

void SkyField::letGoOfMakers() {
  moments_ = {}, radiance_ = {}, directionList_ = {};
  firstProgram_ = {}, nextProgram_ = {}, project_ = {}, store_ = {};
}

void SkyField::gatherRows(int rows) {
  const bool first = first_.empty();
  const gpu::Program& program = first ? firstProgram_ : nextProgram_;
  const int directions = first ? directions_ : aboutVertical_;
  program.set("u_size", glm::ivec3(int(model_.sunTexels), int(model_.altitudeTexels), directions));
  program.set("u_aboutVertical", aboutVertical_);
  program.set("u_first", row_);
  directionList_.bind(GL_SHADER_STORAGE_BUFFER, kDirections);
  radiance_.bind(GL_SHADER_STORAGE_BUFFER, kRadiance);
  bind();
  program.dispatch((unsigned(rows) * model_.sunTexels * unsigned(directions) + 63) / 64);
  row_ += rows;
}

void SkyField::endOrder() {
  const bool first = first_.empty();
  const int directions = first ? directions_ : aboutVertical_;
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  moments_.bind(GL_SHADER_STORAGE_BUFFER, kMoments);
  project_.set("u_size", glm::ivec3(int(model_.sunTexels), int(model_.altitudeTexels), directions));
  project_.set("u_aboutVertical", aboutVertical_);
  project_.dispatch(unsigned(points() + 63) / 64);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  Moments light((std::size_t(model_.moments()) + 2) * points());
  moments_.download(0, std::as_writable_bytes(std::span(light)));
  row_ = 0;
  ++orders_;
  if (first) {
    first_ = light, light_ = Moments(light.size(), glm::vec4(0));
  } else {
    for (std::size_t i = 0; i < light.size(); ++i) light[i] += first_[i];
  }
  for (std::size_t i = 0; i < light.size(); ++i) light_[i] = light[i] - light_[i];  // now the step
  if (steps_.size() == kWindow) steps_.erase(steps_.begin());
  steps_.push_back({std::move(light_), std::move(light)});
  light_ = extrapolate();
  done_ = rest_ <= model_.rest || orders_ + 1 >= model_.maxOrders;
  store(light_);
  if (!done_) return;
  saveField(key_, light_);
  radiance_ = {}, directionList_ = {};
  steps_.clear(), first_.clear(), light_.clear();
}

void SkyField::store(const Moments& moments) {
  moments_.upload(0, moments);
  moments_.bind(GL_SHADER_STORAGE_BUFFER, kMoments);
  store_.set("u_size", glm::ivec3(int(model_.sunTexels), int(model_.altitudeTexels), 0));
  field_.bindImage(0, GL_WRITE_ONLY);
  irradiance_.bindImage(1, GL_WRITE_ONLY);
  store_.dispatch(unsigned(points() + 63) / 64);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

// Light is the fixed point of x -> first order + scattered x. Anderson's acceleration (1965) from steps x_k -> y_k: the combination
// sum g_k y_k with sum g_k = 1 whose residual sum g_k (y_k - x_k) is least, each wavelength on its own. It is the next x; the error left
// in it is about the residual over 1 - (how much a step shrinks).
SkyField::Moments SkyField::extrapolate() {
  const std::size_t n = steps_.size(), count = first_.size(), lit = points();
  const Moments& last = steps_.back().to;
  Moments best = last;
  rest_ = 0;
  for (int c = 0; c < 3; ++c) {
    double brightest = 0;
    for (std::size_t p = 0; p < lit; ++p) brightest = std::max(brightest, double(last[p][c]));
    // Relative to the brightest altitude under the same sun. Night, where light arrives only after many orders, says nothing about how
    // they fall off.
    std::vector<double> weight(lit, 0.0);
    for (std::size_t sun = 0; sun < model_.sunTexels; ++sun) {
      double most = 0;
      for (std::size_t p = sun; p < lit; p += model_.sunTexels) most = std::max(most, double(last[p][c]));
      if (most > 1e-7 * brightest)
        for (std::size_t p = sun; p < lit; p += model_.sunTexels) weight[p] = 1 / (most * most);
    }
    std::vector<double> gram(n * n, 0.0);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b <= a; ++b) {
        double s = 0;
        for (std::size_t i = 0; i < count; ++i) s += weight[i % lit] * steps_[a].change[i][c] * steps_[b].change[i][c];
        gram[a * n + b] = gram[b * n + a] = s;
      }
    const double shrink = n > 1 && gram[(n - 2) * n + n - 2] > 0 ? std::sqrt(gram[n * n - 1] / gram[(n - 2) * n + n - 2]) : 0.0;
    const std::vector<double> g = leastCombination(gram, n);
    if (g.empty()) continue;  // no light
    double residual = 0, norm = 0;
    for (std::size_t p = 0; p < lit; ++p) {
      double r = 0, value = 0;
      for (std::size_t k = 0; k < n; ++k) r += g[k] * steps_[k].change[p][c], value += g[k] * steps_[k].to[p][c];
      residual += weight[p] * r * r;
      norm += weight[p] > 0;
      // Where nothing was weighed the last step stands; and every order adds light: what leaves less than the first is none.
      if (weight[p] == 0 || !(value >= first_[p][c])) continue;
      for (std::size_t i = p; i < count; i += lit) {
        value = 0;
        for (std::size_t k = 0; k < n; ++k) value += g[k] * steps_[k].to[i][c];
        best[i][c] = float(value);
      }
    }
    if (norm > 0) rest_ = std::max(rest_, std::sqrt(residual / norm) / std::max(1 - shrink, 0.01));
  }
  return best;
}

double SkyField::progress() const {
  if (done_) return 1;
  return (orders_ + double(row_) / model_.altitudeTexels) / std::max(model_.maxOrders - 1, 1);
}

void SkyField::bind() const {
  field_.bind(WK_SKY_FIELD_UNIT);
  irradiance_.bind(WK_SKY_IRRADIANCE_UNIT);
}

std::size_t SkyField::bytes() const {
  return directionList_.bytes() + radiance_.bytes() + moments_.bytes() + field_.bytes() + irradiance_.bytes();
}

}  // namespace welkin
