#include <gtest/gtest.h>
#include <lodepng.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "random32.h"
#include "welkin/clouds/cover_map.h"
#include "welkin/clouds/density_source.h"
#include "welkin/clouds/layer_params.h"
#include "welkin/shared/cover.glsl.h"
#include "welkin/shared/noise.glsl.h"

namespace welkin {
namespace {

using Random = test::Random32;

const RootFrame kRoot = RootFrame::enclosing(6'371'000, 12'000);

float wavy(glm::dvec3 d) { return static_cast<float>(0.5 + 0.3 * std::sin(7 * d.x + 3 * d.z) * std::cos(5 * d.y) + 0.2 * d.z * d.x); }

struct Baked {
  CoverMap map;
  shared::CloudBlock block{};
  explicit Baked(std::uint32_t edge, const std::function<float(glm::dvec3)>& f = wavy) : map(CoverMap::bake(edge, f)) {
    block.header = makeCloudHeader(kRoot, 1, 0);
    map.describe(block.header);
  }
  float at(glm::dvec3 d, std::uint32_t mip = 0) const {
    return shared::coverAt({&block, map.words().data()}, shared::coverPlace(kRoot.toFixed(glm::normalize(d) * kRoot.planetRadius_m)), mip);
  }
};

TEST(Cover, FollowsTheBakedFunction) {
  const Baked baked(256);
  Random random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    // 8 bits: 0.002; the spline smooths over a texel, h^2 / 8 |f''| with h = 2/256 and |f''| below 80: 0.0006
    EXPECT_NEAR(baked.at(d), wavy(d), 0.0035f);
  }
}

TEST(Cover, GoesOnWithoutStepOrKinkAcrossFaceEdgesAndCorners) {
  // noise in each texel: the hardest field for a seam
  const Baked baked(64, [](glm::dvec3 d) {
    return static_cast<float>(shared::mixBits(static_cast<std::uint32_t>(d.x * 1e6) * 31 + static_cast<std::uint32_t>(d.y * 1e6 + 4e6))) *
           0x1p-32f;
  });
  Random random(2);
  std::uniform_real_distribution<double> u(-1, 1);
  const double tiny = 1e-5;  // radians; texels are 1/32
  for (int i = 0; i < 20000; ++i) {
    const int axis = i % 3, next = (axis + 1) % 3;
    glm::dvec3 edge;
    edge[axis] = i & 8 ? 1 : -1;
    edge[next] = i & 16 ? 1 : -1;
    edge[3 - axis - next] = i % 5 == 0 ? (u(random) > 0 ? 1 : -1) * (1 - 1e-9) : u(random);
    for (std::uint32_t mip = 0; mip < 3; ++mip) {
      glm::dvec3 side{0};
      side[axis] = edge[axis] * tiny;
      side[next] = -edge[next] * tiny;
      // along the edge both faces' coordinate is w over the greater component: keep it where it is
      const auto at = [&](double k) {
        glm::dvec3 d = edge + k * side;
        d[3 - axis - next] *= 1 + std::abs(k) * tiny;
        return static_cast<double>(baked.at(d, mip));
      };
      const double a2 = at(2), a = at(1), b = at(-1), b2 = at(-2);
      // 4e-5 of the face's -1..1 is 1.3e-3 texels, and neighbours differ by up to 1
      EXPECT_NEAR(a, b, 1.4e-3) << "mip " << mip << " draw " << i;
      // slopes on both sides agree: second difference over the seam is of second order, plus float rounding
      // (within a texel of a corner, where three faces meet, the field is continuous only)
      if (std::abs(edge[3 - axis - next]) < 1 - 2.0 / (64 >> mip)) {
        EXPECT_NEAR(a2 - a, b - b2, 3e-5) << "mip " << mip << " draw " << i;
      }
    }
  }
}

TEST(Cover, RangesContainTheCover) {
  const Baked baked(
      128, [](glm::dvec3 d) { return static_cast<float>(std::max(0.0, std::sin(40 * d.x) * std::sin(31 * d.y) * std::cos(22 * d.z))); });
  Random random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> u(0, 1);
  int empty = 0, nodes = 0;
  for (int i = 0; i < 20000; ++i) {
    glm::dvec3 d(normal(random), normal(random), normal(random));
    if (i % 4 == 0) d.y = d.x * (1 + 1e-3 * u(random));  // near an edge
    const std::uint32_t level = 3 + random() % 14;
    const glm::uvec3 corner = shared::nodeCorner(kRoot.toFixed(glm::normalize(d) * (kRoot.planetRadius_m + 5000 * u(random))), level);
    const std::uint32_t mip = baked.block.header.coverMip[level];
    const std::uint64_t size = std::uint64_t{1} << (32 - level);
    const CoverRange range = baked.map.range(corner, size, mip);
    ++nodes;
    empty += range.hi <= 0;
    for (int k = 0; k < 20; ++k) {
      glm::uvec3 p;
      for (int a = 0; a < 3; ++a) p[a] = corner[a] + static_cast<std::uint32_t>(u(random) * static_cast<double>(size - 1));
      for (std::uint32_t m = 0; m <= mip; ++m) {
        const float c = shared::coverAt({&baked.block, baked.map.words().data()}, shared::coverPlace(p), m);
        ASSERT_GE(c, range.lo) << "draw " << i << " level " << level << " mip " << m;
        ASSERT_LE(c, range.hi) << "draw " << i << " level " << level << " mip " << m;
      }
    }
  }
  EXPECT_GT(empty, nodes / 8);  // half of the field is exactly zero: the bound sees a good part of it
}

TEST(ProceduralWeather, CoversAHalfAndDependsOnTheSeed) {
  const ProceduralWeather one(1), two(2);
  double sum = 0, difference = 0;
  Random random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const double c = static_cast<double>(one.at(d));
    ASSERT_TRUE(c >= 0 && c <= 1);
    sum += c;
    difference += std::abs(c - static_cast<double>(two.at(d)));
  }
  EXPECT_GT(sum, 0.15 * 20000);
  EXPECT_LT(sum, 0.65 * 20000);
  EXPECT_GT(difference, 0.1 * 20000);
}

class Pictures : public testing::Test {
 protected:
  std::filesystem::path folder = std::filesystem::temp_directory_path() / ("welkin_cover_" + std::to_string(::getpid()));
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }
  std::filesystem::path write(const std::string& name, const std::vector<unsigned char>& bytes) {
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return folder / name;
  }
  static std::vector<unsigned char> picture(unsigned width, unsigned height) {
    std::vector<unsigned char> rgba(std::size_t{4} * width * height, 255), png;
    for (std::size_t i = 0; i < rgba.size(); i += 4) rgba[i + 3] = static_cast<unsigned char>(i / 4 % width < width / 2 ? 0 : 200);
    lodepng::encode(png, rgba, width, height);
    return png;
  }
  static void expectLine(const std::string& message, const std::filesystem::path& file, const std::string& part) {
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_NE(message.find(file.filename().string()), std::string::npos) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
};

TEST_F(Pictures, CoverIsTheAlphaAndColumnZeroIs180West) {
  const auto result = loadCoverPicture(write("ok.png", picture(64, 32)));
  ASSERT_TRUE(result.ok()) << result.error().message;
  EXPECT_NEAR(result->at({0, -1, 0}), 0, 1e-6);           // 90 W
  EXPECT_NEAR(result->at({0, 1, 0}), 200.0 / 255, 1e-6);  // 90 E
}

TEST_F(Pictures, BrokenOnesGetOneLine) {
  auto bytes = picture(64, 32);
  const auto cut = write("cut.png", {bytes.begin(), bytes.begin() + static_cast<long>(bytes.size() / 2)});
  expectLine(loadCoverPicture(cut).error().message, cut, "broken PNG");
  const auto text = write("text.png", {'h', 'e', 'l', 'l', 'o', ' ', 'c', 'l', 'o', 'u', 'd', 's', 'h', 'e', 'l', 'l', 'o',
                                       ' ', 'c', 'l', 'o', 'u', 'd', 's', ' ', ' ', ' ', ' ', ' ', ' ', ' ', ' ', ' ', ' '});
  expectLine(loadCoverPicture(text).error().message, text, "not a PNG");
  const auto nothing = write("nothing.png", {});
  expectLine(loadCoverPicture(nothing).error().message, nothing, "not a PNG");
  const auto square = write("square.png", picture(64, 64));
  expectLine(loadCoverPicture(square).error().message, square, "twice as wide");
  expectLine(loadCoverPicture(folder / "absent.png").error().message, folder / "absent.png", "no such file");
  expectLine(loadCoverPicture(folder).error().message, folder, "no such file");
}

TEST_F(Pictures, SourceReportsBrokenPicturesAndDoesWithoutMissingOnes) {
  Scene scene;
  scene.clouds = Clouds{{LayersSource{write("cut.png", {1, 2, 3}), {}}}, true};
  EXPECT_FALSE(makeDensitySource(scene, kRoot).ok());
  std::get<LayersSource>(scene.clouds->sources[0]).coverMap = folder / "absent.png";
  const auto source = makeDensitySource(scene, kRoot);
  ASSERT_TRUE(source.ok());
  EXPECT_NE((*source)->note().find("procedural weather"), std::string::npos);
}

}  // namespace
}  // namespace welkin
