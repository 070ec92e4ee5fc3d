#include "welkin/render/frame_plan.h"

#include <algorithm>

#include "welkin/clouds/opaque_deck.h"
#include "welkin/render/sky/sky_model.h"

namespace welkin {

const std::vector<std::string>& leftOutReasons() {
  static const std::vector<std::string> names{"no-clouds", "no-atmosphere", "no-sun",    "thin-air",     "smooth-air",
                                              "no-ground", "overcast",      "night",     "looking-away", "fixed-exposure",
                                              "no-aov",    "one-picture",   "one-layer", "sun-fixed",    "nothing-moves"};
  return names;
}

Scene sceneFor(const Scene& scene, const std::set<std::string>& forced) {
  Scene out = scene;
  if (forced.contains("no-clouds") && (!out.clouds || out.clouds->sources.empty())) out.clouds = Clouds{{SlabSource{1000, 2000, 0}}, true};
  if (forced.contains("no-sun") && !out.sun) out.sun = Sun{.irradiance = {0, 0, 0}};
  if (forced.contains("no-atmosphere") && (!out.atmosphere || out.atmosphere->layers.empty()))
    out.atmosphere = Atmosphere{100'000, "auto", {{"nothing", ExponentialProfile{8000}, {}, {}, PhaseType::Rayleigh, 0}}};
  if (forced.contains("thin-air") && out.atmosphere && out.atmosphere->model == "auto") out.atmosphere->model = "tables-4d";
  return out;
}

namespace {

// As LayeredClouds makes them: layers that the scene leaves to the program are many.
bool oneLayer(const Clouds& clouds) {
  const CloudSource& source = clouds.sources.front();
  if (std::holds_alternative<SlabSource>(source)) return true;
  const auto* layered = std::get_if<LayersSource>(&source);
  return layered && layered->layers.size() == 1 && !(layered->layers[0].typeLow < layered->layers[0].typeHigh);
}

}  // namespace

FramePlan planFrame(const Scene& given, const PlanFor& asked) {
  const Scene scene = sceneFor(given, asked.forced);
  FramePlan plan;
  // Says that something is left out; false where that is forced not to be.
  const auto leave = [&](const char* name, const char* what, const std::string& reason) {
    if (asked.forced.contains(name)) return false;
    plan.leftOut.push_back({what, reason, name});
    return true;
  };
  const auto& sun = scene.sun;
  plan.air = scene.atmosphere && !scene.atmosphere->layers.empty();
  plan.sun = sun && (asked.forced.contains("no-sun") ||
                     std::any_of(sun->irradiance.begin(), sun->irradiance.end(), [](double e) { return e > 0; }));
  plan.clouds = scene.clouds && !scene.clouds->sources.empty();
  const std::optional<LeftOut> unseen = nothingSeen(scene, asked);
  if (unseen) {
    plan.leftOut.push_back(*unseen);
    plan.air = plan.clouds = false;
    plan.ground = unseen->name == "night";
  } else {
    if (!plan.sun) leave("no-sun", "sun disc, shadow rays, light, sky tables", "no sun in the scene");
    if (!plan.air) leave("no-atmosphere", "sky tables, aerial perspective", "no atmosphere in the scene");
    if (!plan.clouds)
      leave("no-clouds", "octree, worker, brick pool, bricks, light, octree maps, march, reprojection", "no clouds in the scene");
    plan.air = plan.air && plan.sun;
  }

  const bool fixed = scene.output.exposure_ev || (asked.onePicture && asked.view && asked.view->exposure_ev);
  plan.metered = plan.sun && !fixed;
  if (!plan.metered)
    plan.metered = !leave("fixed-exposure", "metering, adaptation of the exposure",
                          plan.sun ? "the exposure is a number" : "no sun in the scene: nothing to adapt to");

  if (plan.air) {
    plan.passes.emplace_back("sky");
    if (const auto model = skyModel(scene)) {
      plan.skyModel = model->name, plan.skyReason = model->reason;
      if (scene.atmosphere->model == "auto" && !model->diffuse())
        leave("thin-air", "field of diffuse light", model->reason);
      else if (model->name == "tables-4d" && model->zonal <= 2)
        plan.everyHarmonic = !leave("smooth-air", "harmonics of diffuse light over degree 2", "no layer's phase function has them");
    }
  }

  const bool here = asked.onePicture && asked.view;
  if (!unseen && here && !sightOf(scene, *asked.view, asked.aspect).ground)
    plan.ground = !leave("no-ground", "picture of the ground, its light, shadow rays from it", "no ray of the view meets the ground");
  if (const auto deck = plan.clouds ? opaqueDeck(scene) : std::nullopt) {
    const double altitude_m = asked.view ? glm::length(asked.view->position_m) - scene.planet.radius_m : 0;
    const bool above = asked.view && altitude_m > deck->top_m && altitude_m < kDeckSeenFrom_m;
    if (above && leave("overcast", "ground and clouds below an opaque deck", "the camera is above a deck without a gap") && here)
      plan.ground = false;
  }

  if (plan.clouds && oneLayer(*scene.clouds))
    plan.oneLayer = leave("one-layer", "search among layers, type of the weather", "there is one layer of clouds, in any weather");

  plan.history = plan.clouds;
  if (plan.clouds && here)
    plan.history = !leave("one-picture", "reprojection: its programs, history, change and age of pixels", "one picture has none before it");
  plan.albedoMap = plan.ground && plan.sun && !unseen;
  plan.aux = plan.clouds && (plan.history || plan.air || (plan.ground && plan.sun));
  plan.linear = plan.metered || asked.linear;
  if (!plan.linear &&
      !leave("no-aov", plan.clouds && !plan.aux ? "linear picture; distance and shadow of clouds" : "linear picture", "nobody reads them"))
    plan.linear = true, plan.aux = plan.clouds;

  if (plan.sun && (plan.clouds || plan.air))
    plan.sunMayMove = !leave("sun-fixed", "light of bricks while the tree settles, what the sky's light was made with",
                             "nobody looks while the tree settles, and the air stays: light is made once");
  if (!asked.onePicture && !plan.metered)
    plan.redraw = !leave("nothing-moves", "every pass, while camera, tree and light are as in the last frame",
                         "nothing moves: the picture is the same");

  if (plan.clouds) {
    plan.passes.emplace_back("maps");
    if (plan.sun) plan.passes.emplace_back("light");
    if (plan.history) plan.passes.emplace_back("reproject");
    plan.passes.emplace_back("march");
  }
  plan.passes.emplace_back("composite");
  if (plan.metered) plan.passes.emplace_back("exposure");
  if (plan.clouds) plan.passes.emplace_back("bricks");
  return plan;
}

}  // namespace welkin
