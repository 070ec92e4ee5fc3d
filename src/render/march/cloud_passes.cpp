#include "render/march/cloud_passes.h"

#include <cmath>

#include "welkin/render/sky/sky_model.h"
#include "welkin/shared/bindings.glsl.h"

namespace welkin {
namespace {

// Order in which the pixels of a 4 x 4 are marched: far neighbours first (a Bayer matrix read in order of its values).
constexpr int kOrder[16][2] = {{0, 0}, {2, 2}, {2, 0}, {0, 2}, {1, 1}, {3, 3}, {3, 1}, {1, 3},
                               {1, 0}, {3, 2}, {3, 0}, {1, 2}, {0, 1}, {2, 3}, {2, 1}, {0, 3}};

shared::dvec4 pack(glm::dvec3 v, double w) { return {v.x, v.y, v.z, w}; }
unsigned groups(int pixels, int size) { return static_cast<unsigned>((pixels + size - 1) / size); }

constexpr double kLeastEye_m = 0.001;
constexpr int kSpacing = 4;  // of the pixels that are marched first, where others are spread between them

// What a quality defines for the march.
gpu::Defines rulesOf(const Quality& quality) {
  return {{"INTEGRATOR", std::to_string(int(quality.integrator))},
          {"STEP_RULE", std::to_string(int(quality.stepRule)) + "u"},
          {"SKIP_EMPTY", quality.skipEmpty ? "1" : "0"}};
}

}  // namespace

ViewFrame viewFrame(const View& view, double planetRadius_m, double shellTop_m, int width, int height) {
  ViewFrame f;
  f.position_m = view.position_m;
  // A camera on the ground or below it stands on it: rounding must not put its eye inside.
  const double least = planetRadius_m + kLeastEye_m, from = glm::length(view.position_m);
  if (from < least) f.position_m = from > 0 ? view.position_m * (least / from) : glm::dvec3(0, 0, least);
  f.forward = view.orientation * glm::dvec3(0, 0, -1);
  f.right = view.orientation * glm::dvec3(1, 0, 0);
  f.up = view.orientation * glm::dvec3(0, 1, 0);
  f.tanY = std::tan(view.fov_deg * (3.14159265358979323846 / 360));
  f.tanX = f.tanY * width / height;
  const double r = glm::length(f.position_m);
  f.block.position = pack(f.position_m, r - planetRadius_m);
  f.block.forward = pack(f.forward, planetRadius_m);
  f.block.right = pack(f.right * f.tanX, shellTop_m);
  f.block.up = pack(f.up * f.tanY, r);
  return f;
}

Result<CloudPasses> CloudPasses::create(gpu::MemoryAccount& account, const ResidentTree& tree, int width, int height, const FramePlan& plan,
                                        const Quality& quality) {
  CloudPasses passes;
  passes.history_ = plan.history;
  passes.auxWanted_ = plan.aux;
  if (auto made = passes.createTargets(account, width, height); !made) return made.error();
  const auto onOff = [](bool on) { return std::string(on ? "1" : "0"); };
  passes.defines_ = tree.defines();
  passes.defines_.insert(passes.defines_.end(), {{"OPT_AIR", onOff(plan.air)},
                                                 {"OPT_GROUND", onOff(plan.ground && plan.sun)},
                                                 {"OPT_AUX", onOff(plan.aux)},
                                                 {"OPT_HISTORY", onOff(plan.history)}});
  if (auto used = passes.use(account, quality); !used) return used.error();
  if (!plan.history) return passes;
  auto reproject = gpu::Program::compute("pass/reproject/reproject.comp");
  if (!reproject) return reproject.error();
  passes.reproject_ = std::move(*reproject);
  return passes;
}

Result<void> CloudPasses::createTargets(gpu::MemoryAccount& account, int width, int height) {
  width_ = width, height_ = height;
  const auto target = [&](gpu::Texture& out, gpu::TextureSpec spec) -> Result<void> {
    spec.frameTarget = true;
    auto made = gpu::Texture::create(account, "cloud history", spec);
    if (!made) return made.error();
    out = std::move(*made);
    return {};
  };
  for (int i = 0; i < (history_ ? 2 : 1); ++i) {
    if (auto r = target(light_[i], {.format = GL_RGBA16F, .width = width, .height = height}); !r) return r;
    if (auxWanted_)
      if (auto r = target(aux_[i], {.format = GL_RG32F, .width = width, .height = height}); !r) return r;
    if (history_)
      if (auto r = target(age_[i], {.format = GL_R8UI, .width = width, .height = height, .filter = GL_NEAREST}); !r) return r;
  }
  const bool listed = history_ || pixels_.id();
  pixels_ = {};
  if (history_)
    if (auto r = target(change_, {.format = GL_RGBA16F, .width = (width + 3) / 4, .height = (height + 3) / 4}); !r) return r;
  return listed ? createList(account) : Result<void>{};
}

Result<void> CloudPasses::resize(gpu::MemoryAccount& account, int width, int height) {
  const gpu::Texture light = std::move(light_[current_]), aux = std::move(aux_[current_]), age = std::move(age_[current_]);
  if (auto made = createTargets(account, width, height); !made) return made;
  if (!history_ || !haveHistory_) return {};
  gpu::copyScaled(light, light_[current_], GL_LINEAR);
  if (aux.id()) gpu::copyScaled(aux, aux_[current_], GL_NEAREST);  // distances: none lies between cloud and sky
  gpu::copyScaled(age, age_[current_], GL_NEAREST);
  return {};
}

Result<void> CloudPasses::createList(gpu::MemoryAccount& account) {
  if (pixels_.id()) return {};
  auto pixels =
      gpu::Buffer::create(account, "pixel list", 16 + std::size_t(width_) * std::size_t(height_) * 4, GL_DYNAMIC_STORAGE_BIT, true);
  if (!pixels) return pixels.error();
  pixels_ = std::move(*pixels);
  return {};
}

Result<void> CloudPasses::use(gpu::MemoryAccount& account, const Quality& quality) {
  if (auto used = useRules(quality); !used || quality.spread <= 0) return used;
  if (auto made = createList(account); !made) return made;
  if (!march_->list.valid()) {
    auto list = compile(quality, PixelSet::List);
    if (!list) return list.error();
    march_->list = std::move(*list);
  }
  if (spread_.valid()) return {};
  auto spread =
      gpu::Program::compute("pass/spread/spread.comp", {{"OPT_AUX", aux_[0].id() ? "1" : "0"}, {"OPT_HISTORY", history_ ? "1" : "0"}});
  if (!spread) return spread.error();
  spread_ = std::move(*spread);
  return {};
}

Result<void> CloudPasses::useRules(const Quality& quality) {
  const gpu::Defines rules = rulesOf(quality);
  std::string key;
  for (const auto& [name, value] : rules) key += value + " ";
  if (const auto found = marches_.find(key); found != marches_.end()) {
    march_ = &found->second;
    return {};
  }
  Programs made;
  gpu::Program* programs[] = {&made.all, &made.sixteenth, &made.list};
  for (int i = 0; i < (history_ ? 3 : 1); ++i) {
    auto program = compile(quality, PixelSet(i));
    if (!program) return program.error();
    *programs[i] = std::move(*program);
  }
  march_ = &marches_.emplace(key, std::move(made)).first->second;
  return {};
}

void CloudPasses::march(const gpu::Program& program, glm::ivec2 offset, int target) const {
  program.set("u_size", glm::ivec2(width_, height_));
  program.set("u_offset", offset);
  program.set("u_spacing", 1);
  light_[target].bindImage(0, GL_WRITE_ONLY);
  if (aux_[target].id()) aux_[target].bindImage(1, GL_WRITE_ONLY);
  if (history_) age_[target].bindImage(3, GL_WRITE_ONLY);
}

void CloudPasses::marchList(int target) const {
  march(march_->list, {0, 0}, target);
  march_->list.use();
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, pixels_.id());
  glDispatchComputeIndirect(0);
}

