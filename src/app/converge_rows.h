#pragma once
// What a sweep measured of one setting, and what the report says of it.
#include <map>
#include <string>
#include <vector>

#include "welkin/measure/converge.h"
#include "welkin/render/renderer.h"

namespace welkin::app {

inline constexpr double kShowFull_255 = 16;  // difference that is shown as the palest

struct MeasuredSetting {
  std::vector<double> time_ms;
  std::map<std::string, std::vector<double>> passes_ms;
  std::vector<measure::ImageError> errors;  // from the truth, by pose
  std::vector<Image8> pictures;             // 8 bits, by pose: what best_rmse_255 is of
  Image8 difference;                        // from the truth, of the first pose
  FrameStats stats;
};

// `software`: times are of the process' CPU clock; else of the GPU.
void addTimes(MeasuredSetting& measured, const FrameStats& stats, bool software);

measure::ConvergeRow rowOf(const measure::ConvergeSetting& setting, const MeasuredSetting& measured, const FrameStats& settled,
                           bool software);

// The thesis compares with its own best picture: here the finest step on the greatest budget with the same integrator and rule.
void addBest(std::vector<measure::ConvergeRow>& rows, const std::vector<MeasuredSetting>& measured);

// The truth, the worst setting's difference from it, and those of some along the front.
void addPictures(measure::ConvergeReport& report, const std::vector<MeasuredSetting>& measured, const Image8& truth);

}  // namespace welkin::app
