#include "welkin/measure/debug_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "welkin/shared/debug.glsl.h"

namespace welkin::measure {
namespace {

using Json = nlohmann::ordered_json;

std::string hexText(glm::vec3 colour) {
  const glm::ivec3 c(colour * 255.0f + 0.5f);
  return fmt::format("#{:02x}{:02x}{:02x}", c.x, c.y, c.z);
}

}  // namespace

std::string debugJson(const DebugNumbers& n) {
  constexpr int kColours = 33;
  const DebugTopic& topic = debugTopic(n.view);
  Json out{{"view", kDebugViewNames[std::size_t(n.view)]},
           {"what", topic.what},
           {"unit", topic.unit},
           {"pixels", n.pixels},
           {"without", n.without},
           {"not_a_number", n.nan},
           {"minimum", n.minimum},
           {"mean", n.mean},
           {"maximum", n.maximum},
           {"colour_without", hexText(shared::kDebugNoneColour)}};
  if (topic.high > topic.low) {
    out["scale"] = {{"low", topic.low}, {"high", topic.high}, {"logarithmic", topic.logarithmic}};
    for (int i = 0; i < kColours; ++i) out["scale"]["colours"].push_back(hexText(shared::scaleColour(float(i) / (kColours - 1))));
  }
  for (unsigned i = 0; i < topic.kinds; ++i)
    if (n.kinds[i] > 0)
      out["kinds"].push_back({{"kind", i},
                              {"name", debugKindName(n.view, i)},
                              {"pixels", n.kinds[i]},
                              {"colour", hexText(shared::debugColour(unsigned(n.view), float(i)))}});
  return out.dump();
}

}  // namespace welkin::measure
