#pragma once
// Scene files: JSON in, Scene out, and back. Every error is one line: file, JSON pointer (or line and column), what was expected.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/core/result.h"
#include "welkin/physics/scene.h"

namespace welkin {

// Reads and checks a scene file. Paths of data files come out absolute: relative ones start at the scene's folder.
Result<Scene> loadScene(const std::filesystem::path& file);
// The same from text. `sourceName` stands in messages; relative paths of data start at `baseFolder`.
Result<Scene> parseScene(std::string_view text, const std::string& sourceName, const std::filesystem::path& baseFolder = {});

// The whole scene as JSON that parseScene reads back to an equal scene (17 digits; views and sun in explicit form). Paths of data
// files are written relative to `baseFolder` if given, else as they are.
std::string sceneToJson(const Scene& scene, const std::filesystem::path& baseFolder = {}, int indent = 2);
Result<void> saveScene(const Scene& scene, const std::filesystem::path& file);

// One view alone, explicit form, for a picture's state. parseView checks it against the planet (not below the ground).
std::string viewToJson(const View& view);
Result<View> parseView(std::string_view text, const std::string& sourceName, const Planet& planet);

// Every file of data that the scene names, in a fixed order, without repeats.
std::vector<std::filesystem::path> dataFiles(const Scene& scene);
// Puts another path in the place of one that dataFiles() gave.
void replaceDataFile(Scene& scene, const std::filesystem::path& from, const std::filesystem::path& to);

// Where a person stands and looks. Latitude and longitude in degrees; altitude above the ground in metres; heading clockwise from
// north; pitch up; roll clockwise, as the picture sees it. Over a pole north is the limit along longitude_deg.
struct GeographicView {
  double latitude_deg = 0, longitude_deg = 0, altitude_m = 2;
  double heading_deg = 0, pitch_deg = 0, roll_deg = 0;
  double fov_deg = 58;
  std::optional<double> exposure_ev;
};
View toView(const GeographicView& view, double planetRadius_m);

constexpr std::uint64_t kMinBudget_bytes = 1ull << 20, kMaxBudget_bytes = 1ull << 40;  // what a scene or an option may ask for

// Unit vector from the planet's centre to a point of latitude and longitude, planet frame.
glm::dvec3 directionTo(double latitude_deg, double longitude_deg);

}  // namespace welkin
