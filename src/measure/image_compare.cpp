#include "welkin/measure/image_compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "colour.h"
#include "welkin/render/exposure/exposure_pass.h"
#include "welkin/render/tone_curve.h"
#include "welkin/shared/tonemap.glsl.h"

namespace welkin::measure {
namespace {

template <class A>
std::optional<Error> sizesDiffer(const A& a, const A& b) {
  const auto whole = [](const A& i) {
    return i.width > 0 && i.height > 0 && i.rgba.size() == std::size_t(i.width) * std::size_t(i.height) * 4;
  };
  if (!whole(a) || !whole(b)) return Error{"expected two pictures with pixels"};
  if (a.width == b.width && a.height == b.height) return std::nullopt;
  return Error{fmt::format("expected pictures of one size, got {}x{} and {}x{}", a.width, a.height, b.width, b.height)};
}

// Collects differences pixel by pixel.
class Sums {
 public:
  void add(const std::array<double, 3>& d_255) {
    double greatest = 0;
    for (const double d : d_255) {
      squares_ += d * d;
      absolute_ += std::abs(d);
      greatest = std::max(greatest, std::abs(d));
    }
    greatest_.push_back(greatest);
  }
  ImageError result() const {
    ImageError e;
    if (greatest_.empty()) return e;
    const double n = double(greatest_.size());
    e.rmse_255 = std::sqrt(squares_ / (3 * n));
    e.mean_255 = absolute_ / (3 * n);
    e.psnr_db = e.rmse_255 > 0 ? 20 * std::log10(255 / e.rmse_255) : std::numeric_limits<double>::infinity();
    auto sorted = greatest_;
    std::sort(sorted.begin(), sorted.end());
    e.max_255 = sorted.back();
    // Smallest value that at least this share of the pixels does not exceed: exact for 8-bit pictures, no interpolation.
    const auto rank = [&](double q) { return sorted[std::size_t(std::max(0.0, std::ceil(q * n) - 1))]; };
    e.p99_255 = rank(0.99);
    e.p999_255 = rank(0.999);
    const auto over = [&](double limit) { return double(sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), limit)) / n; };
    e.shareOver1 = over(1);
    e.shareOver2 = over(2);
    e.shareOver16 = over(16);
    return e;
  }

 private:
  double squares_ = 0, absolute_ = 0;
  std::vector<double> greatest_;
};

// `shown` makes display values 0..1 of three linear ones.
template <class Shown>
Result<ImageError> compareLinear(const ImageF& a, const ImageF& b, const Shown& shown) {
  if (auto error = sizesDiffer(a, b)) return *error;
  Sums sums;
  double squares = 0, reference = 0;
  std::uint64_t n = 0, notFinite = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    bool finite = true;
    for (std::size_t c = 0; c < 3; ++c) finite = finite && std::isfinite(a.rgba[i + c]) && std::isfinite(b.rgba[i + c]);
    if (!finite) {
      ++notFinite;
      continue;
    }
    const auto x = shown(&a.rgba[i]), y = shown(&b.rgba[i]);
    std::array<double, 3> d{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double difference = double(a.rgba[i + c]) - b.rgba[i + c];
      squares += difference * difference;
      reference += double(a.rgba[i + c]) * a.rgba[i + c];
      d[c] = 255 * (x[c] - y[c]);
    }
    ++n;
    sums.add(d);
  }
  ImageError e = sums.result();
  e.notFinite = notFinite;
  if (n > 0) e.linearRmse = std::sqrt(squares / double(3 * n));
  if (reference > 0) e.relativeRmse = std::sqrt(squares / reference);
  return e;
}

// As composite.comp and show.comp do, without the dither.
std::array<double, 3> shownColour(const float* rgb, ToneCurve curve, double exposure_ev) {
  const glm::vec3 colour = toned(curve, shared::toneInput({rgb[0], rgb[1], rgb[2]}, exposureScale(exposure_ev)));
  return {srgbFromLinear(colour.x), srgbFromLinear(colour.y), srgbFromLinear(colour.z)};
}

}  // namespace

Result<ImageError> compare(const Image8& a, const Image8& b) {
  if (auto error = sizesDiffer(a, b)) return *error;
  Sums sums;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    sums.add({double(a.rgba[i]) - b.rgba[i], double(a.rgba[i + 1]) - b.rgba[i + 1], double(a.rgba[i + 2]) - b.rgba[i + 2]});
  }
  return sums.result();
}

Result<ImageError> compare(const ImageF& a, const ImageF& b, double exposure_ev) {
  const double scale = std::exp2(exposure_ev);
  return compareLinear(a, b, [scale](const float* rgb) {
    std::array<double, 3> shown{};
    for (std::size_t c = 0; c < 3; ++c) shown[c] = srgbFromLinear(std::clamp(rgb[c] * scale, 0.0, 1.0));
    return shown;
  });
}

Result<ImageError> compareShown(const ImageF& first, const ImageF& second, ToneCurve curve, double exposure_ev) {
  return compareLinear(first, second, [curve, exposure_ev](const float* rgb) { return shownColour(rgb, curve, exposure_ev); });
}

std::vector<float> shownDifference(const ImageF& first, const ImageF& second, ToneCurve curve, double exposure_ev) {
  std::vector<float> out;
  out.reserve(first.rgba.size() / 4);
  for (std::size_t i = 0; i < first.rgba.size(); i += 4) {
    const auto a = shownColour(&first.rgba[i], curve, exposure_ev), b = shownColour(&second.rgba[i], curve, exposure_ev);
    double greatest = 0;
    for (std::size_t c = 0; c < 3; ++c) greatest = std::max(greatest, std::abs(a[c] - b[c]));
    out.push_back(float(255 * greatest));
  }
  return out;
}

ImageError joined(const std::vector<ImageError>& errors) {
  ImageError all;
  if (errors.empty()) return all;
  const double n = double(errors.size());
  for (const ImageError& e : errors) {
    all.rmse_255 += e.rmse_255 * e.rmse_255 / n;
    all.linearRmse += e.linearRmse * e.linearRmse / n;
    all.relativeRmse += e.relativeRmse * e.relativeRmse / n;
    all.mean_255 += e.mean_255 / n;
    all.shareOver1 += e.shareOver1 / n;
    all.shareOver2 += e.shareOver2 / n;
    all.shareOver16 += e.shareOver16 / n;
    all.flip += e.flip / n;
    all.max_255 = std::max(all.max_255, e.max_255);
    all.p99_255 = std::max(all.p99_255, e.p99_255);
    all.p999_255 = std::max(all.p999_255, e.p999_255);
    all.notFinite += e.notFinite;
  }
  all.rmse_255 = std::sqrt(all.rmse_255);
  all.linearRmse = std::sqrt(all.linearRmse);
  all.relativeRmse = std::sqrt(all.relativeRmse);
  all.psnr_db = all.rmse_255 > 0 ? 20 * std::log10(255 / all.rmse_255) : std::numeric_limits<double>::infinity();
  return all;
}

Image8 toDisplay(const ImageF& image, double exposure_ev) {
  const double scale = std::exp2(exposure_ev);
  Image8 out{image.width, image.height, std::vector<std::uint8_t>(image.rgba.size())};
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    const double v = image.rgba[i];
    const double shown = i % 4 == 3 ? 1 : srgbFromLinear(std::clamp(std::isfinite(v) ? v * scale : 0.0, 0.0, 1.0));
    out.rgba[i] = std::uint8_t(std::lround(255 * shown));
  }
  return out;
}

}  // namespace welkin::measure
