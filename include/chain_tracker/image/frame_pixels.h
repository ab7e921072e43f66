// SPDX-License-Identifier: BSD-3-Clause
/// An image as the tracker sees it: palette entries, directions of edges and grey levels. Each is
/// computed where it is first asked for and kept, as the searches of one frame look at the same
/// pixels again and again.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/image/color_palette.h"
#include "chain_tracker/image/edge_directions.h"

namespace chain_tracker {

/// What the histograms of windows count.
enum class Channel { kColors, kEdges };

/// Of the pixels of a region that are the object's.
struct ObjectColor {
  double share = 0.0;  ///< of them in the region, in [0, 1]
  cv::Vec3d mean;      ///< blue, green and red, or thrice the grey level; 0 if there are none
};

class FramePixels {
 public:
  /// The palette must outlive this.
  explicit FramePixels(const ColorPalette& palette) : palette_(palette) {}
  FramePixels(const ColorPalette& palette, const cv::Mat& image) : palette_(palette) {
    show(image);
  }

  /// Forgets the image before and takes another of the palette's kind, CV_8UC3 (BGR) or CV_8UC1,
  /// whose pixels must live on until the last question about them; `gains` make up for its light.
  void show(const cv::Mat& image, const ChannelGains& gains = {});

  const ColorPalette& palette() const { return palette_; }

  /// Palette entries of a region that may reach outside the image, where all is
  /// ColorPalette::kOther. Valid until the next call. O(region) at the first time, then O(1) unless
  /// it reaches outside.
  cv::Mat1b entries(const cv::Rect& region);

  /// Of a region that may reach outside the image. O(region).
  ObjectColor objectColor(const cv::Rect& region);

  /// Codes of edge_directions.h in such a region, kNoEdge outside the image; along its border, its
  /// pixels go on. Valid and time as above.
  cv::Mat1b edges(const cv::Rect& region);

  /// The one or the other, and the number of codes that there are.
  cv::Mat1b codes(Channel channel, const cv::Rect& region);
  int codeCount(Channel channel) const;

  /// Grey levels of a region that may reach outside the image, where its border pixels go on.
  /// Valid until the next call. Time as above.
  cv::Mat1b grey(const cv::Rect& region);

 private:
  /// A plane of the image's size, of which only some regions are known.
  struct PartialPlane {
    cv::Mat1b pixels;
    std::vector<cv::Rect> known;
    cv::Mat1b padded;  // of a region that reaches outside the image
  };

  template <typename Compute>
  cv::Mat1b zeroOutside(const cv::Rect& region, PartialPlane& plane, const Compute& compute) const;
  template <typename Compute>
  static void ensure(const cv::Rect& inside, PartialPlane& plane, const Compute& compute);

  const ColorPalette& palette_;
  cv::Mat image_;
  ChannelGains gains_;
  PartialPlane entries_;
  PartialPlane edges_;
  PartialPlane grey_;
  EdgeDirections edge_directions_;
};

}  // namespace chain_tracker
