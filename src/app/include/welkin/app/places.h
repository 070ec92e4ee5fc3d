#pragma once
// Where the program finds what came with it and keeps what belongs to its user, and names of files that are not taken.
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "welkin/core/result.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {

// Holds scenes/ and data/: the source tree, or share/welkin of an installation.
std::filesystem::path programFolder();

// $XDG_CONFIG_HOME/welkin, else ~/.config/welkin (XDG Base Directory Specification 0.8: a relative value does not count). Empty: there
// is no home.
std::filesystem::path configFolder();

// "welkin-2026-11-22-1432-07N-011E-9km": date, whole degrees, altitude above the ground.
std::string shotName(const std::tm& when, const GeographicView& where);
std::tm localNow();

// The first of folder/stem, folder/stem-2, … for which none of the extensions (".png") is taken, as a path without extension. Its files are
// there, empty, when it returns, so that no one else gets the name: write over them, or remove them. Makes the folder.
Result<std::filesystem::path> reserveFiles(const std::filesystem::path& folder, const std::string& stem,
                                           const std::vector<std::string>& extensions);

}  // namespace welkin::app
