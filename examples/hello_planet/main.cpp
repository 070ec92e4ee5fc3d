// Opens a scene, moves a camera down to the ground, gets pixels: writes hello_0.ppm, hello_1.ppm, hello_2.ppm.
#include <cstdio>
#include <fstream>
#include <string>

#include "welkin/physics/scene_io.h"
#include "welkin/render/renderer.h"

template <class T>
T orExit(welkin::Result<T> result) {  // the value, or the one line that says what went wrong
  if (result) return std::move(*result);
  std::fprintf(stderr, "hello_planet: %s\n", result.error().message.c_str());
  std::exit(1);
}

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: hello_planet SCENE.json\n"), 2;
  const welkin::Scene scene = orExit(welkin::loadScene(argv[1]));
  const auto context = orExit(welkin::gpu::Context::createHeadless());
  const auto renderer = orExit(welkin::Renderer::create(*context, scene, {.width = 160, .height = 90}));

  int n = 0;
  for (const double altitude_m : {400e3, 9e3, 2.0}) {
    const welkin::View view = welkin::toView(
        {.latitude_deg = -33.5, .longitude_deg = -28, .altitude_m = altitude_m, .heading_deg = 330, .pitch_deg = altitude_m > 1e5 ? -25.0 : 0.0},
        scene.planet.radius_m);
    renderer->settle(view);                                  // all the detail that the budget allows
    renderer->frame(view, welkin::FrameMode::Full);          // every pixel
    const welkin::Image8 image = renderer->image();          // RGBA, top row first
    std::ofstream file("hello_" + std::to_string(n++) + ".ppm", std::ios::binary);
    file << "P6 " << image.width << ' ' << image.height << " 255\n";
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) file.write(reinterpret_cast<const char*>(&image.rgba[i]), 3);
    if (!file.flush()) return std::fprintf(stderr, "hello_planet: cannot write the picture\n"), 1;
  }
}
