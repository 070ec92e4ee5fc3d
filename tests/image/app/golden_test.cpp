// Pictures of a scene of their own (tests/image/scene.json: made-up weather, its layers written out, no data file) against committed
// ones. WELKIN_UPDATE_GOLDENS=1 writes them anew: look at every one before committing it.
#include <cstdio>
#include <filesystem>

#include "gl_fixture.h"
#include "welkin/app/draw.h"
#include "welkin/app/picture.h"
#include "welkin/measure/image_compare.h"
#include "welkin/physics/scene_io.h"

namespace welkin {
namespace {
namespace fs = std::filesystem;
using Goldens = test::GlTest;

const fs::path kFolder = fs::path(WELKIN_SOURCE_DIR) / "tests/image";

TEST_F(Goldens, EveryViewLooksAsItDid) {
  const auto scene = loadScene(kFolder / "scene.json");
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  ASSERT_GE(scene->views.size(), 6u);
  const bool update = std::getenv("WELKIN_UPDATE_GOLDENS") != nullptr;
  auto made = Renderer::create(*context, *scene, {.width = 160, .height = 90, .timing = false});
  ASSERT_TRUE(made.ok()) << made.error().message;
  Renderer& renderer = **made;
  EXPECT_TRUE(renderer.notes().empty()) << renderer.notes().front();
  for (const auto& [name, view] : scene->views) {
    const auto stats = app::drawConverged(renderer, view);
    ASSERT_TRUE(stats.ok()) << name;
    EXPECT_EQ(stats->counters.nanPixels, 0u) << name;
    const Image8 image = renderer.image();
    const fs::path golden = kFolder / "golden" / (name + ".png");
    if (update) {
      ASSERT_TRUE(app::writePng(golden, image, {}).ok());
      continue;
    }
    const auto kept = app::readPng(golden);
    ASSERT_TRUE(kept.ok()) << kept.error().message;
    const auto* picture = std::get_if<Image8>(&kept->pixels);
    ASSERT_NE(picture, nullptr) << golden;
    const auto error = measure::compare(*picture, image);
    ASSERT_TRUE(error.ok()) << name << ": " << error.error().message;
    std::printf("%-10s RMSE %.3f, greatest %.0f of 255, over 2: %.5f, over 16: %.5f\n", name.c_str(), error->rmse_255, error->max_255,
                error->shareOver2, error->shareOver16);
    // On one machine the pictures are equal to the byte. The margin is for other CPUs and drivers: their exp and 1/x differ in the last
    // bits, which moves a tone by 1, and one sample more or less at a cloud's edge moves a pixel by more, but few of them.
    const bool same = error->shareOver2 <= 0.001 && error->shareOver16 == 0;
    EXPECT_TRUE(same) << name << ": 2/255 on 99.9 % of pixels, none over 16/255";
    if (same) continue;
    const fs::path drawn = fs::temp_directory_path() / ("welkin_golden_" + name + ".png");
    EXPECT_TRUE(app::writePng(drawn, image, {}).ok());
    std::printf("drawn now: %s\n", drawn.c_str());
  }
  // No picture without its view.
  for (const auto& entry : fs::directory_iterator(kFolder / "golden"))
    EXPECT_TRUE(scene->views.contains(entry.path().stem().string())) << entry.path() << " belongs to no view";
}

}  // namespace
}  // namespace welkin
