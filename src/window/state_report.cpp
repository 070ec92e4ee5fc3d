#include "state_report.h"

#include <nlohmann/json.hpp>

#include "welkin/measure/debug_json.h"
#include "welkin/physics/scene_io.h"
#include "widgets.h"

namespace welkin::window {

namespace {

using Json = nlohmann::ordered_json;

Json flightJson(const Model& m, const std::vector<FlightShow::Shown>& shown) {
  constexpr const char* kModes[] = {"idle", "recording", "playing"};
  const Deck& deck = m.deck;
  Json out{{"mode", kModes[std::size_t(deck.mode())]},
           {"frames", deck.tape.frames()},
           {"in", deck.tape.in()},
           {"out", deck.tape.out()},
           {"at_s", deck.at_s()},
           {"running", m.flight ? kFlightTasks[std::size_t(m.flight->task)] : ""},
           {"progress", m.flight ? m.flight->progress.fraction : 0.0},
           {"results", Json::array()},
           {"a", m.results.a},
           {"b", m.results.b},
           {"shown", Json::array()}};
  for (const auto& result : m.results.all) out["results"].push_back(result.file.string());
  for (const auto& s : shown) out["shown"].push_back({{"frame", s.frame}, {"view", Json::parse(viewToJson(s.view))}, {"sha256", s.sha256}});
  return out;
}

// Of the picture that is shown, not of the one that was chosen last.
Json shownDebug(const Model& m) {
  if (!m.painted || !m.painted->debug) return {{"view", "none"}};
  return Json::parse(measure::debugJson(*m.painted->debug));
}

}  // namespace

std::string stateJson(const Model& m, const Counts& c, const std::vector<FlightShow::Shown>& shown) {
  Json open = Json::array();
  for (std::size_t i = 0; i < m.open.size(); ++i)
    if (m.open[i]) open.push_back(kPanelNames[i]);
  const Json state{{"scene", m.scene.name},
                   {"view", Json::parse(viewToJson(m.view()))},
                   {"altitude_m", m.camera.altitude_m()},
                   {"speed_factor", m.camera.speedFactor},
                   {"time_s", m.time_s},
                   {"playing", m.playing},
                   {"light_stale_deg", m.stats.lightStale_deg},
                   {"window", {m.window.width, m.window.height}},
                   {"picture", {m.picture.width, m.picture.height}},
                   {"scale", m.scale.scale()},
                   {"scale_automatic", m.scale.automatic},
                   {"loading", m.loading_s >= 0},
                   {"settled", m.stats.residency.settled},
                   {"bricks_to_come", m.stats.residency.pendingBricks},
                   {"detail", m.stats.sampleDetail},
                   {"bricks", m.stats.residency.bricks},
                   {"bytes_used", m.stats.bytesUsed},
                   {"bytes_budget", m.stats.bytesBudget},
                   {"exposure_ev", m.stats.exposure_ev},
                   {"sidebar", m.sidebar},
                   {"help", m.help},
                   {"panels", open},
                   {"fields", fieldPlaces()},
                   {"quality",
                    {{"step", m.scene.quality.step},
                     {"step_rule", kStepRuleNames[std::size_t(m.scene.quality.stepRule)]},
                     {"skip_empty", m.scene.quality.skipEmpty},
                     {"budget_bytes", m.scene.quality.budget_bytes}}},
                   {"flight", flightJson(m, shown)},
                   {"debug", shownDebug(m)},
                   {"message", m.message},
                   {"frame_rate", m.frameRate},
                   {"frame_ms", m.times.frame().median()},
                   {"seconds", c.seconds},
                   {"frames", c.frames},
                   {"pictures", c.pictures},
                   {"first_picture_s", c.firstPicture_s},
                   {"worst_frame_ms", c.worstFrame_ms},
                   {"worst_frame", c.worst_ms},
                   {"latency_frames", c.latency},
                   {"resizes", c.resizes},
                   {"made", c.made},
                   {"nan_pixels", c.nanPixels},
                   {"holes", c.holes},
                   {"gl_messages", c.glMessages}};
  return state.dump(1) + "\n";
}

}  // namespace welkin::window
