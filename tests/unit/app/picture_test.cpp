// Pictures carry their state, and anything that is not such a picture is told in one line.
#include "welkin/app/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "welkin/app/checksum.h"
#include "welkin/app/contact_sheet.h"
#include "welkin/app/options.h"
#include "welkin/core/files.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace {
namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

struct Pictures : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("welkin_picture_test_" + std::to_string(::getpid()));
  void SetUp() override {
    fs::create_directories(folder / "data");
    fs::create_directories(folder / "shots");
    ASSERT_TRUE(writeFile(folder / "data" / "cover.png", "not really a picture").ok());
  }
  void TearDown() override { fs::remove_all(folder); }

  PictureState state() const {
    PictureState s;
    s.scene.name = "caf\xc3\xa9";  // not ASCII: goes into an iTXt chunk
    s.scene.clouds.emplace();
    s.scene.clouds->sources.push_back(LayersSource{folder / "data" / "cover.png", {CloudLayer{}}});
    s.scene.quality.seed = 77;
    s.scene.quality.budget_bytes = 100 << 20;
    s.view = toView({12.3456789, -45.6, 1234.5, 200, -10, 3, 33.3, 2.5}, s.scene.planet.radius_m);
    s.width = 7;
    s.height = 5;
    s.time_s = 0.1;
    s.converged = true;
    s.exposure_ev = 2.5;
    s.build = "welkin test";
    s.data = dataChecksums(s.scene);
    return s;
  }
  static Image8 image() {
    Image8 i{7, 5, std::vector<std::uint8_t>(7 * 5 * 4, 255)};
    for (std::size_t p = 0; p < i.rgba.size(); ++p) i.rgba[p] = p % 4 == 3 ? 255 : std::uint8_t(p * 7);
    return i;
  }
  static ImageF radiance() {
    ImageF i{7, 5, std::vector<float>(7 * 5 * 4)};
    for (std::size_t p = 0; p < i.rgba.size(); ++p) i.rgba[p] = float(p) / 64;  // exact in half
    return i;
  }
  void expectSame(const PictureState& a, const PictureState& b) const {
    EXPECT_EQ(sceneToJson(a.scene), sceneToJson(b.scene));
    EXPECT_EQ(viewToJson(a.view), viewToJson(b.view));
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.time_s, b.time_s);
    EXPECT_EQ(a.converged, b.converged);
    EXPECT_EQ(a.exposure_ev, b.exposure_ev);
    EXPECT_EQ(a.debug, b.debug);
    EXPECT_EQ(a.build, b.build);
    EXPECT_EQ(a.data, b.data);
  }
};

