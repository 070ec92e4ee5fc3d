// Dropping a file: what of ours comes back, and everything else is told in one line.
#include "welkin/app/restore.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

#include "welkin/app/checksum.h"
#include "welkin/app/places.h"
#include "welkin/core/files.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace {
namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

struct Restore : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("welkin_restore_test_" + std::to_string(::getpid()));
  void SetUp() override {
    for (const char* name : {"scenes", "data", "shots", "program/shaders", "program/data", "program/scenes", "far/away"}) {
      fs::create_directories(folder / name);
    }
    ASSERT_TRUE(writeFile(folder / "data" / "cover.png", "not really a picture").ok());
    scene.name = "test";
    scene.clouds.emplace();
    scene.clouds->sources.push_back(LayersSource{folder / "data" / "cover.png", {CloudLayer{}}});
    view = toView({12.3456789, -45.6, 1234.5, 200, -10, 3, 33.3, 2.5}, scene.planet.radius_m);
    scene.views["only"] = view;
    ASSERT_TRUE(saveScene(scene, folder / "scenes" / "a.json").ok());
    const PictureState state{scene, view, 7, 5, 0.1, true, 2.5, "welkin test", dataChecksums(scene), {}};
    texts = textsFromState(state, folder / "shots");
    ::setenv("WELKIN_SHADERS", (folder / "program/shaders").c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("WELKIN_SHADERS");
    fs::remove_all(folder);
  }
  fs::path shot(const fs::path& name, const Texts& with) const {
    EXPECT_TRUE(writePng(folder / name, Image8{7, 5, std::vector<std::uint8_t>(7 * 5 * 4, 255)}, with).ok());
    return folder / name;
  }
  Texts without(std::initializer_list<std::string> keys) const {
    Texts out = texts;
    std::erase_if(out, [&](const auto& entry) { return std::find(keys.begin(), keys.end(), entry.first) != keys.end(); });
    return out;
  }
  Scene scene;
  View view;
  Texts texts;
};

TEST_F(Restore, SceneShotAndPath) {
  auto restored = restoreFrom(folder / "scenes" / "a.json");
  ASSERT_TRUE(restored.ok()) << restored.error().message;
  EXPECT_EQ(restored->kind, RestoredKind::Scene);
  EXPECT_EQ(restored->start.viewName, "only");

  restored = restoreFrom(shot("shots/a.png", texts));
  ASSERT_TRUE(restored.ok()) << restored.error().message;
  EXPECT_EQ(restored->kind, RestoredKind::Picture);
  EXPECT_EQ(viewToJson(restored->start.view), viewToJson(view));
  EXPECT_THAT(restored->start.notes, IsEmpty());
  fs::rename(folder / "shots/a.png", folder / "shots/a.json");  // what counts is what is in it
  EXPECT_EQ(restoreFrom(folder / "shots/a.json")->kind, RestoredKind::Picture);

  FlightPath path;
  path.scene = folder / "scenes" / "a.json";
  path.frames = {{view, 3.5}, {view, 4}};
  path.width = 64;
  ASSERT_TRUE(savePath(path, folder / "p.json").ok());
  restored = restoreFrom(folder / "p.json");
  ASSERT_TRUE(restored.ok()) << restored.error().message;
  EXPECT_EQ(restored->kind, RestoredKind::Path);
  EXPECT_EQ(restored->path->frames.size(), 2u);
  EXPECT_EQ(restored->start.time_s, 3.5);
  EXPECT_EQ(restored->start.size.width, 64);
  EXPECT_EQ(restored->start.scene.name, "test");
}

