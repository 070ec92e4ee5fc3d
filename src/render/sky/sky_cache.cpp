#include "sky_cache.h"

#include <cstring>

#include "welkin/core/cache.h"

namespace welkin {
namespace {

// The number is counted up when sky_field.cpp makes other fields of the same parameters.
Cache cache() { return {"field", "welkin field 1\n", kCachedFields}; }

}  // namespace

std::string fieldKey(const shared::AirBlock& air, const SkyModel& m, const std::string& shaders, const std::string& renderer) {
  shared::AirBlock own = air;
  own.view = {};
  own.params.sunR = own.params.sunG = own.params.sunB = 0;
  std::string key;
  appendBytes(key, own);
  for (const std::int64_t n : {std::int64_t(m.degree), std::int64_t(m.zonal), std::int64_t(m.sunTexels), std::int64_t(m.altitudeTexels), std::int64_t(m.above),
                               std::int64_t(m.below), std::int64_t(m.azimuths), std::int64_t(m.peakAngles), std::int64_t(m.peakAzimuths), std::int64_t(m.pieces),
                               std::int64_t(m.maxOrders)})
    appendBytes(key, n);
  appendBytes(key, m.rest);
  appendBytes(key, fnv1a(shaders));
  return key + renderer;
}

std::optional<std::vector<glm::vec4>> loadField(const std::string& key, std::size_t count) {
  const auto data = cache().load(key);
  if (!data || data->size() != count * sizeof(glm::vec4)) return {};
  std::vector<glm::vec4> field(count);
  std::memcpy(field.data(), data->data(), data->size());
  return field;
}

void saveField(const std::string& key, const std::vector<glm::vec4>& field) {
  cache().save(key, {reinterpret_cast<const char*>(field.data()), field.size() * sizeof(glm::vec4)});
}

}  // namespace welkin
