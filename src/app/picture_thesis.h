#pragma once
// Pictures of the thesis program (Pettersson 2020, "Mulen"): five texts with its camera and times.
#include "welkin/app/picture.h"

namespace welkin::app {

bool isThesisPicture(const Texts& texts);
// Its camera over scenes/earth.json. Assumed: positions are metres from the planet's centre in axes taken as those of the planet frame, the
// orientation is planet from view, and the planet has the radius that the thesis states, 6371 km.
Result<PictureState> stateOfThesisPicture(const Texts& texts, const std::filesystem::path& picture);

}  // namespace welkin::app
