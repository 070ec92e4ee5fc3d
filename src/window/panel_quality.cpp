#include "panels.h"
#include "welkin/app/presets.h"
#include "welkin/core/units.h"
#include "widgets.h"

namespace welkin::window {
namespace {

// A button for each preset; the one that holds is bright.
void presets(Model& model) {
  Quality& q = model.scene.quality;
  const std::string now = app::presetOf(q);
  const auto use = [&](Quality wanted) {
    (wanted.budget_bytes != q.budget_bytes || wanted.depth != q.depth ? model.wanted.rebuild : model.wanted.march) = true;
    q = wanted;
  };
  for (const app::Preset& preset : app::kPresets) {
    if (now == preset.name) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (press(preset.name, "a budget, a step and a spread that go together")) {
      Quality wanted = q;
      app::apply(preset, wanted);
      use(wanted);
      markEdit("preset");
    }
    if (now == preset.name) ImGui::PopStyleColor();
    ImGui::SameLine();
  }
  if (press("as loaded", "the scene's own quality")) use(model.asLoaded.quality), markEdit("quality as loaded");
}

}  // namespace

void qualityPanel(Model& model) {
  Quality& q = model.scene.quality;
  const Quality& was = model.asLoaded.quality;
  presets(model);
  bool march = false, rebuild = false;
  march |= number("step", q.step, was.step, {0.02, 4, "%.3g", true},
                  "length of a march segment, in units of the step rule; smaller is finer and slower")
               .now;
  march |= number("spread", q.spread, was.spread, {0, 16, "%.1f of 255"},
                  "how unlike marched pixels may look for those between them to be interpolated; 0: all are marched")
               .now;
  march |= number("detail", q.detail, was.detail, {0, 4000, "%.0f nodes/rad"}, "wanted; 0: as fine as the budget allows").now;
  int rule = int(q.stepRule), integrator = int(q.integrator);
  if (choice("step rule", rule, kStepRuleNames, "what a march step is measured in")) q.stepRule = StepRule(rule), march = true;
  if (choice("integrator", integrator, kIntegratorNames, "how a march segment adds up"))
    q.integrator = Integrator(integrator), march = true;
  march |= tick("skip empty space", q.skipEmpty, "off: empty nodes are marched like others, for comparisons");
  ImGui::SameLine();
  tick("reprojection", model.reprojection, "one pixel in 16 is marched a frame, the others come from the frame before");
  double budget_MiB = double(q.budget_bytes) / 0x1p20, depth = q.depth;
  const Edited bytes = number("budget", budget_MiB, double(was.budget_bytes) / 0x1p20, {64, 8192, "%.0f MiB", true},
                              "memory of the GL that may be used; the scene is prepared anew");
  if (bytes.now) q.budget_bytes = std::uint64_t(budget_MiB) << 20;
  const Edited deep = number("depth", depth, was.depth, {1, 24, "%.0f levels"}, "of the octree at most; the scene is prepared anew");
  if (deep.now) q.depth = int(depth + 0.5);
  rebuild = bytes.finished || deep.finished;
  bool automatic = model.scale.automatic;
  if (tick("picture's size by itself", automatic,
           "pictures are drawn smaller than the window where a frame would take over a twentieth of a second"))
    model.scale.automatic = automatic;
  double scale = model.scale.scale();
  if (number("picture's size", scale, 1, {kScales.front(), 1, "%.2f of window"}, "width and height of the picture over the window's").now)
    model.scale.set(scale);
  if (march) model.wanted.march = true;
  if (rebuild) model.wanted.rebuild = true;
}

void exposurePanel(Model& model) {
  Output& output = model.scene.output;
  const Output& was = model.asLoaded.output;
  bool metered = !model.exposure_ev.has_value();
  if (tick("metered", metered, "from the picture, and adapted as an eye does; else fixed")) {
    if (metered)
      model.exposure_ev.reset();
    else
      model.exposure_ev = model.stats.exposure_ev;
    output.exposure_ev = model.exposure_ev;
    model.wanted.output = true;
  }
  if (metered) {
    AutoExposure& a = output.autoExposure;
    bool changed =
        number("compensation", a.compensation_ev, was.autoExposure.compensation_ev, {-8, 8, "%+.2f EV"}, "stops brighter than middle grey")
            .finished;
    changed |=
        number("to bright", a.adaptToBright_s, was.autoExposure.adaptToBright_s, {0, 10, "%.2f s"}, "time constant when it gets brighter")
            .finished;
    changed |=
        number("to dark", a.adaptToDark_s, was.autoExposure.adaptToDark_s, {0, 10, "%.2f s"}, "time constant when it gets darker").finished;
    if (changed) model.wanted.output = true;
    line("reached", fmt::format("{:+.2f} EV", model.stats.exposure_ev));
  } else {
    double ev = *model.exposure_ev;
    if (number("exposure", ev, model.home.exposure_ev.value_or(was.exposure_ev.value_or(0)), {-12, 12, "%+.2f EV"},
               "stops over the base exposure")
            .now)
      model.exposure_ev = output.exposure_ev = ev;
  }
  int curve = int(output.toneCurve);
  if (choice("tone curve", curve, kToneCurveNames, "how linear light becomes colours of the display"))
    output.toneCurve = ToneCurve(curve), model.wanted.output = true;
}

}  // namespace welkin::window
