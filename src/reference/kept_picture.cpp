#include <cstring>

#include "welkin/core/cache.h"
#include "welkin/reference/cloud_picture.h"

namespace welkin::reference {
namespace {

// The number is counted up when the same field would give another picture: when march or light model change.
Cache cache() { return {"truth", "welkin truth 2\n", 64}; }

std::string keyOf(const CloudField& field, const shared::CameraBlock& camera, const PictureSettings& settings) {
  std::string key;
  appendBytes(key, field.contentHash());
  appendBytes(key, camera);
  appendBytes(key, std::int64_t(settings.width));
  appendBytes(key, std::int64_t(settings.height));
  appendBytes(key, settings.tolerance);
  for (const std::uint32_t p : settings.pixels) appendBytes(key, p);
  return key;
}

static_assert(std::is_trivially_copyable_v<CloudTruth>);

}  // namespace

CloudPicture keptPicture(const CloudField& field, const shared::CameraBlock& camera, const PictureSettings& settings,
                         const std::function<bool(double)>& progress) {
  const std::string key = keyOf(field, camera, settings);
  const std::size_t count = settings.pixels.empty() ? std::size_t(settings.width) * std::size_t(settings.height) : settings.pixels.size();
  if (const auto data = cache().load(key); data && data->size() == count * sizeof(CloudTruth)) {
    std::vector<CloudTruth> clouds(count);
    std::memcpy(clouds.data(), data->data(), data->size());
    CloudPicture picture = pictureOf(settings, std::move(clouds));
    picture.kept = true;
    return picture;
  }
  CloudPicture picture = marchPicture(field, camera, settings, progress);
  if (!picture.clouds.empty())
    cache().save(key, {reinterpret_cast<const char*>(picture.clouds.data()), picture.clouds.size() * sizeof(CloudTruth)});
  return picture;
}

}  // namespace welkin::reference