TEST_F(Restore, AMovedShotFindsItsData) {
  const auto cover = [&](const fs::path& file) { return dataFiles(restoreFrom(file)->start.scene).at(0); };
  const fs::path moved = shot("far/away/a.png", texts);
  EXPECT_THAT(restoreFrom(moved).error().message, HasSubstr("missing data"));
  ASSERT_TRUE(writeFile(folder / "program/data/cover.png", "not really a picture").ok());
  EXPECT_EQ(cover(moved), folder / "program/data/cover.png");  // the program's own
  fs::create_directories(folder / "far/away/data");
  ASSERT_TRUE(writeFile(folder / "far/away/data/cover.png", "not really a picture").ok());
  EXPECT_EQ(cover(moved), folder / "far/away/data/cover.png");
  ASSERT_TRUE(writeFile(folder / "far/away/cover.png", "another of this name").ok());
  EXPECT_EQ(cover(moved), folder / "far/away/data/cover.png");  // not one with other contents
  ASSERT_TRUE(writeFile(folder / "far/away/cover.png", "not really a picture").ok());
  EXPECT_EQ(cover(moved), folder / "far/away/cover.png");                   // the picture's folder
  EXPECT_EQ(cover(shot("shots/b.png", texts)), folder / "data/cover.png");  // and where it says, first of all
}

TEST_F(Restore, AnOlderVersionsShotNotesWhatIsMissing) {
  auto restored = restoreFrom(shot("shots/a.png", without({"welkin:time_s", "welkin:converged", "welkin:build", "welkin:settings"})));
  ASSERT_TRUE(restored.ok()) << restored.error().message;
  EXPECT_EQ(viewToJson(restored->start.view), viewToJson(view));
  EXPECT_EQ(restored->start.size.width, 7);  // the picture's own
  EXPECT_EQ(restored->start.exposure_ev, 2.5);
  const auto says = [&](const std::string& what) { return StartsWith((folder / "shots/a.png: ").string() + what + " is missing: "); };
  EXPECT_THAT(restored->start.notes, ElementsAre(says("welkin:settings: /width or /height"), says("welkin:settings: /exposure_ev"),
                                                 says("welkin:time_s"), says("welkin:build"), says("welkin:converged")));
  // Data files without checksums are looked for all the same.
  ASSERT_TRUE(writeFile(folder / "program/data/cover.png", "of any contents").ok());
  restored = restoreFrom(shot("far/away/b.png", without({"welkin:data"})));
  ASSERT_TRUE(restored.ok()) << restored.error().message;
  EXPECT_EQ(dataFiles(restored->start.scene).at(0), folder / "program/data/cover.png");
  EXPECT_THAT(restored->start.notes, ElementsAre(HasSubstr("data files are not checked")));
  // A scene of an older version has fewer keys, each with its default.
  Texts old = texts;
  old[0].second = R"({"planet": {"radius_m": 6371000}})";
  EXPECT_TRUE(restoreFrom(shot("shots/c.png", old)).ok());
}

TEST_F(Restore, TheThesisProgramsShots) {
  ASSERT_TRUE(saveScene(scene, folder / "program/scenes/earth.json").ok());
  const Texts theirs{{"mulen_camera_position", "4500000.25 -3000000.5 3400000.125"},
                     {"mulen_camera_orientation", "0.5 -0.5 0.5 0.5"},
                     {"mulen_camera_fovy", "0.78539816339744831"},
                     {"mulen_atmosphere_light_time", "12.5"},
                     {"mulen_atmosphere_animation_time", "7.25"}};
  auto restored = restoreFrom(shot("shots/a.png", theirs));
  ASSERT_TRUE(restored.ok()) << restored.error().message;
  const View& v = restored->start.view;
  EXPECT_EQ(v.position_m, glm::dvec3(4500000.25, -3000000.5, 3400000.125));
  EXPECT_EQ(v.orientation, glm::dquat(0.5, 0.5, -0.5, 0.5));
  EXPECT_NEAR(v.fov_deg, 45, 1e-12);
  EXPECT_EQ(restored->start.time_s, 7.25);
  EXPECT_EQ(restored->start.scene.planet.radius_m, 6'371'000);
  EXPECT_THAT(restored->start.notes, ElementsAre(HasSubstr("thesis"), HasSubstr("light_time is left out")));

  const auto with = [&](std::size_t i, const char* text) {
    Texts t = theirs;
    t[i].second = text;
    return restoreFrom(shot("shots/b.png", t));
  };
  for (const char* bad : {"", "1 2", "1 2 3 4", "a b c", "0 0 0", "nan 0 0", "1e400 0 0"}) {
    EXPECT_THAT(with(0, bad).error().message, HasSubstr("mulen_camera_position: expected")) << bad;
  }
  EXPECT_FALSE(with(1, "0 0 0 0").ok());
  EXPECT_FALSE(with(2, "4").ok());
  EXPECT_FALSE(with(4, "soon").ok());
  restored = with(0, "0 0 6371000.9");  // on the ground is not below it
  EXPECT_EQ(restored->start.view.position_m.z, 6371000.9);
  EXPECT_THAT(with(0, "0 0 6000000")->start.notes, testing::Contains(HasSubstr("below the ground")));
  EXPECT_THAT(restoreFrom(shot("shots/c.png", {theirs[0]}))->start.notes.size(), 3u);
}

