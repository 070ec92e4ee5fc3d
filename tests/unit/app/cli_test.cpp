// The command line without GL: options, usage errors, and the checks that come before any work.
#include "run_program.h"
#include "welkin/app/cli.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "welkin/app/flight.h"
#include "welkin/app/options.h"
#include "welkin/core/files.h"
#include "welkin/physics/path_io.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using test::Ran, test::run;
void expectUsageError(const Ran& r) {
  EXPECT_EQ(r.exit, 2) << r.err;
  EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
  EXPECT_EQ(r.out, "");
}
void expectFailure(const Ran& r, const std::string& says) {
  EXPECT_EQ(r.exit, 1) << r.err;
  EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
  EXPECT_THAT(r.err, HasSubstr(says));
}

TEST(Options, sizesRangesAndLists) {
  EXPECT_EQ(parseSize("320x180")->width, 320);
  EXPECT_EQ(parseSize("1x16384")->height, 16384);
  for (const char* wrong : {"", "x", "320", "0x5", "5x0", "-1x5", "100000x5", "5x16385", "5x5x5", "5 x5", "1e2x5", "99999999999x1"}) {
    EXPECT_FALSE(parseSize(wrong).ok()) << wrong;
  }
  EXPECT_EQ(parseRange("3:9")->first, 3);
  EXPECT_EQ(parseRange("3:9")->end, 9);
  EXPECT_FALSE(parseRange("3:")->end.has_value());
  EXPECT_EQ(parseRange(":")->first, 0);
  for (const char* wrong : {"", "3", "9:3", "3:3", "-1:3", "a:b", "1:2:3"}) EXPECT_FALSE(parseRange(wrong).ok()) << wrong;
  EXPECT_EQ(*parseFrameList("20,0,10,10"), (std::vector<int>{0, 10, 20}));
  for (const char* wrong : {"", ",", "1,", "-1", "1 2"}) EXPECT_FALSE(parseFrameList(wrong).ok()) << wrong;
}

TEST(Options, exposureAndToneCurve) {
  EXPECT_EQ(parseExposure("-1.5")->ev, -1.5);
  EXPECT_TRUE(parseExposure("auto").ok());
  EXPECT_FALSE(parseExposure("auto")->ev);
  for (const char* wrong : {"", "bright", "1 2", "41", "-41", "nan", "inf", "1x"}) EXPECT_FALSE(parseExposure(wrong).ok()) << wrong;
  EXPECT_EQ(*parseName<ToneCurve>(kToneCurveNames)("uchimura"), ToneCurve::Uchimura);
  EXPECT_EQ(*parseName<Integrator>(kIntegratorNames)("simpson-3/8"), Integrator::Simpson38);
  for (const char* wrong : {"", "filmic", "ACES"}) EXPECT_FALSE(parseName<ToneCurve>(kToneCurveNames)(wrong).ok()) << wrong;

  // In place of the scene's and of every view's.
  Scene scene;
  scene.views["a"].exposure_ev = 3;
  View view = scene.views["a"];
  CommonOptions options;
  apply(options, scene);
  apply(options, view);
  EXPECT_EQ(view.exposure_ev, 3);
  options.exposure = Exposure{};
  apply(options, scene);
  apply(options, view);
  EXPECT_FALSE(scene.output.exposure_ev || scene.views["a"].exposure_ev || view.exposure_ev);
  options.exposure = Exposure{-2};
  options.toneCurve = ToneCurve::Lottes;
  apply(options, scene);
  EXPECT_EQ(scene.output.exposure_ev, -2);
  EXPECT_EQ(scene.output.toneCurve, ToneCurve::Lottes);
}

