// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/corner_reads.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "chain_tracker/haar/double_difference.h"
#include "row_sums.h"

namespace chain_tracker::haar {
namespace {

std::int64_t sumRectangle(const cv::Mat1b& image, const cv::Rect& rectangle) {
  const cv::Rect inside = rectangle & cv::Rect(cv::Point(), image.size());
  std::int64_t sum = 0;
  for (int y = inside.y; y < inside.br().y; ++y) {
    for (int x = inside.x; x < inside.br().x; ++x) sum += image(y, x);
  }
  return sum;
}

int responseAt(const cv::Mat1b& image, const HaarFeature& feature, int x, int y) {
  std::int64_t response = 0;
  for (const WeightedRectangle& r : feature.rectangles) {
    response += r.weight * sumRectangle(image, {x + r.x, y + r.y, r.width, r.height});
  }
  if (response < std::numeric_limits<int>::min() || response > std::numeric_limits<int>::max()) {
    throw std::overflow_error("feature '" + feature.name + "' overflows");
  }
  return static_cast<int>(response);
}

}  // namespace

std::vector<cv::Mat1i> sumRectangles(const cv::Mat1b& image, const FeatureEnsemble& ensemble) {
  std::vector<cv::Mat1i> responses;
  for (const HaarFeature& feature : ensemble.features()) {
    cv::Mat1i response(image.size());
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) response(y, x) = responseAt(image, feature, x, y);
    }
    responses.push_back(response);
  }
  return responses;
}

CornerReads::CornerReads(const FeatureEnsemble& ensemble, InstructionSet instructions)
    : reach_(0, 0, 1, 1) {
  for (const HaarFeature& feature : ensemble.features()) {
    reach_ |= feature.bounds();
    std::vector<RowTap> taps;
    const SparseKernel kernel = doubleDifference(feature);
    for (const KernelTap& tap : kernel.taps()) {
      taps.push_back({tap.dx, tap.dy, static_cast<std::int32_t>(tap.weight)});
    }
    sums_.emplace_back(RowKind::k32To32, taps, instructions);
  }
}
CornerReads::~CornerReads() = default;

void CornerReads::run(const cv::Mat1b& image, std::vector<cv::Mat1i>& responses) {
  cv::copyMakeBorder(image, padded_, -reach_.y, reach_.br().y - 1, -reach_.x, reach_.br().x - 1,
                     cv::BORDER_CONSTANT, 0);
  cv::integral(padded_, integral_, CV_32S);
  // cv::integral has an empty row and column in front.
  const RowStore store{integral_.ptr<std::int32_t>(1 - reach_.y) + 1 - reach_.x, -1,
                       static_cast<std::ptrdiff_t>(integral_.step1())};
  responses.resize(sums_.size());
  for (size_t i = 0; i < sums_.size(); ++i) {
    responses[i].create(image.size());
    sums_[i].run(store, responses[i].ptr(),
                 {0, 0, image.rows, image.cols, static_cast<std::ptrdiff_t>(responses[i].step1())});
  }
}

}  // namespace chain_tracker::haar
