#pragma once
// Pictures that carry what they show: everything needed to draw them again stands in PNG text chunks or EXR attributes
// (docs/files.md lists them).
#include <fmt/format.h>  // before shared headers, whose macro F its templates would meet

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "welkin/core/result.h"
#include "welkin/physics/scene.h"
#include "welkin/render/renderer.h"

namespace welkin::app {

// How a picture was made. The scene holds budget, depth, step, detail and seed as they were used.
struct PictureState {
  Scene scene;
  View view;
  int width = 0, height = 0;
  double time_s = 0;
  bool converged = false;
  double exposure_ev = 0;  // of the tone-mapped picture; an EXR is linear, before exposure
  std::string build;
  std::map<std::filesystem::path, std::string> data;  // data file -> sha256 or kMissing
  std::vector<std::string> notes;                     // one line for each text that was missing and what stands in its place
  DebugView debug = DebugView::None;                  // shown in its false colours
};

using Texts = std::vector<std::pair<std::string, std::string>>;  // "welkin:scene" -> ...

// The thesis program's pictures carry its camera under keys that begin so.
constexpr const char* kThesisKeys = "mulen_";

// State as texts and back. Data files are written relative to `folder`, the picture's. An older version's picture may lack anything but the
// scene and the view: what is missing is noted, and of the thesis program's pictures everything but the camera.
Texts textsFromState(const PictureState& state, const std::filesystem::path& folder);
Result<PictureState> stateFromTexts(const Texts& texts, const std::filesystem::path& picture);

// Every data file of the state must be there with the same contents. Pictures move: a file is looked for where the picture says, in the
// picture's folder and its data/, below the working folder, and in the program's own data/; the scene is corrected. The error names the
// first file that is missing or different.
Result<void> findData(PictureState& state, const std::filesystem::path& picture);

Result<std::string> pngBytes(const Image8& image, const Texts& texts);  // what writePng writes

// All or nothing: a temporary beside the file, then a rename. `texts` may be empty.
Result<void> writePng(const std::filesystem::path& file, const Image8& image, const Texts& texts);
Result<void> writeExr(const std::filesystem::path& file, const ImageF& image, const Texts& texts);  // half, ZIP, linear R G B A

struct PictureFile {
  std::variant<Image8, ImageF> pixels;
  Texts texts;  // those of Welkin and of the thesis program only
};
enum class PictureKind { None, Png, Exr };
PictureKind kindOfBytes(std::string_view head);                      // by the first bytes
PictureKind kindOfName(const std::filesystem::path& file);           // by the extension, for writing
Result<PictureFile> readPicture(const std::filesystem::path& file);  // one line for anything that is not a whole PNG or EXR
Result<PictureFile> readPng(const std::filesystem::path& file);
Result<PictureFile> readExr(const std::filesystem::path& file);

}  // namespace welkin::app