TEST(Checksum, knownValues) {  // FIPS 180-2, appendix B
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST_F(Pictures, checksumOfAFile) {
  EXPECT_EQ(*sha256File(folder / "data" / "cover.png"), sha256("not really a picture"));
  EXPECT_FALSE(sha256File(folder).ok());
  EXPECT_FALSE(sha256File(folder / "none").ok());
}

TEST_F(Pictures, pngKeepsPixelsAndState) {
  const auto file = folder / "shots" / "a.png";
  ASSERT_TRUE(writePng(file, image(), textsFromState(state(), folder / "shots")).ok());
  auto picture = readPicture(file);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  EXPECT_EQ(std::get<Image8>(picture->pixels).rgba, image().rgba);
  auto back = stateFromTexts(picture->texts, file);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_TRUE(findData(*back, file).ok());
  expectSame(*back, state());
  EXPECT_THAT(*readFile(file), HasSubstr("\"../data/cover.png\""));  // relative, so a checkout can move
  EXPECT_THAT(*readFile(file), Not(HasSubstr(folder.string())));     // and no path of this machine
}

TEST_F(Pictures, aDebugViewIsNamed) {
  PictureState s = state();
  for (const auto& [key, text] : textsFromState(s, folder)) EXPECT_NE(key, "welkin:debug") << text;
  s.debug = DebugView::History;
  Texts texts = textsFromState(s, folder);
  EXPECT_EQ(texts.back(), (Texts::value_type{"welkin:debug", "history"}));
  auto back = stateFromTexts(texts, folder / "a.png");
  ASSERT_TRUE(back.ok()) << back.error().message;
  expectSame(*back, s);
  const auto file = folder / "debug.png";
  ASSERT_TRUE(writePng(file, image(), textsFromState(s, folder)).ok());
  const auto start = loadStart(file, "");
  ASSERT_TRUE(start.ok()) << start.error().message;
  EXPECT_EQ(start->debug, DebugView::History) << "the window shows it again";
  texts.back().second = "a view of a later version";
  back = stateFromTexts(texts, folder / "a.png");
  ASSERT_TRUE(back.ok()) << back.error().message;
  expectSame(*back, state());
  EXPECT_THAT(back->notes, ElementsAre(HasSubstr("welkin:debug")));
}

TEST_F(Pictures, exrKeepsPixelsAndState) {
  const auto file = folder / "shots" / "a.exr";
  ASSERT_TRUE(writeExr(file, radiance(), textsFromState(state(), folder / "shots")).ok());
  auto picture = readPicture(file);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  EXPECT_EQ(std::get<ImageF>(picture->pixels).rgba, radiance().rgba);
  auto back = stateFromTexts(picture->texts, file);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_TRUE(findData(*back, file).ok());
  expectSame(*back, state());
}

TEST_F(Pictures, startFromAPicture) {
  const auto file = folder / "shots" / "a.png";
  ASSERT_TRUE(writePng(file, image(), textsFromState(state(), folder / "shots")).ok());
  auto start = loadStart(file, "");
  ASSERT_TRUE(start.ok()) << start.error().message;
  EXPECT_EQ(start->size.width, 7);
  EXPECT_EQ(start->scene.quality.seed, 77u);
  EXPECT_EQ(start->view.position_m, state().view.position_m);
}

TEST_F(Pictures, missingAndChangedDataAreNamed) {
  const auto file = folder / "shots" / "a.png";
  ASSERT_TRUE(writePng(file, image(), textsFromState(state(), folder / "shots")).ok());
  ASSERT_TRUE(writeFile(folder / "data" / "cover.png", "changed").ok());
  EXPECT_THAT(loadStart(file, "").error().message, HasSubstr("cover.png has changed: expected sha256"));
  fs::remove(folder / "data" / "cover.png");
  const auto missing = loadStart(file, "");
  ASSERT_FALSE(missing.ok());
  EXPECT_THAT(missing.error().message,
              StartsWith(file.string() + ": welkin:data: missing data: " + (folder / "data" / "cover.png").string()));
  EXPECT_EQ(missing.error().message.find('\n'), std::string::npos);
}

TEST_F(Pictures, drawnWithoutDataStaysWithout) {
  PictureState s = state();
  fs::remove(folder / "data" / "cover.png");
  s.data = dataChecksums(s.scene);
  EXPECT_EQ(s.data.begin()->second, kMissing);
  const auto file = folder / "shots" / "a.png";
  ASSERT_TRUE(writePng(file, image(), textsFromState(s, folder / "shots")).ok());
  ASSERT_TRUE(loadStart(file, "").ok());
  ASSERT_TRUE(writeFile(folder / "data" / "cover.png", "there now").ok());
  auto start = loadStart(file, "");
  ASSERT_TRUE(start.ok());
  EXPECT_TRUE(dataFiles(start->scene).empty());
}

TEST_F(Pictures, movedPicturesFindDataBelowTheWorkingFolder) {
  const auto before = fs::current_path();
  fs::create_directories(folder / "elsewhere" / "deep");
  const auto file = folder / "elsewhere" / "deep" / "a.png";
  ASSERT_TRUE(writePng(file, image(), textsFromState(state(), folder / "shots")).ok());
  fs::current_path(folder);
  auto start = loadStart(file, "");
  fs::current_path(before);
  ASSERT_TRUE(start.ok()) << start.error().message;
  EXPECT_TRUE(fs::exists(dataFiles(start->scene).at(0)));
}

TEST_F(Pictures, foreignPictures) {
  const auto file = folder / "foreign.png";
  ASSERT_TRUE(writePng(file, image(), {}).ok());
  EXPECT_EQ(loadStart(file, "").error().message, file.string() + ": not a picture of this program: expected the text \"welkin:scene\"");
  Texts texts = textsFromState(state(), folder);
  for (auto& [key, text] : texts) {
    if (key == "welkin:settings") text = R"({"width": 100000, "height": 5, "exposure_ev": 0})";
  }
  ASSERT_TRUE(writePng(file, image(), texts).ok());
  EXPECT_THAT(loadStart(file, "").error().message, HasSubstr("welkin:settings: /width: expected a whole number from 1 to 16384"));
  texts[0].second = "{\"planet\": {\"radius_m\": -1}}";
  ASSERT_TRUE(writePng(file, image(), texts).ok());
  EXPECT_THAT(loadStart(file, "").error().message, StartsWith(file.string() + ": welkin:scene: /planet/radius_m: expected"));
}

// Every length, and a flip of every byte: a picture or one line, never a crash.
void tearApart(const fs::path& file, const fs::path& broken) {
  const std::string whole = *readFile(file);
  const auto check = [&](const std::string& bytes) {
    std::ofstream(broken, std::ios::binary) << bytes;
    auto picture = readPicture(broken);
    if (picture.ok()) {
      if (auto state = stateFromTexts(picture->texts, broken); state.ok()) return;
      picture = Error{stateFromTexts(picture->texts, broken).error().message};
    }
    EXPECT_THAT(picture.error().message, StartsWith(broken.string() + ": "));
    EXPECT_EQ(picture.error().message.find('\n'), std::string::npos) << picture.error().message;
  };
  const std::size_t stride = std::max<std::size_t>(1, whole.size() / 1000);  // a second or two
  for (std::size_t n = 0; n < whole.size(); n += stride) check(whole.substr(0, n));
  for (std::size_t i = 0; i < whole.size(); i += stride) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ 0xff);
    check(flipped);
  }
}

