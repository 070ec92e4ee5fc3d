#pragma once
// A scene that uses every key, and a check that a message is one line.
#include <gtest/gtest.h>

#include <string>

namespace welkin::testing_support {

inline const std::string kFullScene = R"({
  "name": "everything",
  "planet": {"radius_m": 6360000, "albedo": [0.1, 0.2, 0.3], "albedo_map": "../data/earth.png"},
  "atmosphere": {"top_m": 100000, "model": "march", "layers": [
    {"name": "rayleigh", "profile": {"type": "exponential", "scale_height_m": 8000}, "scattering_per_m": [5.8e-6, 1.35e-5, 3.31e-5],
     "absorption_per_m": [0, 0, 0], "phase": {"type": "rayleigh"}},
    {"name": "haze", "profile": {"type": "uniform", "base_m": 0, "top_m": 2000}, "scattering_per_m": [1e-6, 1e-6, 1e-6],
     "phase": {"type": "henyey-greenstein", "g": 0.7}},
    {"name": "mie", "profile": {"type": "exponential", "scale_height_m": 1200}, "scattering_per_m": [4e-6, 4e-6, 4e-6],
     "phase": {"type": "cornette-shanks", "g": 0.8}},
    {"name": "ozone", "profile": {"type": "tent", "peak_m": 25000, "half_width_m": 15000}, "absorption_per_m": [6.5e-7, 1.88e-6, 8.5e-8],
     "phase": {"type": "isotropic"}}]},
  "sun": {"irradiance": [1.5, 1.8, 1.9], "angular_radius_rad": 0.0047, "direction": [0.6, 0.0, 0.8], "day_s": 88775.244},
  "clouds": {"combine": "add", "wind_east_m_per_s": -12.5, "sources": [
    {"type": "cover-map", "file": "../data/clouds.png", "layers": [{"name": "cumulus", "base_m": 900, "top_m": 2500, "base_fade_m": 90,
      "top_fade_m": 500, "extinction_per_m": 0.05, "cover_gain": 1.5, "cover_bias": -0.1, "type_low": 0.2, "type_high": 0.6, "cell_m": 6000,
      "octaves": 7, "gain": 0.55, "billow": 0.8, "softness": 0.25, "taper": 0.4, "top_follows_cover": 0.5, "streak": 2, "warp_m": 4000}]},
    {"type": "layers"},
    {"type": "sphere", "centre_m": [6362000, 0, 0], "radius_m": 500, "extinction_per_m": 0.02},
    {"type": "slab", "base_m": 1000, "top_m": 1500, "extinction_per_m": 0.01}]},
  "views": {
    "ground": {"latitude_deg": 47.5, "longitude_deg": 8.5, "altitude_m": 2, "heading_deg": 250, "pitch_deg": 12, "roll_deg": 3, "fov_deg": 60,
               "exposure_ev": 3},
    "space": {"position_m": [14000000, 0, 0], "orientation_xyzw": [0.5, 0.5, 0.5, 0.5], "fov_deg": 40}},
  "quality": {"budget": "128MiB", "depth": 12, "integrator": "simpson-3/8", "step_rule": "pixel", "step": 0.4, "skip_empty": false, "spread": 12.5, "detail": 300, "seed": 7},
  "output": {"exposure_ev": 1.5, "tone_curve": "lottes", "auto_exposure": {"compensation_ev": -0.5, "adapt_to_bright_s": 0.3,
    "adapt_to_dark_s": 2, "low_percentile": 20, "high_percentile": 90, "min_ev": -3, "max_ev": 9}}
}
)";

inline void expectOneLine(const std::string& message, const std::string& source = "test.json") {
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_TRUE(message.starts_with(source + ": ")) << message;
  EXPECT_LT(message.size(), 1000u);
}

}  // namespace welkin::testing_support
