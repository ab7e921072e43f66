// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/edge_directions.h"

#include <limits>

#include "chain_tracker/image/multiversion.h"
#include "resizable_executor.h"

namespace chain_tracker {
namespace {

/// Pixels that a gradient sums over.
constexpr int kSummed = 3;

haar::FeatureEnsemble gradientFeatures() {
  return {"gradient",
          {{"right", {{1, -1, 1, kSummed, 1}, {-1, -1, 1, kSummed, -1}}},
           {"down", {{-1, 1, kSummed, 1, 1}, {-1, -1, kSummed, 1, -1}}}}};
}

/// Directions lie 45 degrees apart; the tangent of half of that is 0.414, nearly 2 / 5. Every step
/// stays a `Number`, so that narrow ones fill the registers.
template <typename Number>
inline Number codeOf(Number right, Number down) {
  const auto narrow = [](auto value) { return static_cast<Number>(value); };
  const Number across = narrow(right < 0 ? -right : right);
  const Number along = narrow(down < 0 ? -down : down);
  const Number horizontal = narrow(right > 0 ? 1 : 5);
  const Number vertical = narrow(down > 0 ? 3 : 7);
  const Number upper = narrow(right > 0 ? 8 : 6);
  const Number lower = narrow(right > 0 ? 2 : 4);
  const Number diagonal = down > 0 ? lower : upper;
  const Number upright = narrow(5 * across) < narrow(2 * along) ? vertical : diagonal;
  const Number code = narrow(5 * along) < narrow(2 * across) ? horizontal : upright;
  return narrow(across + along) < narrow(kSummed * kLeastContrast) ? narrow(kNoEdge) : code;
}

/// Five times the largest gradient of bytes is a short.
static_assert(5 * kSummed * 255 <= std::numeric_limits<short>::max());

CHAIN_TRACKER_MULTIVERSION
void codeRow(const int* __restrict right, const int* __restrict down, uchar* __restrict codes,
             int columns) {
  for (int x = 0; x < columns; ++x) {
    codes[x] = static_cast<uchar>(
        codeOf<short>(static_cast<short>(right[x]), static_cast<short>(down[x])));
  }
}

}  // namespace

int edgeCode(float right, float down) { return static_cast<int>(codeOf(right, down)); }

EdgeDirections::EdgeDirections()
    : executor_(std::make_unique<ResizableExecutor>(gradientFeatures())) {}
EdgeDirections::EdgeDirections(EdgeDirections&&) noexcept = default;
EdgeDirections& EdgeDirections::operator=(EdgeDirections&&) noexcept = default;
EdgeDirections::~EdgeDirections() = default;

cv::Rect EdgeDirections::neededFor(const cv::Rect& region) {
  return region + cv::Size(2, 2) - cv::Point(1, 1);
}

const std::vector<cv::Mat1i>& EdgeDirections::gradients(const cv::Mat1b& grey) {
  executor_->run(grey, responses_);
  const cv::Rect inner(1, 1, grey.cols - 2, grey.rows - 2);
  gradients_.clear();
  for (const cv::Mat1i& response : responses_) gradients_.push_back(response(inner));
  return gradients_;
}

void EdgeDirections::compute(const cv::Mat1b& grey, cv::Mat1b& codes) {
  const std::vector<cv::Mat1i>& gradient = gradients(grey);
  for (int row = 0; row < codes.rows; ++row) {
    codeRow(gradient[0][row], gradient[1][row], codes[row], codes.cols);
  }
}

}  // namespace chain_tracker
