#pragma once
// Fields of diffuse light on disk (core/cache.h), so that a scene's second start does not make them again.
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "welkin/render/sky/sky_model.h"
#include "welkin/shared/air.glsl.h"

namespace welkin {

constexpr std::size_t kCachedFields = 64;  // of half a megabyte

// Everything that the field depends on: parameters without the sun's irradiance and place, the model's numbers, the text of the shaders and
// the GL that runs them.
std::string fieldKey(const shared::AirBlock& air, const SkyModel& model, const std::string& shaders, const std::string& renderer);

// Nothing if there is none, or the file is not whole: then it is made again.
std::optional<std::vector<glm::vec4>> loadField(const std::string& key, std::size_t count);
// A folder that cannot be written is no error.
void saveField(const std::string& key, const std::vector<glm::vec4>& field);

}  // namespace welkin
