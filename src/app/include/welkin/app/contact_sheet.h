#pragma once
// Many pictures on one sheet, small, in rows from left to right.
#include <fmt/format.h>  // before shared headers, whose macro F its templates would meet

#include <vector>

#include "welkin/render/renderer.h"

namespace welkin::app {

// Average over each target pixel's area, in linear light. Sizes from 1.
Image8 scaled(const Image8& image, int width, int height);

// Thumbnails of `thumbWidth` (not larger than the picture), `columns` in a row, on dark grey. Empty for no pictures.
Image8 contactSheet(const std::vector<Image8>& pictures, int thumbWidth = 320, int columns = 4);

}  // namespace welkin::app