void CloudPasses::clearList() const {
  const std::uint32_t head[4] = {0, 1, 1, 0};
  pixels_.upload(0, std::as_bytes(std::span(head)));
  pixels_.bind(GL_SHADER_STORAGE_BUFFER, WK_PIXELS_BINDING);
}

void CloudPasses::marchWhole(const Scene& scene, std::optional<double> seen_ev, int target) const {
  const int first = scene.quality.spread > 0 && seen_ev ? kSpacing : 1;
  march(march_->all, {0, 0}, target);
  march_->all.set("u_spacing", first);
  march_->all.dispatch(groups(width_, 8 * first), groups(height_, 8 * first));
  for (int spacing = first; spacing > 1; spacing /= 2) {
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    clearList();
    light_[target].bindImage(0, GL_READ_WRITE);
    if (aux_[target].id()) aux_[target].bindImage(1, GL_READ_WRITE);
    if (history_) age_[target].bindImage(3, GL_WRITE_ONLY);
    spread_.set("u_size", glm::ivec2(width_, height_));
    spread_.set("u_spacing", spacing);
    spread_.set("u_exposure", float(std::exp2(*seen_ev)));
    spread_.set("u_spread", float(scene.quality.spread / 255));
    spread_.dispatch(groups(width_, 8 * spacing), groups(height_, 8 * spacing));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
    marchList(target);
  }
}

