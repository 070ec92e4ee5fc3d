#include "render/bricks/brick_passes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "welkin/shared/bindings.glsl.h"

namespace welkin {
namespace {

constexpr std::uint32_t kSlots = 4;  // batches in flight: results of frame k are read at k + 2
constexpr shared::GpuBrickResult kNothing{0x3F800000u, 0u, shared::kAltitudeNoneMin, 0u};

float fromBits(std::uint32_t bits) { return shared::uintBitsToFloat(bits); }

}  // namespace

std::uint64_t BrickPasses::bytes(const DensitySource& source) {
  const CoverFaces* cover = source.cover();
  const std::uint64_t coverBytes = cover ? std::uint64_t{6} * std::uint64_t(cover->size) * std::uint64_t(cover->size) * 2 : 0;
  return kSlots * kBatch * (sizeof(shared::GpuBrickJob) + sizeof(shared::GpuBrickResult)) + coverBytes +
         std::max<std::size_t>(source.shaderParams().size() * 4, 16);
}

Result<BrickPasses> BrickPasses::create(gpu::MemoryAccount& account, const DensitySource& source, const ResidentTree& tree, const FramePlan& plan,
                                        double light) {
  BrickPasses passes;
  auto jobs = gpu::Buffer::create(account, "brick jobs", kSlots * kBatch * sizeof(shared::GpuBrickJob));
  if (!jobs) return jobs.error();
  auto results = gpu::Buffer::create(account, "brick results", kSlots * kBatch * sizeof(shared::GpuBrickResult));
  if (!results) return results.error();
  const auto words = source.shaderParams();
  auto params = gpu::Buffer::create(account, "source parameters", std::max<std::size_t>(words.size() * 4, 16));
  if (!params) return params.error();
  params->upload(0, words);
  if (const CoverFaces* cover = source.cover()) {
    auto texture = gpu::Texture::create(account, "cover map", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R16, .width = cover->size,
                                                               .height = cover->size, .depth = 6, .filter = GL_NEAREST});
    if (!texture) return texture.error();
    glTextureSubImage3D(texture->id(), 0, 0, 0, 0, cover->size, cover->size, 6, GL_RED, GL_UNSIGNED_SHORT, cover->texels.data());
    passes.cover_ = std::move(*texture);
  }
  gpu::Defines defines = tree.defines();
  defines.emplace_back("SOURCE_SHADER", source.shader());
  defines.emplace_back("ONE_LAYER", plan.oneLayer ? "1" : "0");
  auto generate = gpu::Program::compute("pass/bricks/generate.comp", defines);
  if (!generate) return generate.error();
  if (plan.sun) {
    gpu::Defines lightDefines = tree.defines();
    if (light != 1) {
      const auto samples = [light](int n) { return std::to_string(std::max(1, int(std::lround(light * n)))); };
      lightDefines.insert(lightDefines.end(), {{"LIGHT_REACH", std::to_string(1.5 * light)},
                                               {"LIGHT_NEAR_SAMPLES", samples(3)},
                                               {"LIGHT_NODE_SAMPLES", samples(2)}});
    }
    auto program = gpu::Program::compute("pass/light/light.comp", lightDefines);
    if (!program) return program.error();
    passes.light_ = std::move(*program);
  }
  passes.jobs_ = std::move(*jobs);
  passes.results_ = std::move(*results);
  passes.params_ = std::move(*params);
  passes.generate_ = std::move(*generate);
  return passes;
}

void BrickPasses::upload(const BrickJob* jobs, std::size_t count, std::size_t slot) {
  staging_.resize(count);
  for (std::size_t i = 0; i < count; ++i) staging_[i] = {jobs[i].corner.x, jobs[i].corner.y, jobs[i].corner.z, jobs[i].level, jobs[i].brick, 0, 0, 0};
  jobs_.upload(slot * kBatch * sizeof(shared::GpuBrickJob), staging_);
}

void BrickPasses::generate(const ResidentTree& tree, const std::vector<BrickJob>& jobs, std::uint64_t frame) {
  if (jobs.empty()) return;
  tree.bind();
  tree.bindBrickImages(GL_READ_WRITE);
  jobs_.bind(GL_SHADER_STORAGE_BUFFER, WK_BRICK_JOBS_BINDING);
  results_.bind(GL_SHADER_STORAGE_BUFFER, WK_BRICK_RESULTS_BINDING);
  params_.bind(GL_SHADER_STORAGE_BUFFER, WK_SOURCE_PARAMS_BINDING);
  if (cover_.id()) cover_.bind(WK_COVER_UNIT);
  for (std::size_t first = 0; first < jobs.size(); first += kBatch) {
    const std::size_t count = std::min<std::size_t>(kBatch, jobs.size() - first);
    const std::uint32_t slot = nextSlot_++ % kSlots;
    for (Pending& old : pending_)
      if (old.slot == int(slot)) collect(old);
    upload(jobs.data() + first, count, slot);
    const std::vector<shared::GpuBrickResult> fresh(count, kNothing);
    results_.upload(slot * kBatch * sizeof(shared::GpuBrickResult), fresh);
    generate_.set("u_firstJob", slot * kBatch);
    generate_.dispatch(static_cast<unsigned>(count));
    pending_.push_back({frame, {jobs.begin() + std::ptrdiff_t(first), jobs.begin() + std::ptrdiff_t(first + count)}, {}, int(slot)});
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void BrickPasses::light(const ResidentTree& tree, const std::vector<BrickJob>& jobs) {
  if (jobs.empty()) return;
  tree.bind();
  tree.bindBrickImages(GL_READ_WRITE);
  tree.bindChords();
  jobs_.bind(GL_SHADER_STORAGE_BUFFER, WK_BRICK_JOBS_BINDING);
  for (std::size_t first = 0; first < jobs.size(); first += kBatch) {
    const std::size_t count = std::min<std::size_t>(kBatch, jobs.size() - first);
    const std::uint32_t slot = nextSlot_++ % kSlots;
    for (Pending& old : pending_)
      if (old.slot == int(slot)) collect(old);
    upload(jobs.data() + first, count, slot);
    light_.set("u_firstJob", slot * kBatch);
    light_.dispatch(static_cast<unsigned>(count));
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void BrickPasses::collect(Pending& pending) {
  if (pending.slot < 0) return;
  pending.results.resize(pending.jobs.size());
  results_.download(std::size_t(pending.slot) * kBatch * sizeof(shared::GpuBrickResult), std::as_writable_bytes(std::span(pending.results)));
  pending.slot = -1;
}

std::vector<BrickResult> BrickPasses::results(std::uint64_t upToFrame) {
  std::vector<BrickResult> all;
  while (!pending_.empty() && pending_.front().frame <= upToFrame) {
    Pending& pending = pending_.front();
    collect(pending);
    for (std::size_t i = 0; i < pending.jobs.size(); ++i) {
      const auto& r = pending.results[i];
      const bool any = r.maxBits != 0;
      const float inf = std::numeric_limits<float>::infinity();
      all.push_back({pending.jobs[i].brick, fromBits(r.minBits), fromBits(r.maxBits), any ? fromBits(r.minAltitudeBits) - shared::kAltitudeBias : inf,
                     any ? fromBits(r.maxAltitudeBits) - shared::kAltitudeBias : -inf});
    }
    pending_.pop_front();
  }
  return all;
}

}  // namespace welkin
