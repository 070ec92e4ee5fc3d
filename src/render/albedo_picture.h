#pragma once
#include "welkin/render/composite/composite_pass.h"

namespace welkin {
// The scene's picture of the ground (PNG, beside the scene file). Fails in one line that names the file.
Result<AlbedoPicture> loadAlbedoPicture(const Scene& scene);
}  // namespace welkin
