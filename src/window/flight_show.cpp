#include "flight_show.h"

#include "welkin/app/checksum.h"

namespace welkin::window {
namespace {

constexpr std::size_t kMostShown = 1000;

}  // namespace

void FlightShow::begin(Model& model, FlightTask task, const std::filesystem::path& path, const std::filesystem::path& otherwise) {
  held_ = false;
  shown_.clear();
  job_.begin(task, path, otherwise, gpu_);
  model.say(fmt::format("{} of {}", kFlightTasks[std::size_t(task)], path.filename().string()));
}

void FlightShow::advance(Model& model) {
  if (model.wanted.stopFlight) job_.stop();
  if (!running()) return;
  if (auto picture = job_.takePicture()) take(model, std::move(*picture));
  if (auto done = job_.takeDone()) {
    if (done->result) model.showResult(std::move(*done->result));
    model.say(done->said, done->bad);
  }
  model.flight.reset();
  if (running()) model.flight = {job_.task(), job_.progress(), job_.stopping()};
}

void FlightShow::take(Model& model, FlightJob::Picture picture) {
  const Image8& image = picture.image;
  if (texture_.id() == 0 || texture_.spec().width != image.width || texture_.spec().height != image.height) {
    gpu::TextureSpec spec;
    spec.format = GL_RGBA8, spec.width = image.width, spec.height = image.height, spec.frameTarget = true;
    auto made = gpu::Texture::create(account_, "picture of a flight", spec);
    if (!made) return model.say(made.error().message, true);
    texture_ = std::move(*made);
  }
  glTextureSubImage2D(texture_.id(), 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  model.show({picture.view, picture.time_s});
  model.deck.moveTo(model.deck.in_s() + picture.frame * model.deck.tape.step_s());
  view_ = model.view();
  held_ = true;
  if (!remembers_ || shown_.size() >= kMostShown) return;
  const std::string_view bytes(reinterpret_cast<const char*>(image.rgba.data()), image.rgba.size());
  shown_.push_back({picture.frame, picture.view, app::sha256(bytes)});
}

bool FlightShow::shows(const View& view) const {
  const bool same = view.position_m == view_.position_m && view.orientation == view_.orientation && view.fov_deg == view_.fov_deg;
  return held_ && (running() || same);
}

}  // namespace welkin::window