TEST(CommandLine, helpHasAnExampleEverywhere) {
  EXPECT_EQ(run({"--help"}).exit, 0);
  EXPECT_THAT(run({"--version"}).out, HasSubstr("welkin 0."));
  for (const char* command : {"render", "fly", "bench", "converge", "plan", "info", "compare", "probe"}) {
    const Ran r = run({command, "--help"});
    EXPECT_EQ(r.exit, 0) << command;
    EXPECT_THAT(r.out, HasSubstr(std::string("welkin ") + command)) << command;
    EXPECT_THAT(r.out, HasSubstr("Example")) << command;
    EXPECT_EQ(r.err, "");
  }
}

TEST(CommandLine, wrongUsageIsOneLineAndTwo) {
  expectUsageError(run({}));
  expectUsageError(run({"nonsense"}));
  expectUsageError(run({"render"}));
  expectUsageError(run({"render", "a.json", "-o", "a.txt"}));
  expectUsageError(run({"render", "a.json", "-o", "a.png", "--size", "0x10"}));
  expectUsageError(run({"render", "a.json", "-o", "a.png", "--size", "100000x10"}));
  expectUsageError(run({"render", "a.json", "-o", "a.png", "--budget", "lots"}));
  expectUsageError(run({"render", "a.json", "-o", "a.png", "--budget", "-1MiB"}));
  expectUsageError(run({"render", "a.json", "-o", "a.png", "--depth", "25"}));
  expectUsageError(run({"render", "a.json", "-o", "a.png", "--depth", "3x"}));
  expectUsageError(run({"render", "a.json", "-o", "a.png", "--step", "nan"}));
  expectUsageError(run({"render", "a.json", "-o", "a.png", "--step", "-1"}));
  expectUsageError(run({"render", "a.json", "-o", "a.png", "--seed", "4294967296"}));
  expectUsageError(run({"render", "a.json", "-o", "a.png", "--gpu", "fast"}));
  expectUsageError(run({"render", "a.json", "-o", "a.png", "--exposure", "bright"}));
  expectUsageError(run({"render", "a.json", "-o", "a.png", "--tone-curve", "film"}));
  expectUsageError(run({"render", "a.json", "-o", "a.png", "--unknown"}));
  expectUsageError(run({"fly", "a.json", "--frames", "9:3"}));
  expectUsageError(run({"fly", "a.json", "--every", "-1"}));
  expectUsageError(run({"compare", "a.png"}));
}