TEST_F(Restore, AnythingElseIsOneLine) {
  const auto put = [&](const std::string& name, std::string_view bytes) {
    EXPECT_TRUE(writeFile(folder / name, bytes).ok());
    return folder / name;
  };
  const std::string png = *readFile(shot("shots/a.png", texts)), scene_ = *readFile(folder / "scenes/a.json");
  std::string flipped = png;
  flipped[flipped.size() / 2] ^= 0x40;
  FlightPath path;
  path.scene = folder / "nowhere.json";
  path.frames = {{view, 0}};
  ASSERT_TRUE(savePath(path, folder / "lost.json").ok());
  path.scene = folder / "scenes" / "a.json";
  path.frames[0].view.position_m *= 0.1;
  ASSERT_TRUE(savePath(path, folder / "below.json").ok());
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  const fs::path huge = put("huge.json", "{");
  fs::resize_file(huge, 3ull << 30);  // takes no room on the disc
  fs::create_symlink(folder / "loop", folder / "loop");

  const std::pair<fs::path, std::string> bad[] = {
      {folder, "found a folder"},
      {folder / "none.png", "there is no such file"},
      {folder / "loop", "expected"},
      {folder / "pipe", "expected a plain file"},
      {"/dev/null", "expected a plain file"},
      {put("empty.png", ""), "expected a picture"},
      {put("line\nbreak.txt", "hello"), "expected a picture"},
      {put("photo.jpg", "\xff\xd8\xff\xe0 JFIF"), "expected a picture"},
      {put("list.json", "[1, 2]"), "expected a picture"},
      {put("cut.json", scene_.substr(0, scene_.size() / 2)), "line "},
      {put("newer.json", R"({"rings": {}})"), "unknown key"},
      {put("blind.json", "{}"), "/views: expected at least one view"},
      {put("frames.json", R"({"frames": 5})"), "expected the key \"scene\""},
      {folder / "lost.json", "/scene: "},
      {folder / "below.json", "/frames/0/position_m: expected a position above the ground"},
      {huge, "expected at most"},
      {put("cut.png", png.substr(0, png.size() / 2)), "expected a whole PNG"},
      {put("magic.png", png.substr(0, 8)), "expected a whole PNG"},
      {put("magic.exr", "\x76\x2f\x31\x01 and no more"), "expected a whole EXR"},
      {put("flipped.png", flipped), "expected a whole PNG"},
      {shot("foreign.png", {{"Software", "a camera"}}), "not a picture of this program"},
      {shot("viewless.png", without({"welkin:view"})), "expected the text \"welkin:view\""},
      {shot("far/away/moved.png", texts), "missing data"},
  };
  for (const auto& [file, what] : bad) {
    const auto restored = restoreFrom(file);
    ASSERT_FALSE(restored.ok()) << file;
    EXPECT_THAT(restored.error().message, HasSubstr(what)) << file;
    EXPECT_EQ(restored.error().message.find('\n'), std::string::npos) << restored.error().message;
    EXPECT_LT(restored.error().message.size(), 2000u);
  }
}

}  // namespace
}  // namespace welkin::app
