// SPDX-License-Identifier: BSD-3-Clause
/// The classic way: every response from the corners of the feature in the integral image.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/haar/haar_feature.h"
#include "chain_tracker/haar/instruction_set.h"

namespace chain_tracker::haar {

class RowSum;

/// The definition in haar_feature.h, pixel by pixel and rectangle by rectangle, in 64 bits: the
/// slow twin of everything else. O(pixels * sum of areas). Responses that do not fit in 32 bits
/// throw std::overflow_error.
std::vector<cv::Mat1i> sumRectangles(const cv::Mat1b& image, const FeatureEnsemble& ensemble);

/// Corner reads over cv::integral, a plane at a time and vectorised: what a careful programmer
/// writes. Keeps its memory from call to call.
class CornerReads {
 public:
  explicit CornerReads(const FeatureEnsemble& ensemble,
                       InstructionSet instructions = InstructionSet::kBest);
  ~CornerReads();

  /// `responses` gets one plane of the image's size for each feature. Exact if the responses fit in
  /// 32 bits. O(pixels * corners).
  void run(const cv::Mat1b& image, std::vector<cv::Mat1i>& responses);

 private:
  std::vector<RowSum> sums_;  ///< of the features
  cv::Rect reach_;            ///< bounds of all features
  cv::Mat1b padded_;
  cv::Mat1i integral_;
};

}  // namespace chain_tracker::haar
