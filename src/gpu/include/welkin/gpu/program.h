#pragma once
// Compute programs from shaders/: `#include "..."` is resolved against shaders/ and src/shared/include (each file once; a missing
// file is an error), `#line` keeps messages true, `defines` become #define lines. Programs are told apart by name + defines.
#include <glad/gl.h>

#include <glm/glm.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "welkin/core/result.h"

namespace welkin::gpu {

using Defines = std::vector<std::pair<std::string, std::string>>;

// The source with includes resolved, without #version. `#include NAME` takes the path from the define NAME.
Result<std::string> loadShaderSource(const std::string& path, const Defines& defines = {});

class Program {
 public:
  Program() = default;
  // `path` below shaders/, e.g. "pass/march/march.comp".
  static Result<Program> compute(const std::string& path, const Defines& defines = {});
  Program(Program&& o) noexcept { std::swap(id_, o.id_); std::swap(locations_, o.locations_); }
  Program& operator=(Program&& o) noexcept { std::swap(id_, o.id_); std::swap(locations_, o.locations_); return *this; }
  ~Program();
  GLuint id() const { return id_; }
  bool valid() const { return id_ != 0; }
  void use() const { glUseProgram(id_); }
  void set(const char* uniform, float v) const;
  void set(const char* uniform, int v) const;
  void set(const char* uniform, unsigned v) const;
  void set(const char* uniform, glm::vec2 v) const;
  void set(const char* uniform, glm::vec3 v) const;
  void set(const char* uniform, glm::vec4 v) const;
  void set(const char* uniform, glm::ivec2 v) const;
  void set(const char* uniform, glm::ivec3 v) const;
  void set(const char* uniform, glm::uvec3 v) const;
  void set(const char* uniform, const glm::mat3& m) const;
  void dispatch(unsigned x, unsigned y = 1, unsigned z = 1) const;  // uses it; work groups

 private:
  GLint location(const char* uniform) const;
  GLuint id_ = 0;
  mutable std::map<std::string, GLint> locations_;
};

// Where shaders are read from: $WELKIN_SHADERS, else next to the build or install.
std::string shaderFolder();

}  // namespace welkin::gpu
