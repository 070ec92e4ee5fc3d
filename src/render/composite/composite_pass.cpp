#include "welkin/render/composite/composite_pass.h"

#include <algorithm>
#include <bit>
#include <numbers>
#include <string>

#include "welkin/render/exposure/exposure_pass.h"
#include "welkin/render/frame_plan.h"
#include "welkin/render/tone_curve.h"
#include "welkin/shared/bindings.glsl.h"

namespace welkin {
namespace {

Result<gpu::Texture> target(gpu::MemoryAccount& account, GLenum format, int width, int height) {
  gpu::TextureSpec spec;
  spec.format = format;
  spec.width = width, spec.height = height;
  spec.filter = GL_NEAREST;
  spec.frameTarget = true;
  return gpu::Texture::create(account, "picture", spec);
}

// Half the width and height: the mean of 2 x 2 pixels, of their sRGB values (only pictures far finer than the screen come here).
AlbedoPicture halved(const AlbedoPicture& in) {
  AlbedoPicture out{in.width / 2, in.height / 2, {}};
  out.rgba.resize(static_cast<std::size_t>(out.width) * out.height * 4);
  const auto at = [&](int x, int y, int c) { return in.rgba[(static_cast<std::size_t>(y) * in.width + x) * 4 + c]; };
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < 4; ++c) {
        const int sum = at(2 * x, 2 * y, c) + at(2 * x + 1, 2 * y, c) + at(2 * x, 2 * y + 1, c) + at(2 * x + 1, 2 * y + 1, c);
        out.rgba[(static_cast<std::size_t>(y) * out.width + x) * 4 + c] = static_cast<std::uint8_t>((sum + 2) / 4);
      }
  return out;
}

// As glGenerateTextureMipmap does. That one holds a lock of Mesa over all textures, and with it the window's next frame, while software
// translates programs for it: 0.2 s. In bands, as software draws one context's pictures after another's, and a window's is to get its turn.
constexpr int kBandRows = 64;
void makeMipmaps(GLuint texture, int levels, int width, int height) {
  GLuint frames[2];
  glCreateFramebuffers(2, frames);
  glEnable(GL_FRAMEBUFFER_SRGB);  // means of light
  for (int level = 1; level < levels; ++level) {
    const int nextWidth = std::max(width / 2, 1), nextHeight = std::max(height / 2, 1);
    glNamedFramebufferTexture(frames[0], GL_COLOR_ATTACHMENT0, texture, level - 1);
    glNamedFramebufferTexture(frames[1], GL_COLOR_ATTACHMENT0, texture, level);
    const int bands = height == 2 * nextHeight ? (nextHeight + kBandRows - 1) / kBandRows : 1;  // a pixel's four are in its band
    for (int i = 0; i < bands; ++i) {
      const int from = nextHeight * i / bands, to = nextHeight * (i + 1) / bands;
      const int fromAbove = bands > 1 ? 2 * from : 0, toAbove = bands > 1 ? 2 * to : height;
      glBlitNamedFramebuffer(frames[0], frames[1], 0, fromAbove, width, toAbove, 0, from, nextWidth, to, GL_COLOR_BUFFER_BIT, GL_LINEAR);
      glFinish();
    }
    width = nextWidth, height = nextHeight;
  }
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDeleteFramebuffers(2, frames);
}

Result<gpu::Program> composite(const CompositeParts& parts, bool albedoMap, ToneCurve curve, const gpu::Defines& more = {}) {
  const auto onOff = [](bool on) { return std::string(on ? "1" : "0"); };
  gpu::Defines defines{{"OPT_CLOUDS", onOff(parts.clouds)}, {"OPT_AIR", onOff(parts.air)},       {"OPT_SUN", onOff(parts.sun)},
                       {"OPT_GROUND", onOff(parts.ground)}, {"OPT_ALBEDO_MAP", onOff(albedoMap)}, {"OPT_LINEAR", onOff(parts.linear)},
                       {"OPT_DISPLAY", onOff(parts.display)}};
  if (parts.display) defines.emplace_back("TONE_CURVE", toneCurveFunction(curve));
  defines.insert(defines.end(), more.begin(), more.end());
  return gpu::Program::compute("pass/composite/composite.comp", defines);
}

}  // namespace

void CompositePass::use(const Scene& scene, double wind_rad) {
  groundTurn_ = static_cast<float>(wind_rad / (2 * std::numbers::pi));
  const auto vec = [](const Spectrum3& s) { return glm::vec3(s[0], s[1], s[2]); };
  albedo_ = vec(scene.planet.albedo);
  if (!scene.sun) return;
  toSun_ = scene.sun->direction_planet;
  sunIrradiance_ = vec(scene.sun->irradiance);
  sunRadius_rad_ = static_cast<float>(scene.sun->angularRadius_rad);
}

CompositeParts::CompositeParts(const Scene& scene)
    : clouds(scene.clouds), air(scene.atmosphere), sun(scene.sun), display(!planFrame(scene).metered) {}

CompositeParts::CompositeParts(const FramePlan& plan)
    : clouds(plan.clouds), air(plan.air), sun(plan.sun), ground(plan.ground), linear(plan.linear), display(!plan.metered) {}

Result<CompositePass> CompositePass::create(gpu::MemoryAccount& account, const Scene& scene, const CompositeParts& parts, int width, int height,
                                            const AlbedoPicture* albedo) {
  CompositePass pass;
  pass.account_ = &account;
  pass.use(scene);
  pass.parts_ = parts;
  pass.toneCurve_ = scene.output.toneCurve;
  auto program = composite(parts, albedo != nullptr, pass.toneCurve_);
  if (!program) return program.error();
  pass.program_ = std::move(*program);
  if (auto r = pass.resize(width, height); !r) return r.error();
  if (albedo)
    if (auto r = pass.loadAlbedo(account, *albedo); !r) return r.error();
  return pass;
}

