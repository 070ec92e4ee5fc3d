#pragma once
// Many pictures on one sheet, small, in rows from left to right, each with a line of text under it.
#include <fmt/format.h>  // before shared headers, whose macro F its templates would meet

#include <string>
#include <vector>

#include "welkin/render/renderer.h"

namespace welkin::app {

// Average over each target pixel's area, in linear light. Sizes from 1.
Image8 scaled(const Image8& image, int width, int height);

// ASCII in light grey from (x0, y0) rightwards, 14 pixels high, cut at x1 and at the edges of the sheet.
void writeText(Image8& sheet, const std::string& text, int x0, int y0, int x1);

struct SheetPicture {
  Image8 image;
  std::string caption;  // ASCII, one line; what is longer than the picture is wide is cut
};

// Thumbnails of `thumbWidth` (not larger than the picture), `columns` in a row, on dark grey. Empty for no pictures. All pictures have
// the size of the first.
Image8 contactSheet(const std::vector<SheetPicture>& pictures, int thumbWidth = 320, int columns = 4);

}  // namespace welkin::app
