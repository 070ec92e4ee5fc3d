#pragma once
// Thin owners of GL names (direct state access). Each charges its bytes to a MemoryAccount and gives them back.
#include <glad/gl.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "welkin/core/result.h"
#include "welkin/gpu/memory.h"

namespace welkin::gpu {

class Buffer {
 public:
  Buffer() = default;
  // Immutable storage, zero-filled. `flags` as glNamedBufferStorage; GL_DYNAMIC_STORAGE_BIT lets upload() work.
  static Result<Buffer> create(MemoryAccount& account, std::string what, std::size_t bytes, GLbitfield flags = GL_DYNAMIC_STORAGE_BIT,
                               bool frameTarget = false);
  Buffer(Buffer&& o) noexcept { swap(o); }
  Buffer& operator=(Buffer&& o) noexcept { swap(o); return *this; }
  ~Buffer();
  void swap(Buffer& o) noexcept;
  GLuint id() const { return id_; }
  std::size_t bytes() const { return bytes_; }
  void upload(std::size_t offset, std::span<const std::byte> data) const;
  void download(std::size_t offset, std::span<std::byte> data) const;
  template <class T> void upload(std::size_t offset, const std::vector<T>& v) const { upload(offset, std::as_bytes(std::span(v))); }
  void clear() const;  // zeros
  void bind(GLenum target, GLuint binding) const { glBindBufferBase(target, binding, id_); }

 private:
  GLuint id_ = 0;
  std::size_t bytes_ = 0;
  bool frameTarget_ = false;
  std::string what_;
  MemoryAccount* account_ = nullptr;
};

struct TextureSpec {
  GLenum target = GL_TEXTURE_2D;          // 2D, 2D array or 3D
  GLenum format = GL_RGBA16F;
  int width = 1, height = 1, depth = 1;
  GLenum filter = GL_LINEAR;              // both
  GLenum wrap = GL_CLAMP_TO_EDGE;         // all axes
  bool frameTarget = false;
};

class Texture {
 public:
  Texture() = default;
  static Result<Texture> create(MemoryAccount& account, std::string what, const TextureSpec& spec);  // zero-filled
  Texture(Texture&& o) noexcept { swap(o); }
  Texture& operator=(Texture&& o) noexcept { swap(o); return *this; }
  ~Texture();
  void swap(Texture& o) noexcept;
  GLuint id() const { return id_; }
  const TextureSpec& spec() const { return spec_; }
  std::size_t bytes() const { return bytes_; }
  void bind(GLuint unit) const { glBindTextureUnit(unit, id_); }
  void bindImage(GLuint unit, GLenum access) const { glBindImageTexture(unit, id_, 0, GL_TRUE, 0, access, spec_.format); }

 private:
  GLuint id_ = 0;
  std::size_t bytes_ = 0;
  TextureSpec spec_;
  std::string what_;
  MemoryAccount* account_ = nullptr;
};

void copyScaled(const Texture& from, const Texture& to, GLenum filter);  // 2D, of one format; filter: GL_NEAREST or GL_LINEAR

std::size_t formatBytes(GLenum format);  // bytes a texel

}  // namespace welkin::gpu
