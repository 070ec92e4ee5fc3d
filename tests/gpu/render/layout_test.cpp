// What GL's reflection says of every block that C++ fills or reads, against the C++ structs: each member's offset, and the size.
#include <cstddef>
#include <map>
#include <set>

#include "gl_fixture.h"
#include "shader_table.h"
#include "welkin/shared/air.glsl.h"
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/camera.glsl.h"
#include "welkin/shared/cloud_source.glsl.h"
#include "welkin/shared/cloud_sphere.glsl.h"
#include "welkin/shared/cloud_weights.glsl.h"
#include "welkin/shared/counters.glsl.h"
#include "welkin/shared/exposure.glsl.h"
#include "welkin/shared/tree_block.glsl.h"

namespace welkin {
namespace {
using namespace test;
using namespace shared;
using Layouts = GlTest;

struct PixelListHead {  // cloud_passes.cpp: the arguments of an indirect dispatch, then the count
  std::uint32_t groups, one, one_, count;
};

struct BlockLayout {
  std::map<std::string, std::size_t> offset;  // full name as GL says it -> where C++ has it
  std::size_t size = 0;                       // of the struct: of the whole block, or the stride of its array
  std::string array;                          // a member of the block's unsized array, whose stride is `size`
};

#define AT(prefix, type, member) \
  { prefix #member, offsetof(type, member) }

// By the block's name in GLSL. Nested arrays are told by their first and last element.
const std::map<std::string, BlockLayout>& blocks() {
  static const std::map<std::string, BlockLayout> all{
      {"TreeUniforms",
       {{AT("tree.", TreeBlock, half_m), AT("tree.", TreeBlock, stepsPerMetre), AT("tree.", TreeBlock, sunDir),
         AT("tree.", TreeBlock, mapCentre), AT("tree.", TreeBlock, stepLength_m), AT("tree.", TreeBlock, rootSize_m),
         AT("tree.", TreeBlock, detail), AT("tree.", TreeBlock, maxExtinction_per_m), AT("tree.", TreeBlock, bandBase_m),
         AT("tree.", TreeBlock, bandTop_m), AT("tree.", TreeBlock, planetRadius_m), AT("tree.", TreeBlock, step),
         AT("tree.", TreeBlock, depth), AT("tree.", TreeBlock, mapBase), AT("tree.", TreeBlock, atlasDepthInverse),
         AT("tree.", TreeBlock, firstNode), AT("tree.", TreeBlock, shadowTop_m), AT("tree.", TreeBlock, sampleNear_m),
         AT("tree.", TreeBlock, bricksPerTexture)},
        sizeof(TreeBlock),
        ""}},
      {"CameraUniforms",
       {{AT("camera.", CameraBlock, position), AT("camera.", CameraBlock, forward), AT("camera.", CameraBlock, right),
         AT("camera.", CameraBlock, up)},
        sizeof(CameraBlock),
        ""}},
      {"CounterBuffer",
       {{AT("counters.", Counters, nanPixels), AT("counters.", Counters, holes), AT("counters.", Counters, marchedPixels),
         AT("counters.", Counters, rejectedPixels), AT("counters.", Counters, cells), AT("counters.", Counters, samples)},
        sizeof(Counters),
        ""}},
      {"ExposureBuffer",
       {{AT("exposure.", ExposureBlock, ev), AT("exposure.", ExposureBlock, scale), AT("exposure.", ExposureBlock, adapted_ev),
         AT("exposure.", ExposureBlock, target_ev), AT("exposure.", ExposureBlock, metered), AT("exposure.", ExposureBlock, started),
         AT("exposure.", ExposureBlock, bins[0]), AT("exposure.", ExposureBlock, stepScale[0])},
        sizeof(ExposureBlock),
        ""}},
      {"Results",
       {{AT("results[0].", GpuBrickResult, minBits), AT("results[0].", GpuBrickResult, maxBits),
         AT("results[0].", GpuBrickResult, minAltitudeBits), AT("results[0].", GpuBrickResult, maxAltitudeBits)},
        sizeof(GpuBrickResult),
        "results[0].minBits"}},
      {"PixelList",
       {{AT("", PixelListHead, groups),
         AT("", PixelListHead, one),
         AT("", PixelListHead, one_),
         AT("", PixelListHead, count),
         {"pixels[0]", sizeof(PixelListHead)}},
        4,
        "pixels[0]"}},
      {"GivenClouds",
       {{AT("given[0].", CloudWeights, sun), AT("given[0].", CloudWeights, sky), AT("given[0].", CloudWeights, ground),
         AT("given[0].", CloudWeights, transmittance), AT("given[0].", CloudWeights, distance_m)},
        sizeof(CloudWeights),
        "given[0].sun"}},
      {"SourceParams",
       {{AT("sourceHeader.", CloudHeader, layerCount),
         AT("sourceHeader.", CloudHeader, coverMips),
         AT("sourceHeader.", CloudHeader, typeShift),
         AT("sourceHeader.", CloudHeader, seed),
         AT("sourceHeader.", CloudHeader, step_m),
         AT("sourceHeader.", CloudHeader, radius_steps),
         AT("sourceHeader.", CloudHeader, radius2Low),
         AT("sourceHeader.", CloudHeader, radius2High),
         AT("sourceHeader.", CloudHeader, lowest_m),
         AT("sourceHeader.", CloudHeader, highest_m),
         AT("sourceHeader.", CloudHeader, footprint_m[0]),
         AT("sourceHeader.", CloudHeader, coverMip[0]),
         AT("sourceHeader.", CloudHeader, coverEdge[0]),
         AT("sourceHeader.", CloudHeader, coverOffset[0]),
#define LAYER(member) {"sourceLayers[0]." #member, sizeof(CloudHeader) + offsetof(CloudLayerParams, member)}
         LAYER(base_m),
         LAYER(thickness_m),
         LAYER(invThickness),
         LAYER(baseFade_m),
         LAYER(invBaseFade),
         LAYER(topFade_m),
         LAYER(invTopFade),
         LAYER(extinction_per_m),
         LAYER(coverGain),
         LAYER(coverBias),
         LAYER(typeLow),
         LAYER(typeHigh),
         LAYER(typeInvRiseLow),
         LAYER(typeInvRiseHigh),
         LAYER(typed),
         LAYER(shift),
         LAYER(streak),
         LAYER(seed),
         LAYER(amplitude),
         LAYER(gain),
         LAYER(billow),
         LAYER(restHigh),
         LAYER(invSoftness),
         LAYER(taper),
         LAYER(topFollowsCover),
         LAYER(warpShift),
         LAYER(warp_steps),
         LAYER(threshold[0]),
         LAYER(octaves[0]),
         LAYER(shown[0]),
         LAYER(spread[0]),
         LAYER(invSpread2[0]),
         LAYER(clump[0]),
         LAYER(filter_m[0]),
         LAYER(blur_m[0]),
#undef LAYER
         {"sourceCover[0]", sizeof(CloudBlock)}},
        4,
        "sourceCover[0]"}},
      {"SourceParams/sphere",
       {{AT("sourceSphere.", SphereParams, centreX), AT("sourceSphere.", SphereParams, centreY), AT("sourceSphere.", SphereParams, centreZ),
         AT("sourceSphere.", SphereParams, radius_steps), AT("sourceSphere.", SphereParams, extinction_per_m)},
        sizeof(SphereParams),
        ""}},
      {"Jobs",
       {{AT("jobs[0].", GpuBrickJob, x), AT("jobs[0].", GpuBrickJob, y), AT("jobs[0].", GpuBrickJob, z), AT("jobs[0].", GpuBrickJob, level),
         AT("jobs[0].", GpuBrickJob, brick)},
        sizeof(GpuBrickJob),
        "jobs[0].x"}},
      {"Directions", {{{"directions[0]", 0}}, sizeof(glm::vec4), "directions[0]"}},
      {"Radiance", {{{"radiance[0]", 0}}, sizeof(glm::vec4), "radiance[0]"}},
      {"Moments", {{{"moments[0]", 0}}, sizeof(glm::vec4), "moments[0]"}},
      {"ChordsOut", {{{"chordsOut[0]", 0}}, sizeof(glm::u16vec2), "chordsOut[0]"}},
      {"Answers", {{{"answers[0]", 0}}, sizeof(glm::vec4), "answers[0]"}},
      {"Paths",
       {{{"paths[0].anchor", 0}, {"paths[0].rest", 16}, {"paths[0].ends[0]", 32}}, 32 + 16 * sizeof(float), "paths[0].anchor"}},
      {"Jobs/map", {{{"jobs[0]", 0}}, sizeof(glm::uvec4), "jobs[0]"}},
      {"NodeBuffer", {{{"words[0]", 0}}, sizeof(NodeWords), "words[0]"}},
      {"AirUniforms",
       {{AT("u_air.", AirBlock, params.radius_m), AT("u_air.", AirBlock, params.top_m), AT("u_air.", AirBlock, params.layerCount),
         AT("u_air.", AirBlock, params.sunR), AT("u_air.", AirBlock, params.peakG), AT("u_air.", AirBlock, params.albedoB),
         AT("u_air.", AirBlock, params.peakLayer), AT("u_air.", AirBlock, params.peakPhase), AT("u_air.", AirBlock, view.upX),
         AT("u_air.", AirBlock, view.muHorizon), AT("u_air.", AirBlock, view.skyEnd), AT("u_air.", AirBlock, view.anchorAltitude_m),
         AT("u_air.", AirBlock, view.anchorOverCentre), AT("u_air.", AirBlock, layers[0].a), AT("u_air.", AirBlock, layers[0].profile),
         AT("u_air.", AirBlock, params.sunNight), AT("u_air.", AirBlock, params.sunSin), AT("u_air.", AirBlock, layers[0].forward),
         AT("u_air.", AirBlock, layers[0].moments[0]), AT("u_air.", AirBlock, layers[5].g)},
        sizeof(AirBlock),
        ""}},
  };
  return all;
}
#undef AT

int property(GLuint program, GLenum interface, GLuint index, GLenum what) {
  GLint value = -1;
  glGetProgramResourceiv(program, interface, index, 1, &what, 1, nullptr, &value);
  return value;
}
std::string nameOf(GLuint program, GLenum interface, GLuint index) {
  char text[256] = "";
  glGetProgramResourceName(program, interface, index, sizeof text, nullptr, text);
  return text;
}

TEST_F(Layouts, ReflectionAgreesWithOffsetof) {
  std::set<std::string> seen;  // block + member, over all variants: a member that nobody sees is a typing mistake here
  for (const ShaderVariant& variant : shaderTable()) {
    const auto program = gpu::Program::compute(variant.path, variant.defines);
    ASSERT_TRUE(program.ok()) << program.error().message;
    const GLuint id = program->id();
    for (const auto& [blockInterface, memberInterface] :
         {std::pair{GL_UNIFORM_BLOCK, GL_UNIFORM}, {GL_SHADER_STORAGE_BLOCK, GL_BUFFER_VARIABLE}}) {
      GLint count = 0;
      glGetProgramInterfaceiv(id, blockInterface, GL_ACTIVE_RESOURCES, &count);
      for (int b = 0; b < count; ++b) {
        std::string block = nameOf(id, blockInterface, static_cast<GLuint>(b));
        if (block == "Ranges") continue;  // bare words
        for (const auto& [key, value] : variant.defines)
          if (key == "SOURCE_SHADER" && value.find("sphere") != std::string::npos && block == "SourceParams") block += "/sphere";
        if (block == "Jobs" && variant.path.find("maps") != std::string::npos) block += "/map";
        const auto known = blocks().find(block);
        ASSERT_NE(known, blocks().end()) << variant.name() << ": block " << block << " is not compared";
        const BlockLayout& layout = known->second;
        for (const auto& [member, offset] : layout.offset) {
          const GLuint index = glGetProgramResourceIndex(id, memberInterface, member.c_str());
          if (index == GL_INVALID_INDEX) continue;
          EXPECT_EQ(property(id, memberInterface, index, GL_OFFSET), static_cast<int>(offset)) << variant.name() << ": " << member;
          seen.insert(block + " " + member);
          const int stride = property(id, memberInterface, index, GL_ARRAY_STRIDE);
          if (member.ends_with("[0]") && member != "jobs[0]" && member != "words[0]" && layout.size != sizeof(glm::vec4)) {
            EXPECT_EQ(stride, member.ends_with("moments[0]") && member.starts_with("u_air") ? 16 : 4) << member;
          }
          const std::size_t expected = member == layout.array               ? layout.size
                                       : member == "sourceLayers[0].base_m" ? sizeof(CloudLayerParams)
                                                                            : 0;
          if (expected == 0) continue;
          // of an array of structs the top level's, of an array of words its own
          const bool words = member.ends_with("[0]");
          EXPECT_EQ(words ? stride : property(id, memberInterface, index, GL_TOP_LEVEL_ARRAY_STRIDE), static_cast<int>(expected))
              << variant.name() << ": " << member;
        }
        if (!layout.array.empty()) continue;
        // Equal but for the padding at the end: Mesa rounds a block up to 16 bytes, a C++ struct ends at its alignment, 32 at most.
        const int bytes = property(id, blockInterface, static_cast<GLuint>(b), GL_BUFFER_DATA_SIZE);
        EXPECT_LE(bytes, static_cast<int>((layout.size + 15) / 16 * 16)) << variant.name() << ": " << block;
        EXPECT_GT(bytes + 32, static_cast<int>(layout.size)) << variant.name() << ": " << block;
      }
    }
  }
  for (const auto& [block, layout] : blocks())
    for (const auto& [member, offset] : layout.offset)
      EXPECT_TRUE(seen.contains(block + " " + member)) << "GL has no " << member << " in " << block;
}

}  // namespace
}  // namespace welkin
