#pragma once
// What the pictures of the stability matrix show: scenes, and of each the views that go to an extreme along one axis.
#include <deque>
#include <string>
#include <vector>

#include "welkin/physics/scene.h"

namespace welkin::measure {

enum class ShotTruth {
  None,
  Ground,       // a bare ball's, closed form, every pixel
  SingleOrder,  // of clear air, by the reference, a few pixels
  SlabOpacity,  // 1 - exp(-extinction times the way through the shell), every pixel
  FineMarch,    // the same tree marched at a 32nd of the step by the default integrator
};

struct Shot {
  std::string axis;
  double value = 0;
  std::string variant;
  View view;
  ShotTruth truth = ShotTruth::None;
  std::vector<View> path;  // not empty: these frames are drawn one after another, nothing settles between them
  double sinceLast_s = 0;  // of each frame of the path
};

struct ShotStage {
  Scene scene;
  int width = 64, height = 36;
  std::vector<Shot> shots;
  bool everyIntegrator = false;  // else the scene's own
  bool leastBudget = false;      // the scene's budget is the least that works
};

std::deque<ShotStage> stressStages(bool quick);

}  // namespace welkin::measure
