#pragma once
// The cloud layers of an Earth, from the ground up.
#include <vector>

#include "welkin/physics/scene.h"

namespace welkin {
std::vector<CloudLayer> defaultEarthLayers();
}
