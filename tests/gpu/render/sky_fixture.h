#pragma once
// A headless context, a camera and counters as the renderer binds them.
#include <vector>

#include "gl_fixture.h"
#include "sky_scene.h"
#include "welkin/gpu/memory.h"
#include "welkin/gpu/resources.h"
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/counters.glsl.h"

namespace welkin::test {

class SkyFixture : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (HasFatalFailure()) return;
    camera = std::move(gpu::Buffer::create(account, "camera", sizeof(shared::CameraBlock)).value());
    counters = std::move(gpu::Buffer::create(account, "counters", sizeof(shared::Counters)).value());
  }
  void upload(const shared::CameraBlock& block) {
    camera.upload(0, std::as_bytes(std::span(&block, 1)));
    camera.bind(GL_UNIFORM_BUFFER, WK_CAMERA_BINDING);
    counters.bind(GL_SHADER_STORAGE_BUFFER, WK_COUNTERS_BINDING);
  }
  std::uint32_t nanPixels() {
    shared::Counters c{};
    counters.download(0, std::as_writable_bytes(std::span(&c, 1)));
    return c.nanPixels;
  }
  gpu::MemoryAccount account{256ull << 20};
  gpu::Buffer camera, counters;
};

}  // namespace welkin::test
