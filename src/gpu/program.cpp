#include "welkin/gpu/program.h"

#include <algorithm>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

// A program that uses an installed Welkin defines it (cmake/welkin_shader_folder.cpp); nobody else does.
extern "C" __attribute__((weak)) const char* welkinFileBesideShaders();

namespace welkin::gpu {
namespace {

namespace fs = std::filesystem;

struct Loader {
  std::vector<fs::path> roots;
  std::set<std::string> done;            // each file once
  std::vector<std::string> open;         // to find cycles
  std::vector<std::string> names;        // index in #line
  std::string out;
  Defines defines;                       // an include may name a define that holds the path

  Result<void> add(const std::string& path, const std::string& from) {
    for (const auto& name : open)
      if (name == path) return Error{fmt::format("shader {}: includes itself through {}", path, from)};
    if (!done.insert(path).second) return {};
    fs::path file;
    for (const auto& root : roots)
      if (fs::exists(root / path)) { file = root / path; break; }
    if (file.empty()) return Error{fmt::format("shader {}: not found (included from {})", path, from)};
    std::ifstream in(file);
    open.push_back(path);
    const std::size_t number = names.size();
    names.push_back(path);
    out += fmt::format("#line 1 {}\n", number);
    std::string line;
    for (int n = 1; std::getline(in, line); ++n) {
      const auto first = line.find_first_not_of(" \t");
      const bool include = first != std::string::npos && line.compare(first, 9, "#include ") == 0;
      if (include) {
        for (const auto& [name, value] : defines)
          if (line.find(" " + name) != std::string::npos) line = "#include \"" + value + "\"";
        const auto a = line.find('"'), b = line.rfind('"');
        if (a != std::string::npos && b > a) {
          if (auto r = add(line.substr(a + 1, b - a - 1), fmt::format("{}:{}", path, n)); !r) return r;
        }  // <...> is C++ only
        out += fmt::format("#line {} {}\n", n + 1, number);
      } else if (first != std::string::npos && line.compare(first, 12, "#pragma once") == 0) {
        out += "\n";
      } else {
        static const std::regex construct("WK_NEW\\((\\w+), *");  // prelude.glsl.h
        out += std::regex_replace(line, construct, "$1(") + "\n";
      }
    }
    open.pop_back();
    return {};
  }
};

std::string compileLog(GLuint shader) {
  GLint length = 0;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string text(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetShaderInfoLog(shader, length, nullptr, text.data());
  return text;
}

}  // namespace

std::string shaderFolder() {
  if (const char* env = std::getenv("WELKIN_SHADERS")) return env;
  std::vector<fs::path> candidates;
  if (welkinFileBesideShaders) candidates.push_back(fs::path(welkinFileBesideShaders()).parent_path() / "shaders");
  std::error_code ignored;  // without /proc the path stays empty and the next candidates count
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  candidates.push_back(program.parent_path().parent_path() / "share/welkin/shaders");
  candidates.insert(candidates.end(), {WELKIN_SOURCE_SHADERS, WELKIN_INSTALL_SHADERS});
  for (const fs::path& candidate : candidates)
    if (fs::exists(candidate, ignored)) return candidate.string();
  return "shaders";
}

Result<std::string> loadShaderSource(const std::string& path, const Defines& defines) {
  const fs::path shaders = shaderFolder();
  Loader loader;
  loader.defines = defines;
  loader.roots = {shaders, shaders / "include", shaders.parent_path() / "src" / "shared" / "include"};
  if (auto r = loader.add(path, "the program"); !r) return r.error();
  std::string legend;
  for (std::size_t i = 0; i < loader.names.size(); ++i) legend += fmt::format("// {} = {}\n", i, loader.names[i]);
  return legend + loader.out;
}

namespace {
thread_local std::shared_ptr<ProgramPool> t_pool;
}

void usePool(std::shared_ptr<ProgramPool> pool) { t_pool = std::move(pool); }

GLuint ProgramPool::take(const std::string& key) {
  const auto found = std::find_if(free_.begin(), free_.end(), [&](const auto& entry) { return entry.first == key; });
  if (found == free_.end()) return 0;
  const GLuint id = found->second;
  free_.erase(found);
  return id;
}

void ProgramPool::give(const std::string& key, GLuint id) {
  free_.emplace_back(key, id);
  if (free_.size() <= kMost) return;
  glDeleteProgram(free_.front().second);
  free_.erase(free_.begin());
}

Result<Program> Program::compute(const std::string& path, const Defines& defines) {
  Program program;
  program.pool_ = t_pool;
  program.key_ = path;
  for (const auto& [name, value] : defines) program.key_ += " " + name + "=" + value;
  if (program.pool_ && (program.id_ = program.pool_->take(program.key_)) != 0) return program;
  auto body = loadShaderSource(path, defines);
  if (!body) return body.error();
  std::string source = "#version 450 core\n";
  for (const auto& [name, value] : defines)
    if (value.find(".glsl") == std::string::npos) source += fmt::format("#define {} {}\n", name, value);
  source += *body;
  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint ok = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (!ok) {
    const std::string log = compileLog(shader);
    glDeleteShader(shader);
    return Error{fmt::format("shader {}: {}{}", path, log, source.substr(0, source.find("#line")))};
  }
  program.id_ = glCreateProgram();
  glAttachShader(program.id_, shader);
  glLinkProgram(program.id_);
  glDeleteShader(shader);
  glGetProgramiv(program.id_, GL_LINK_STATUS, &ok);
  if (!ok) {
    char log[4096] = "";
    glGetProgramInfoLog(program.id_, sizeof log, nullptr, log);
    program.pool_.reset();
    return Error{fmt::format("shader {}: {}", path, log)};
  }
  glObjectLabel(GL_PROGRAM, program.id_, -1, path.c_str());
  return program;
}

Program::~Program() {
  if (id_ && pool_) pool_->give(key_, id_);
  else if (id_) glDeleteProgram(id_);
}

GLint Program::location(const char* uniform) const {
  const auto [it, isNew] = locations_.try_emplace(uniform, 0);
  if (isNew) it->second = glGetUniformLocation(id_, uniform);
  return it->second;
}

void Program::set(const char* u, float v) const { glProgramUniform1f(id_, location(u), v); }
void Program::set(const char* u, int v) const { glProgramUniform1i(id_, location(u), v); }
void Program::set(const char* u, unsigned v) const { glProgramUniform1ui(id_, location(u), v); }
void Program::set(const char* u, glm::vec2 v) const { glProgramUniform2fv(id_, location(u), 1, &v.x); }
void Program::set(const char* u, glm::vec3 v) const { glProgramUniform3fv(id_, location(u), 1, &v.x); }
void Program::set(const char* u, glm::vec4 v) const { glProgramUniform4fv(id_, location(u), 1, &v.x); }
void Program::set(const char* u, glm::ivec2 v) const { glProgramUniform2iv(id_, location(u), 1, &v.x); }
void Program::set(const char* u, glm::ivec3 v) const { glProgramUniform3iv(id_, location(u), 1, &v.x); }
void Program::set(const char* u, glm::uvec3 v) const { glProgramUniform3uiv(id_, location(u), 1, &v.x); }
void Program::set(const char* u, const glm::mat3& m) const { glProgramUniformMatrix3fv(id_, location(u), 1, GL_FALSE, &m[0][0]); }

void Program::dispatch(unsigned x, unsigned y, unsigned z) const {
  glUseProgram(id_);
  glDispatchCompute(x, y, z);
}

}  // namespace welkin::gpu
