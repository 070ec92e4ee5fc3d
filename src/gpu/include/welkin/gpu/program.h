#pragma once
// Compute programs from shaders/: `#include "..."` is resolved against shaders/ and src/shared/include (each file once; a missing
// file is an error), `#line` keeps messages true, `defines` become #define lines. Programs are told apart by name + defines.
#include <glad/gl.h>

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "welkin/core/result.h"

namespace welkin::gpu {

using Defines = std::vector<std::pair<std::string, std::string>>;

// The source with includes resolved, without #version. `#include NAME` takes the path from the define NAME.
Result<std::string> loadShaderSource(const std::string& path, const Defines& defines = {});

// Programs nobody uses, kept for whoever asks for the same next: software GL compiles them anew for each. Of one context: a program
// deleted in one context while another has it bound is a crash at the next dispatch (Mesa 22.3).
class ProgramPool {
 public:
  static constexpr std::size_t kMost = 128;  // two renderers' and some variants; of more, the ones given first are deleted
  GLuint take(const std::string& key);  // 0: there is none
  void give(const std::string& key, GLuint id);

 private:
  std::vector<std::pair<std::string, GLuint>> free_;  // in the order in which they were given
};
// From now on this thread's programs come from there and go back there. None: they are made and deleted.
void usePool(std::shared_ptr<ProgramPool> pool);

class Program {
 public:
  Program() = default;
  // `path` below shaders/, e.g. "pass/march/march.comp".
  static Result<Program> compute(const std::string& path, const Defines& defines = {});
  Program(Program&& o) noexcept { swap(o); }
  Program& operator=(Program&& o) noexcept { swap(o); return *this; }
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
  void swap(Program& o) noexcept {
    std::swap(id_, o.id_), std::swap(locations_, o.locations_), std::swap(key_, o.key_), std::swap(pool_, o.pool_);
  }
  GLint location(const char* uniform) const;
  GLuint id_ = 0;
  std::string key_;                    // of the pool
  std::shared_ptr<ProgramPool> pool_;  // where it goes in the end; none: it is deleted
  mutable std::map<std::string, GLint> locations_;
};

// Where shaders are read from: $WELKIN_SHADERS, else next to the build or install.
std::string shaderFolder();

}  // namespace welkin::gpu