Result<void> CompositePass::resize(int width, int height) {
  width_ = width, height_ = height;
  if (parts_->linear) {
    auto radiance = target(*account_, GL_RGBA32F, width, height);
    if (!radiance) return radiance.error();
    radiance_ = std::move(*radiance);
  }
  auto display = target(*account_, GL_RGBA8, width, height);
  if (!display) return display.error();
  display_ = std::move(*display);
  return {};
}

Result<void> CompositePass::useOutput(const CompositeParts& parts, ToneCurve curve) {
  auto program = composite(parts, albedoMap_ != 0, curve);
  if (!program) return program.error();
  program_ = std::move(*program);
  bare_ = {};
  parts_ = parts, toneCurve_ = curve;
  return resize(width_, height_);
}

Result<void> CompositePass::prepareBare() {
  if (bare_.valid()) return {};
  CompositeParts bare = *parts_;
  bare.clouds = bare.air = false;
  auto program = composite(bare, false, toneCurve_);
  if (!program) return program.error();
  bare_ = std::move(*program);
  return {};
}

Result<gpu::Program> CompositePass::compileAside(bool clouds, const gpu::Defines& debug) const {
  CompositeParts parts = *parts_;
  parts.clouds = clouds, parts.linear = false, parts.display = true;
  return composite(parts, albedoMap_ != 0, toneCurve_, debug);
}

void CompositePass::runAside(const gpu::Program& program, const shared::CameraBlock& camera, double exposure_ev, const gpu::Texture& values,
                             const gpu::Texture& colours) const {
  values.bindImage(0, GL_WRITE_ONLY);
  colours.bindImage(1, GL_WRITE_ONLY);
  dispatch(program, camera, exposure_ev);
}

std::uint64_t CompositePass::albedoBytes(int width, int height) {
  return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * 4 * 4 / 3 + 64;
}

bool CompositePass::albedoFits(int width, int height, std::uint64_t budget) {
  return width <= 2048 && (albedoBytes(width, height) <= budget / 16 || width <= 2 || height <= 2);
}

Result<void> CompositePass::loadAlbedo(gpu::MemoryAccount& account, AlbedoPicture picture) {
  while (!albedoFits(picture.width, picture.height, account.budget())) picture = halved(picture);
  const std::uint64_t bytes = albedoBytes(picture.width, picture.height);
  if (!account.charge("albedo", bytes))
    return Error{"the picture of the ground needs " + std::to_string(bytes) + " bytes of GPU memory, which the budget has not"};
  albedoBytes_ = bytes;
  glCreateTextures(GL_TEXTURE_2D, 1, &albedoMap_);
  const int levels = static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(picture.width, picture.height))));
  glTextureStorage2D(albedoMap_, levels, GL_SRGB8_ALPHA8, picture.width, picture.height);
  glTextureSubImage2D(albedoMap_, 0, 0, 0, picture.width, picture.height, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
  makeMipmaps(albedoMap_, levels, picture.width, picture.height);
  glTextureParameteri(albedoMap_, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(albedoMap_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(albedoMap_, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTextureParameteri(albedoMap_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return {};
}

CompositePass::~CompositePass() {
  if (!albedoMap_) return;
  glDeleteTextures(1, &albedoMap_);
  account_->release("albedo", albedoBytes_);
}

void CompositePass::swap(CompositePass& o) noexcept {
  std::swap(program_, o.program_), std::swap(bare_, o.bare_);
  radiance_.swap(o.radiance_);
  display_.swap(o.display_);
  std::swap(width_, o.width_), std::swap(height_, o.height_);
  std::swap(albedo_, o.albedo_), std::swap(toSun_, o.toSun_), std::swap(sunIrradiance_, o.sunIrradiance_);
  std::swap(sunRadius_rad_, o.sunRadius_rad_), std::swap(groundTurn_, o.groundTurn_);
  std::swap(parts_, o.parts_), std::swap(toneCurve_, o.toneCurve_);
  std::swap(albedoMap_, o.albedoMap_), std::swap(albedoBytes_, o.albedoBytes_), std::swap(account_, o.account_);
}

void CompositePass::run(const gpu::Program& program, const shared::CameraBlock& camera, double exposure_ev) const {
  if (parts_->linear) radiance_.bindImage(0, GL_WRITE_ONLY);
  if (parts_->display) display_.bindImage(1, GL_WRITE_ONLY);
  dispatch(program, camera, exposure_ev);
}

void CompositePass::dispatch(const gpu::Program& program, const shared::CameraBlock& camera, double exposure_ev) const {
  const glm::dvec3 up = shared::xyz(camera.up);
  const double pixel_rad = 2 * glm::length(up) / height_;
  if (albedoMap_) glBindTextureUnit(WK_ALBEDO_UNIT, albedoMap_);
  program.set("u_size", glm::ivec2(width_, height_));
  program.set("u_albedo", albedo_);
  program.set("u_sunDir", toSun_);
  program.set("u_sunIrradiance", sunIrradiance_);
  program.set("u_sunRadius_rad", sunRadius_rad_);
  program.set("u_pixel_rad", static_cast<float>(pixel_rad));
  program.set("u_exposure", exposureScale(exposure_ev));
  if (albedoMap_) program.set("u_groundTurn", groundTurn_);
  program.dispatch(static_cast<unsigned>(width_ + 7) / 8, static_cast<unsigned>(height_ + 7) / 8);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

}  // namespace welkin
