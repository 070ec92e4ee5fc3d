#include "converge_truth.h"

#include "welkin/core/units.h"
#include "welkin/reference/cloud_picture.h"
#include "welkin/reference/source_field.h"
#include "welkin/reference/tree_field.h"

namespace welkin::app {
namespace {

// The march with the settings' step and with twice that: it is of first order at least, so their difference bounds what is left.
Result<TruthPicture> marched(Renderer& renderer, const View& view, const TruthSettings& settings) {
  TruthPicture out;
  ImageF coarser;
  for (const double factor : {2.0, 1.0}) {
    Quality quality = settings.quality;
    quality.step *= factor;
    if (auto used = renderer.setMarch(quality); !used) return used.error();
    renderer.preview(view);
    coarser = std::move(out.light);
    out.light = renderer.radiance();
  }
  out.image = renderer.image();
  auto error = measure::compareShown(out.light, coarser, settings.curve, settings.exposure_ev);
  if (!error) return error.error();
  out.tolerance = *error;
  return out;
}

// Rays integrated in double precision. The tolerance is the difference from the picture with every weight off by its own estimate.
Result<TruthPicture> integrated(const reference::CloudField& field, Renderer& renderer, const View& view, Size size,
                                const TruthSettings& settings, const std::function<bool(double)>& progress) {
  reference::PictureSettings what{size.width, size.height, {}, settings.tolerance, 0};
  if (settings.every > 1) what.pixels = reference::somePixels(size.width, size.height, settings.every);
  reference::CloudPicture picture = reference::keptPicture(field, renderer.camera(view), what, progress);
  if (picture.clouds.empty()) return Error{"stopped before the truth was there"};
  TruthPicture out;
  out.pixels = what.pixels;
  if (auto drawn = renderer.drawWith(view, reference::weightsOf(picture, size.width, size.height)); !drawn) return drawn.error();
  out.light = renderer.radiance();
  out.image = renderer.image();
  for (auto& cloud : picture.clouds) {
    cloud.sun += cloud.error;
    cloud.transmittance = std::min(cloud.transmittance + cloud.error, 1.0);
  }
  if (auto drawn = renderer.drawWith(view, reference::weightsOf(picture, size.width, size.height)); !drawn) return drawn.error();
  auto error =
      measure::compareShown(chosen(out.light, out.pixels), chosen(renderer.radiance(), out.pixels), settings.curve, settings.exposure_ev);
  if (!error) return error.error();
  out.tolerance = *error;
  return out;
}

}  // namespace

ImageF chosen(const ImageF& picture, const std::vector<std::uint32_t>& pixels) {
  if (pixels.empty()) return picture;
  ImageF row{int(pixels.size()), 1, {}};
  row.rgba.reserve(4 * pixels.size());
  for (const std::uint32_t p : pixels)
    row.rgba.insert(row.rgba.end(), picture.rgba.begin() + std::ptrdiff_t(4 * std::size_t{p}),
                    picture.rgba.begin() + std::ptrdiff_t(4 * std::size_t{p} + 4));
  return row;
}

std::string describeTruth(const TruthSettings& s) {
  const std::string tree = fmt::format("{}, depth {}", bytesText(s.quality.budget_bytes), s.quality.depth);
  const std::string pixels = s.every > 1 ? fmt::format(", one pixel in {}", s.every * s.every) : std::string();
  if (s.kind == TruthKind::Tree) return fmt::format("the tree of {} integrated in double precision to {:g}{}", tree, s.tolerance, pixels);
  if (s.kind == TruthKind::Source)
    return fmt::format(
        "the cloud source without voxels, band-limited to the pixel, down to depth {}, integrated in double precision to {:g}{}",
        s.quality.depth, s.tolerance, pixels);
  return fmt::format("{}, {} {} {:g}, every pixel marched", tree, kIntegratorNames[std::size_t(s.quality.integrator)],
                     kStepRuleNames[std::size_t(s.quality.stepRule)], s.quality.step);
}

Result<TruthPicture> drawTruth(Renderer& renderer, const View& view, Size size, const TruthSettings& settings,
                               const std::function<bool(double)>& progress) {
  if (settings.kind == TruthKind::Gpu) return marched(renderer, view, settings);
  if (auto used = renderer.setMarch(settings.quality); !used) return used.error();  // its detail: what is sampled
  const TreeData tree = renderer.tree(view);
  if (settings.kind == TruthKind::Tree) {
    // Levels as the march has them, by node: what is told is the error of integration.
    return integrated(reference::TreeField(tree, reference::Fade::ByNode), renderer, view, size, settings, progress);
  }
  const RootFrame root{double(tree.block.planetRadius_m), tree.block.half_m};
  auto source = makeDensitySource(renderer.scene(), root);
  if (!source) return source.error();
  reference::SourceSettings rays;
  rays.detail = {renderer.shownDetail(view) * 2 * root.half_m, std::uint32_t(settings.quality.depth), 0};
  rays.eye_planet = renderer.inClouds(view).position_m;
  rays.towardsSun = renderer.sunInClouds();
  return integrated(reference::SourceField(**source, root, rays), renderer, view, size, settings, progress);
}

}  // namespace welkin::app