void CloudPasses::setLight(const gpu::Program& program, const Scene& scene) const {
  const glm::vec3 irradiance =
      scene.sun ? glm::vec3(scene.sun->irradiance[0], scene.sun->irradiance[1], scene.sun->irradiance[2]) : glm::vec3(0);
  program.set("u_sunIrradiance", irradiance);
  // The field of diffuse light has the ground's; without air, or with so little that there is no field, the ground is lit by the sun alone.
  const auto model = scene.atmosphere ? skyModel(scene) : Error{"no air"};
  const bool known = model.ok() && model->diffuse();
  program.set("u_groundAlbedo", known ? 0.0f : float(scene.planet.albedo[0] + scene.planet.albedo[1] + scene.planet.albedo[2]) / 3);
}

void CloudPasses::setMotion(const gpu::Program& program, const ViewFrame& view) const {
  program.set("u_move", glm::vec3(view.position_m - last_.position_m));
  program.set("u_oldForward", glm::vec3(last_.forward));
  program.set("u_oldRight", glm::vec3(last_.right / last_.tanX));
  program.set("u_oldUp", glm::vec3(last_.up / last_.tanY));
}

void CloudPasses::show(int target) const {
  light_[target].bind(WK_CLOUD_LIGHT_UNIT);
  if (aux_[target].id()) aux_[target].bind(WK_CLOUD_AUX_UNIT);
}

void CloudPasses::preview(const Scene& scene, std::optional<double> seen_ev) {
  for (const gpu::Program* p : {&march_->all, &march_->list})
    if (p->valid()) setLight(*p, scene);
  marchWhole(scene, seen_ev, spare());
  showSpare();
}

Result<void> CloudPasses::preview(gpu::MemoryAccount& account, const Scene& scene, std::span<const glm::ivec2> pixels) {
  if (!march_->list.valid()) {  // a single picture has none
    auto program = compile(scene.quality, PixelSet::List);
    if (!program) return program.error();
    march_->list = std::move(*program);
  }
  const auto count = static_cast<std::uint32_t>(pixels.size());
  std::vector<std::uint32_t> words{(count + 63) / 64, 1, 1, count};
  for (const glm::ivec2 p : pixels) words.push_back(std::uint32_t(p.x) | std::uint32_t(p.y) << 16);
  auto buffer = gpu::Buffer::create(account, "some pixels", words.size() * sizeof(words[0]), GL_DYNAMIC_STORAGE_BIT, true);
  if (!buffer) return buffer.error();
  buffer->upload(0, std::as_bytes(std::span(words)));
  buffer->bind(GL_SHADER_STORAGE_BUFFER, WK_PIXELS_BINDING);
  marchSpare(march_->list, scene, words[0], 1);
  return {};
}

