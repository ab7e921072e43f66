// SPDX-License-Identifier: BSD-3-Clause
/// What stood in the image while the object was somewhere else. It cannot be the object, however
/// much it looks like it: another cable on the table, a second bottle on the shelf. A camera that
/// moves, or light that changes, makes everything look new, so that nothing is told.
#pragma once

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_state.h"

namespace chain_tracker {

class PastViews {
 public:
  /// To be called with every image in which the object was seen for sure, and where. The first one
  /// is kept, and one of the last few. O(pixels) every few calls, else O(1).
  void remember(const cv::Mat& image, const ChainState& object);

  /// Whether most of the parts of `chain` lie where `image` shows what it showed in one of the
  /// views kept, while the object was elsewhere; not where it was itself in the first one, if that
  /// shows again. O(parts * (parts + pixels of a part)).
  bool showed(const ChainState& chain, const cv::Mat& image) const;

 private:
  struct View {
    cv::Mat image;
    ChainState object;
  };

  static bool shows(const View& view, bool as_object, const ChainState& chain,
                    const cv::Mat& image);

  View first_;
  View latest_;
  int calls_ = 0;
};

}  // namespace chain_tracker
