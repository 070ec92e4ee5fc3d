#pragma once
// Runs a test shader that calls shared functions, for comparison with the same functions compiled as C++.
#include <bit>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "gl_fixture.h"
#include "welkin/gpu/memory.h"
#include "welkin/gpu/program.h"
#include "welkin/gpu/resources.h"

namespace welkin::test {

class Twins : public GlTest {
 protected:
  // Runs a test shader over `inputs`, `rowsPerGroup` to a work group; `perRow` answers each.
  template <class Answer, class Input>
  std::vector<Answer> run(const std::string& shader, const std::vector<Input>& inputs, std::size_t perRow, const gpu::Defines& defines = {},
                          GLuint binding = 0, const std::function<void(const gpu::Program&)>& prepare = {}, std::size_t rowsPerGroup = 64) {
    auto program = gpu::Program::compute(WELKIN_SOURCE_DIR "/tests/gpu/shaders/" + shader, defines);
    EXPECT_TRUE(program.ok()) << (program.ok() ? "" : program.error().message);
    std::vector<Answer> answers(inputs.size() * perRow);
    if (!program.ok()) return answers;
    const auto in = std::move(gpu::Buffer::create(account, "inputs", inputs.size() * sizeof(Input)).value());
    const auto out = std::move(gpu::Buffer::create(account, "answers", answers.size() * sizeof(Answer)).value());
    in.upload(0, inputs);
    in.bind(GL_SHADER_STORAGE_BUFFER, binding);
    out.bind(GL_SHADER_STORAGE_BUFFER, binding + 1);
    if (prepare) prepare(*program);
    program->dispatch(static_cast<unsigned>(inputs.size() / rowsPerGroup));
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    out.download(0, std::as_writable_bytes(std::span(answers)));
    return answers;
  }
  gpu::MemoryAccount account{64ull << 20};
};

// Distance in units in the last place; 0 and -0 are one.
inline double ulps(float a, float b) {
  if (a == b) return 0;
  if (std::signbit(a) != std::signbit(b)) return 1e9;
  return std::abs(double(std::bit_cast<std::int32_t>(a)) - double(std::bit_cast<std::int32_t>(b)));
}

}  // namespace welkin::test
