#pragma once
// SHA-256 of files of data, so that a picture knows what it was made from.
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "welkin/core/result.h"
#include "welkin/physics/scene.h"

namespace welkin::app {

std::string sha256(std::string_view bytes);                         // 64 lower-case hexadecimal digits
Result<std::string> sha256File(const std::filesystem::path& file);  // one line if it cannot be read

constexpr const char* kMissing = "missing";  // stands in place of a checksum when the file was not there
// Every data file of the scene with its checksum or kMissing.
std::map<std::filesystem::path, std::string> dataChecksums(const Scene& scene);

}  // namespace welkin::app