struct CommandLineFiles : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("welkin_cli_test_" + std::to_string(::getpid()));
  std::string scene = (folder / "scene.json").string(), path = (folder / "path.json").string();
  void SetUp() override {
    fs::create_directories(folder);
    Scene s;
    s.views["a"] = toView({0, 0, 1000, 0, 0, 0, 58, {}}, s.planet.radius_m);
    s.views["b"] = s.views["a"];
    ASSERT_TRUE(saveScene(s, scene).ok());
    FlightPath p;
    p.scene = scene;
    p.width = 64, p.height = 36;
    for (int i = 0; i < 25; ++i) p.frames.push_back({s.views["a"], i / 30.0});
    ASSERT_TRUE(savePath(p, path).ok());
  }
  void TearDown() override { fs::remove_all(folder); }
  std::string at(const char* name) const { return (folder / name).string(); }
  Ran render(const std::string& input, std::vector<const char*> more = {}) {
    const std::string out = at("out.png");
    std::vector<const char*> arguments{"render", input.c_str(), "-o", out.c_str()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(CommandLineFiles, badInputIsOneLineAndOne) {
  expectFailure(render(at("none.json")), "none.json: cannot be read");
  expectFailure(render(folder.string()), "found a folder");
  ASSERT_TRUE(writeFile(at("bad.json"), "{\"planet\": {\"radius_m\": -1}}").ok());
  expectFailure(render(at("bad.json")), "bad.json: /planet/radius_m: expected a number from 1");
  ASSERT_TRUE(writeFile(at("empty.json"), "{}").ok());
  expectFailure(render(at("empty.json")), "/views: expected at least one view");
  expectFailure(render(scene, {"--view", "c"}), "/views: expected one of: a, b, got c");
  EXPECT_FALSE(fs::exists(at("out.png")));
}

TEST_F(CommandLineFiles, foldersThatCannotBeWritten) {
  expectFailure(run({"render", scene.c_str(), "-o", "/proc/none/out.png"}), "/proc/none");
  expectFailure(run({"fly", path.c_str(), "--out", "/proc/none"}), "/proc/none");
  expectFailure(run({"fly", path.c_str(), "--out", folder.c_str(), "--json", "/proc/none/t.json"}), "/proc/none");
  expectFailure(run({"fly", path.c_str(), "--out", scene.c_str()}), "scene.json");  // a file is in the way
}

TEST_F(CommandLineFiles, flights) {
  expectFailure(run({"fly", path.c_str(), "--out", folder.c_str(), "--frames", "20:26"}), "expected --frames inside 0:25");
  expectFailure(run({"fly", path.c_str(), "--out", folder.c_str(), "--frames", "5:10", "--quality-frames", "4"}),
                "expected --quality-frames inside 5:10");
  expectFailure(run({"fly", scene.c_str(), "--out", folder.c_str()}), "unknown key");
  FlightOptions o;
  o.path = path;
  o.out = folder / "fly";
  auto plan = planFlight(o);
  ASSERT_TRUE(plan.ok()) << plan.error().message;
  EXPECT_EQ(plan->size.width, 64);
  EXPECT_EQ(plan->end, 25);
  EXPECT_EQ(plan->json, folder / "fly" / "timings.json");
  EXPECT_EQ(plan->every, 3);  // 25 frames, about a dozen pictures
  int pictures = 0;
  for (int i = plan->first; i < plan->end; ++i) pictures += pictureWanted(*plan, i);
  EXPECT_EQ(pictures, 9);  // 0, 3, ... 24
  EXPECT_TRUE(pictureWanted(*plan, 24));
  EXPECT_DOUBLE_EQ(plan->framesPerSecond, 30);
  EXPECT_NEAR(altitude_m(plan->path.frames[0].view, plan->scene.planet), 1000, 1e-8);  // an ulp of 6e6 is 9e-10
  o.every = 0;
  plan = planFlight(o);
  ASSERT_TRUE(plan.ok());
  EXPECT_FALSE(pictureWanted(*plan, 0));
}

TEST_F(CommandLineFiles, comparing) {
  Image8 a{4, 4, std::vector<std::uint8_t>(64, 255)}, b = a;
  b.rgba[0] = 0;
  ASSERT_TRUE(writePng(at("a.png"), a, {}).ok());
  ASSERT_TRUE(writePng(at("b.png"), b, {}).ok());
  ASSERT_TRUE(writePng(at("c.png"), Image8{2, 2, std::vector<std::uint8_t>(16, 255)}, {}).ok());
  const std::string pa = at("a.png"), pb = at("b.png"), pc = at("c.png"), difference = at("d.png"), json = at("c.json");
  const Ran r = run({"compare", pa.c_str(), pb.c_str(), "-o", difference.c_str(), "--json", json.c_str()});
  EXPECT_EQ(r.exit, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("rmse     36.8061"));  // 255 / sqrt(48)
  EXPECT_TRUE(readPicture(difference).ok());
  EXPECT_THAT(*readFile(json), HasSubstr("\"max_255\": 255.0"));
  expectFailure(run({"compare", pa.c_str(), pc.c_str()}), "expected pictures of one size, got 4x4 and 2x2");
  expectFailure(run({"compare", pa.c_str(), scene.c_str()}), "expected a PNG or EXR picture");
}

TEST_F(CommandLineFiles, planNeedsNoGl) {
  const Ran r = run({"plan", scene.c_str()});
  EXPECT_EQ(r.exit, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("no clouds in the scene"));
}

}  // namespace
}  // namespace welkin::app
