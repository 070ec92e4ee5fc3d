// Every scene and path that the repository ships loads, and says what the programs that wrote it meant.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "welkin/physics/path_io.h"
#include "welkin/physics/scene_io.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;
const fs::path kRepository = WELKIN_SOURCE_DIR;

std::vector<fs::path> jsonFiles(const fs::path& folder) {
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(kRepository / folder))
    if (entry.path().extension() == ".json") out.push_back(entry.path());
  return out;
}

TEST(RepositoryFiles, ScenesLoad) {
  std::size_t n = 0;
  for (const char* folder : {"scenes", "benchmarks/poses", "benchmarks/left-out"}) {
    for (const auto& file : jsonFiles(folder)) {
      const auto scene = loadScene(file);
      ASSERT_TRUE(scene.ok()) << scene.error().message;
      EXPECT_FALSE(scene->views.empty()) << file;
      ++n;
    }
  }
  EXPECT_GE(n, 9u);
}

TEST(RepositoryFiles, PathsLoadWithTheirScenes) {
  for (const char* name : {"orbit-to-ground", "moving-orbit", "moving-near"}) {
    const auto path = loadPath(kRepository / "benchmarks" / (std::string(name) + ".json"));
    ASSERT_TRUE(path.ok()) << path.error().message;
    const auto scene = loadScene(path->scene);
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    const auto above = checkPath(*path, scene->planet);
    EXPECT_TRUE(above.ok()) << above.error().message;
  }
}

// The moving paths start at their pose: the path's own arithmetic (another language, another derivation of the quaternion) and
// the scene reader's agree. Positions are written to 0.1 mm, orientations to 12 digits.
TEST(RepositoryFiles, MovingPathsStartAtTheirPose) {
  for (const std::string name : {"orbit", "near"}) {
    const auto path = loadPath(kRepository / "benchmarks" / ("moving-" + name + ".json"));
    const auto scene = loadScene(kRepository / "benchmarks/poses" / (name + ".json"));
    ASSERT_TRUE(path.ok() && scene.ok());
    const View& pose = scene->views.at(name);
    const View& first = path->frames.front().view;
    EXPECT_LT(glm::length(pose.position_m - first.position_m), 2e-4);
    EXPECT_GT(std::abs(glm::dot(pose.orientation, first.orientation)), 1 - 1e-11);
    EXPECT_EQ(pose.fov_deg, first.fov_deg);
  }
}

TEST(RepositoryFiles, SunOfThePosesStands48DegreesHighAnd60FromTheView) {
  for (const std::string name : {"orbit", "near", "ground"}) {
    const auto scene = loadScene(kRepository / "benchmarks/poses" / (name + ".json"));
    ASSERT_TRUE(scene.ok());
    const View& pose = scene->views.at(name);
    const glm::dvec3 up = glm::normalize(pose.position_m), sun = scene->sun->direction_planet;
    EXPECT_NEAR(glm::degrees(std::asin(glm::dot(up, sun))), 48, 1e-6);  // the subsolar point is written to 1e-9 degrees
    const auto level = [&](glm::dvec3 v) { return glm::normalize(v - up * glm::dot(up, v)); };
    const glm::dvec3 forward = pose.orientation * glm::dvec3(0, 0, -1);
    EXPECT_NEAR(glm::degrees(std::acos(glm::dot(level(forward), level(sun)))), 60, 1e-6);
  }
}

}  // namespace
}  // namespace welkin
