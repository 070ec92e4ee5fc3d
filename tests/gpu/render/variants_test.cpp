// Every shader variant compiles, links and leaves KHR_debug silent (GlTest checks that).
#include <filesystem>
#include <set>

#include "gl_fixture.h"
#include "shader_table.h"

namespace welkin {
namespace {
using namespace test;
namespace fs = std::filesystem;
using Shaders = GlTest;

TEST_F(Shaders, EveryVariantCompiles) {
  for (const ShaderVariant& variant : shaderTable()) {
    const auto program = gpu::Program::compute(variant.path, variant.defines);
    EXPECT_TRUE(program.ok()) << variant.name() << ": " << (program.ok() ? "" : program.error().message);
  }
}

// The table names every pass there is, and every source of density.
TEST_F(Shaders, TableIsComplete) {
  std::set<std::string> listed, found;
  for (const ShaderVariant& variant : shaderTable()) {
    listed.insert(variant.path);
    for (const auto& [key, value] : variant.defines)
      if (key == "SOURCE_SHADER") listed.insert(value);
  }
  const fs::path root = gpu::shaderFolder();
  for (const char* folder : {"pass", "lib/clouds"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.is_regular_file()) found.insert(fs::relative(entry.path(), root).string());
  EXPECT_EQ(listed, found);
}

// A program that is done with serves the next who asks for the same; another one does not get it.
TEST_F(Shaders, PoolGivesBackWhatItGot) {
  gpu::usePool(std::make_shared<gpu::ProgramPool>());
  GLuint first = 0;
  {
    const auto program = gpu::Program::compute("pass/maps/build.comp");
    ASSERT_TRUE(program.ok());
    first = program->id();
    EXPECT_NE(gpu::Program::compute("pass/maps/build.comp")->id(), first) << "it is in use";
  }
  const auto other = gpu::Program::compute("pass/maps/build.comp", {{"UNUSED", "1"}});
  EXPECT_NE(other->id(), first);
  const auto one = gpu::Program::compute("pass/maps/build.comp"), two = gpu::Program::compute("pass/maps/build.comp");
  EXPECT_TRUE(one->id() == first || two->id() == first);
  gpu::usePool(nullptr);
}

// A mistake is told with file and line of the file that has it, and a missing include by who wanted it.
TEST_F(Shaders, MistakesAreTold) {
  const auto missing =
      gpu::Program::compute("pass/bricks/generate.comp", {{"BRICK_TEXTURES", "1"}, {"SOURCE_SHADER", "lib/clouds/none.glsl"}});
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().message.find("lib/clouds/none.glsl"), std::string::npos) << missing.error().message;
  EXPECT_NE(missing.error().message.find("generate.comp:"), std::string::npos) << missing.error().message;
  EXPECT_FALSE(gpu::Program::compute("pass/march/march.comp", {{"BRICK_TEXTURES", "1"}, {"OPT_AIR", "1"}, {"INTEGRATOR", "5"}, {"STEP_RULE", "2u"}, {"SKIP_EMPTY", "1"}}).ok() &&
               gpu::Program::compute("pass/march/march.comp", {{"BRICK_TEXTURES", "no number"}, {"OPT_AIR", "1"}, {"INTEGRATOR", "5"}, {"STEP_RULE", "2u"}, {"SKIP_EMPTY", "1"}, {"PIXELS", "0"}}).ok());
}

}  // namespace
}  // namespace welkin