TEST_F(Pictures, brokenPngs) {
  ASSERT_TRUE(writePng(folder / "a.png", image(), textsFromState(state(), folder)).ok());
  tearApart(folder / "a.png", folder / "broken.png");
}

TEST_F(Pictures, brokenExrs) {
  ASSERT_TRUE(writeExr(folder / "a.exr", radiance(), textsFromState(state(), folder)).ok());
  tearApart(folder / "a.exr", folder / "broken.exr");
}

TEST_F(Pictures, aPngThatClaimsToBeHuge) {
  ASSERT_TRUE(writePng(folder / "a.png", image(), {}).ok());
  std::string bytes = *readFile(folder / "a.png");
  bytes[16] = 0x7f;  // first byte of the width in IHDR; the checksum of the chunk is wrong then too
  ASSERT_TRUE(writeFile(folder / "b.png", bytes).ok());
  EXPECT_FALSE(readPicture(folder / "b.png").ok());
}

TEST_F(Pictures, placesThatCannotBeWritten) {
  EXPECT_FALSE(writePng(folder / "none" / "a.png", image(), {}).ok());
  const auto exr = writeExr(folder / "none" / "a.exr", radiance(), {});
  ASSERT_FALSE(exr.ok());
  EXPECT_EQ(exr.error().message.find('\n'), std::string::npos);
}

TEST(ContactSheet, averagesAndPlaces) {
  Image8 a{4, 2, std::vector<std::uint8_t>(32, 200)};
  const Image8 small = scaled(a, 2, 1);
  EXPECT_EQ(small.rgba, (std::vector<std::uint8_t>{200, 200, 200, 255, 200, 200, 200, 255}));  // a constant stays one
  Image8 halves{2, 1, {0, 0, 0, 255, 255, 255, 255, 255}};
  EXPECT_EQ(scaled(halves, 1, 1).rgba[0], 186);  // half the light: 255 * 0.5^(1/2.2)
  const SheetPicture p{a, {}};
  const Image8 sheet = contactSheet({p, p, p, p, p}, 4, 4);
  EXPECT_EQ(sheet.width, 6 + 4 * 10);
  EXPECT_EQ(sheet.height, 6 + 2 * (8 + 24));  // a strip for the caption under each row
  EXPECT_EQ(sheet.rgba[0], 24);
  EXPECT_EQ(sheet.rgba[std::size_t(4 * (6 * sheet.width + 6))], 200);
  EXPECT_TRUE(contactSheet({}).rgba.empty());
}

TEST(ContactSheet, captionsStayUnderTheirPicture) {
  const Image8 black{100, 50, std::vector<std::uint8_t>(100 * 50 * 4, 0)};
  const Image8 plain = contactSheet({{black, ""}, {black, ""}}, 100, 2);
  const Image8 sheet = contactSheet({{black, "frame 7"}, {black, std::string(500, 'W')}}, 100, 2);
  ASSERT_EQ(sheet.rgba.size(), plain.rgba.size());
  int left = 0, right = 0, elsewhere = 0;
  for (int y = 0; y < sheet.height; ++y) {
    for (int x = 0; x < sheet.width; ++x) {
      const auto at = std::size_t(y * sheet.width + x) * 4;
      if (sheet.rgba[at] == plain.rgba[at]) continue;
      const bool under = y >= 6 + 50;
      (under && x >= 6 && x < 106 ? left : under && x >= 112 && x < 212 ? right : elsewhere) += 1;
    }
  }
  EXPECT_GT(left, 100);  // seven letters of more than four font pixels of 2 x 2 each
  EXPECT_GT(right, left);
  EXPECT_EQ(elsewhere, 0);
}

}  // namespace
}  // namespace welkin::app
