#pragma once
// The interface over the picture: a side bar of panels, a status line, messages, the keys.
#include "model.h"

namespace welkin::window {

void drawInterface(Model& model);

void cameraPanel(Model& model);
void scenePanel(Model& model);
void qualityPanel(Model& model);
void exposurePanel(Model& model);
void timePanel(Model& model);
void profilerPanel(Model& model);
void memoryPanel(Model& model);
void leftOutPanel(Model& model);
void logPanel(Model& model);
void debugPanel(Model& model);
void flightPanel(Model& model);
void resultsPanel(Model& model);

}  // namespace welkin::window
