#include "welkin/gpu/resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace welkin::gpu {
namespace {

Error overBudget(const MemoryAccount& account, const std::string& what, std::size_t bytes) {
  return Error{fmt::format("memory: {} needs {:.1f} MiB, but {:.1f} of the budget of {:.1f} MiB are in use", what, double(bytes) / 0x1p20,
                           double(account.used()) / 0x1p20, double(account.budget()) / 0x1p20)};
}

// Mesa holds a lock over the textures of all contexts that share them while software clears one, 50 ms for 128 MiB, and a window's frame
// waits for it. So large ones are cleared piece by piece, with time between for another thread to take the lock: it is not a fair one.
void clearSlices(GLuint texture, const TextureSpec& spec, std::size_t bytes, GLenum format, GLenum type) {
  constexpr std::size_t kPiece = 8 << 20;
  constexpr std::chrono::microseconds kPause{100};
  const int pieces = std::clamp(int(bytes / kPiece), 1, spec.depth);
  for (int i = 0; i < pieces; ++i) {
    if (i > 0) std::this_thread::sleep_for(kPause);
    const int z = int(std::int64_t(spec.depth) * i / pieces), end = int(std::int64_t(spec.depth) * (i + 1) / pieces);
    glClearTexSubImage(texture, 0, 0, 0, z, spec.width, spec.height, end - z, format, type, nullptr);
  }
}

}  // namespace

Result<Buffer> Buffer::create(MemoryAccount& account, std::string what, std::size_t bytes, GLbitfield flags, bool frameTarget) {
  if (!account.charge(what, bytes, frameTarget)) return overBudget(account, what, bytes);
  Buffer buffer;
  buffer.bytes_ = bytes;
  buffer.frameTarget_ = frameTarget;
  buffer.what_ = std::move(what);
  buffer.account_ = &account;
  glCreateBuffers(1, &buffer.id_);
  glNamedBufferStorage(buffer.id_, static_cast<GLsizeiptr>(bytes), nullptr, flags);
  buffer.clear();
  return buffer;
}

Buffer::~Buffer() {
  if (!id_) return;
  glDeleteBuffers(1, &id_);
  account_->release(what_, bytes_, frameTarget_);
}

void Buffer::swap(Buffer& o) noexcept {
  std::swap(id_, o.id_);
  std::swap(bytes_, o.bytes_);
  std::swap(frameTarget_, o.frameTarget_);
  std::swap(what_, o.what_);
  std::swap(account_, o.account_);
}

void Buffer::upload(std::size_t offset, std::span<const std::byte> data) const {
  if (!data.empty()) glNamedBufferSubData(id_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(data.size()), data.data());
}

void Buffer::download(std::size_t offset, std::span<std::byte> data) const {
  if (!data.empty()) glGetNamedBufferSubData(id_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(data.size()), data.data());
}

void Buffer::clear() const { glClearNamedBufferData(id_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr); }

std::size_t formatBytes(GLenum format) {
  switch (format) {
    case GL_R8: case GL_R8UI: return 1;
    case GL_R16: case GL_R16F: case GL_RG8: case GL_R16UI: return 2;
    case GL_RG16: case GL_RG16F: case GL_R32F: case GL_R32UI: case GL_RGBA8: case GL_SRGB8_ALPHA8: return 4;
    case GL_RGBA16F: case GL_RGBA16: case GL_RG32F: case GL_RG32UI: return 8;
    case GL_RGBA32F: case GL_RGBA32UI: return 16;
    default: return 0;
  }
}

Result<Texture> Texture::create(MemoryAccount& account, std::string what, const TextureSpec& spec) {
  const std::size_t texel = formatBytes(spec.format);
  if (texel == 0) return Error{fmt::format("memory: {}: texture format 0x{:x} is not in formatBytes()", what, spec.format)};
  const std::size_t bytes = texel * static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) * static_cast<std::size_t>(spec.depth);
  if (!account.charge(what, bytes, spec.frameTarget)) return overBudget(account, what, bytes);
  Texture texture;
  texture.bytes_ = bytes;
  texture.spec_ = spec;
  texture.what_ = std::move(what);
  texture.account_ = &account;
  glCreateTextures(spec.target, 1, &texture.id_);
  if (spec.target == GL_TEXTURE_2D) glTextureStorage2D(texture.id_, 1, spec.format, spec.width, spec.height);
  else glTextureStorage3D(texture.id_, 1, spec.format, spec.width, spec.height, spec.depth);
  glTextureParameteri(texture.id_, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(spec.filter));
  glTextureParameteri(texture.id_, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(spec.filter));
  for (GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) glTextureParameteri(texture.id_, axis, static_cast<GLint>(spec.wrap));
  const bool integer = spec.format == GL_R8UI || spec.format == GL_R16UI || spec.format == GL_R32UI || spec.format == GL_RG32UI || spec.format == GL_RGBA32UI;
  clearSlices(texture.id_, spec, bytes, integer ? GL_RED_INTEGER : GL_RED, integer ? GL_UNSIGNED_INT : GL_FLOAT);
  return texture;
}

Texture::~Texture() {
  if (!id_) return;
  glDeleteTextures(1, &id_);
  account_->release(what_, bytes_, spec_.frameTarget);
}

void Texture::swap(Texture& o) noexcept {
  std::swap(id_, o.id_);
  std::swap(bytes_, o.bytes_);
  std::swap(spec_, o.spec_);
  std::swap(what_, o.what_);
  std::swap(account_, o.account_);
}

void copyScaled(const Texture& from, const Texture& to, GLenum filter) {
  GLuint frames[2];
  glCreateFramebuffers(2, frames);
  glNamedFramebufferTexture(frames[0], GL_COLOR_ATTACHMENT0, from.id(), 0);
  glNamedFramebufferTexture(frames[1], GL_COLOR_ATTACHMENT0, to.id(), 0);
  glBlitNamedFramebuffer(frames[0], frames[1], 0, 0, from.spec().width, from.spec().height, 0, 0, to.spec().width, to.spec().height,
                         GL_COLOR_BUFFER_BIT, filter);
  glDeleteFramebuffers(2, frames);
}

}  // namespace welkin::gpu
