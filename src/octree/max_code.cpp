#include "welkin/octree/max_code.h"

#include "welkin/shared/octree.glsl.h"

namespace welkin {

std::uint32_t maxCodeFor(float fraction) {
  if (!(fraction > 0)) return 0;
  std::uint32_t code = 31;
  while (code > 1 && shared::maxCodeValue(code - 1) >= fraction) --code;
  return code;
}

}  // namespace welkin