Result<gpu::Program> CloudPasses::compile(const Quality& quality, PixelSet pixels) const {
  gpu::Defines variant = defines_, rules = rulesOf(quality);
  variant.insert(variant.end(), rules.begin(), rules.end());
  variant.emplace_back("PIXELS", std::to_string(int(pixels)));
  return gpu::Program::compute("pass/march/march.comp", variant);
}

Result<gpu::Program> CloudPasses::compileWatched(const Quality& quality, const gpu::Defines& debug) const {
  gpu::Defines variant = defines_, rules = rulesOf(quality);
  variant.insert(variant.end(), rules.begin(), rules.end());
  variant.insert(variant.end(), debug.begin(), debug.end());
  return gpu::Program::compute("pass/debug/clouds.comp", variant);
}

void CloudPasses::bindAges() const { age_[current_].bind(WK_CLOUD_AGE_UNIT); }

Result<void> CloudPasses::show(gpu::MemoryAccount& account, const Scene& scene, std::span<const shared::CloudWeights> clouds) {
  if (!given_.valid()) {
    auto program = compile(scene.quality, PixelSet::Given);  // it compiles the march, and does not call it
    if (!program) return program.error();
    given_ = std::move(*program);
  }
  auto buffer = gpu::Buffer::create(account, "given clouds", clouds.size_bytes(), GL_DYNAMIC_STORAGE_BIT, true);
  if (!buffer) return buffer.error();
  buffer->upload(0, std::as_bytes(clouds));
  buffer->bind(GL_SHADER_STORAGE_BUFFER, WK_PIXELS_BINDING);
  marchSpare(given_, scene, groups(width_, 8), groups(height_, 8));
  return {};
}

void CloudPasses::marchSpare(const gpu::Program& program, const Scene& scene, unsigned groupsX, unsigned groupsY) const {
  setLight(program, scene);
  march(program, {0, 0}, spare());
  program.dispatch(groupsX, groupsY);
  showSpare();
}

void CloudPasses::showSpare() const {
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  show(spare());
}

void CloudPasses::run(const ViewFrame& view, FrameMode mode, const Scene& scene, std::optional<double> seen_ev, bool refined,
                      gpu::PassTimer& timer) {
  for (const gpu::Program* p : {&march_->all, &march_->sixteenth, &march_->list})
    if (p->valid()) setLight(*p, scene);
  const int old = current_;
  current_ = history_ ? 1 - current_ : 0;
  if (mode == FrameMode::Full || !haveHistory_ || !history_) {
    turn_ = glm::ivec2(-1);
    timer.begin("march");
    marchWhole(scene, seen_ev, current_);
    timer.end();
  } else {
    const glm::ivec2 offset{kOrder[phase_ % 16][0], kOrder[phase_ % 16][1]};
    ++phase_;
    turn_ = offset;
    light_[old].bind(WK_CLOUD_LIGHT_UNIT);
    aux_[old].bind(WK_CLOUD_AUX_UNIT);
    timer.begin("march");
    setMotion(march_->sixteenth, view);
    change_.bindImage(2, GL_WRITE_ONLY);
    march(march_->sixteenth, offset, current_);
    march_->sixteenth.dispatch(groups(width_, 32), groups(height_, 32));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    timer.end();
    timer.begin("reproject");
    clearList();
    change_.bind(WK_CLOUD_CHANGE_UNIT);
    reproject_.set("u_size", glm::ivec2(width_, height_));
    reproject_.set("u_offset", offset);
    reproject_.set("u_refined", int(refined));
    setMotion(reproject_, view);
    light_[current_].bindImage(0, GL_WRITE_ONLY);
    aux_[current_].bindImage(1, GL_WRITE_ONLY);
    age_[current_].bindImage(3, GL_WRITE_ONLY);
    age_[old].bind(WK_CLOUD_AGE_UNIT);
    reproject_.dispatch(groups(width_, 8), groups(height_, 8));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    timer.end();
    timer.begin("march");
    marchList(current_);
    timer.end();
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  show(current_);
  last_ = view;
  haveHistory_ = true;
}

}  // namespace welkin
