#include "welkin/render/frame_plan.h"

#include <cmath>

#include "welkin/physics/air.h"
#include "welkin/render/sky/sky_model.h"

namespace welkin {

FramePlan planFrame(const Scene& scene) {
  FramePlan plan;
  plan.air = scene.atmosphere && !scene.atmosphere->layers.empty();
  plan.sun = scene.sun && (scene.sun->irradiance[0] > 0 || scene.sun->irradiance[1] > 0 || scene.sun->irradiance[2] > 0);
  plan.clouds = scene.clouds && !scene.clouds->sources.empty();
  if (plan.air && !plan.sun) {
    plan.air = false;
    plan.leftOut.push_back({"sky tables, aerial perspective", "no sun: the air has no light to scatter"});
  } else if (!plan.air) {
    plan.leftOut.push_back({"sky tables, aerial perspective", "no atmosphere in the scene"});
  }
  if (!plan.sun) plan.leftOut.push_back({"sun disc, shadow rays", "no sun in the scene"});
  if (!plan.clouds) plan.leftOut.push_back({"octree, worker, brick pool, bricks, light, octree maps, march, reprojection", "no clouds in the scene"});
  plan.metered = plan.sun && !scene.output.exposure_ev;
  if (!plan.metered)
    plan.leftOut.push_back({"metering, adaptation of the exposure", plan.sun ? "the scene's exposure is a number" : "no sun in the scene: nothing to adapt to"});
  if (plan.air) {
    plan.passes.emplace_back("sky");
    if (airTop_m(scene) < scene.atmosphere->top_m)
      plan.leftOut.push_back({"air above " + std::to_string(std::lround(airTop_m(scene) / 1000)) + " km", "the longest path through it has an optical depth below 1e-8"});
    if (const auto model = skyModel(scene)) {
      plan.skyModel = model->name, plan.skyReason = model->reason;
      if (!model->diffuse())
        plan.leftOut.push_back({"field of diffuse light", model->reason});
      else if (model->zonal <= 2)
        plan.leftOut.push_back({"harmonics of diffuse light over degree 2", model->name == "tables-2d" ? "tables-2d has none" : "no layer's phase function has them"});
    }
  }
  if (plan.clouds) {
    plan.passes.emplace_back("maps");
    if (plan.sun) plan.passes.emplace_back("light");
    plan.passes.insert(plan.passes.end(), {"reproject", "march"});
  }
  plan.passes.emplace_back("composite");
  if (plan.metered) plan.passes.emplace_back("exposure");
  if (plan.clouds) plan.passes.emplace_back("bricks");
  return plan;
}

}  // namespace welkin
