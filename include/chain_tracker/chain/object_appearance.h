// SPDX-License-Identifier: BSD-3-Clause
/// What the object looks like: learned in the first frame, never updated, so that it cannot drift
/// onto the background (thesis ch. 3.2.1).
#pragma once

#include <map>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "chain_tracker/chain/chain_layout.h"
#include "chain_tracker/chain/chain_model.h"
#include "chain_tracker/chain/part_costs.h"
#include "chain_tracker/image/color_palette.h"
#include "chain_tracker/image/frame_pixels.h"
#include "chain_tracker/image/window_textures.h"

namespace chain_tracker {

struct PartAppearance {
  RootHistogram colors;
  RootHistogram edges;
  WindowTexture texture{};
  /// Share of the window of which the first frame tells what it shows, in [0, 1]: of what the
  /// object shows beyond the image it tells nothing. The histograms are of that share.
  float known = 1.0F;
  ObjectColor middle;  ///< of middleOfWindow()
};

/// The pixels of the window's middle, half of it in each direction, or 8 px, or all of a smaller
/// window: along the object's outline they are its own more surely than those farther out.
cv::Rect middleOfWindow(const cv::Point2d& center, double side);

class ObjectAppearance {
 public:
  /// Learns the colours of the object against those of the ring around it.
  ObjectAppearance(const cv::Mat& image, const ChainLayout& layout, const AppearanceModel& model);

  const ColorPalette& palette() const { return palette_; }

  /// What part `index`, counted over all segments, looks like when the object has turned by `turn`
  /// [rad] there: windows stay upright, so they see its corners change. It is the look of the
  /// window turned back in the first frame, to the nearest twentieth of a radian; learned when
  /// first asked for, O(pixels of the window).
  const PartAppearance& part(size_t index, double turn);

 private:
  struct Window {
    cv::Point2d center;  ///< in the first frame [px]
    double side = 0.0;   ///< [px]
  };

  void learnFrame(const cv::Size& size, FramePixels& pixels);
  void learnReach(const Silhouette& silhouette);
  bool isKnown(const cv::Point& pixel) const;
  PartAppearance learnUpright(const Window& window, FramePixels& pixels) const;
  PartAppearance learnTurned(const Window& window, double turn) const;
  ObjectColor learnMiddle(const Window& window, double turn) const;
  int turnedEdge(const cv::Point& pixel, const cv::Point2f& rotation) const;

  ColorPalette palette_;
  cv::Mat image_;                     ///< the first frame
  cv::Mat1b entries_;                 ///< palette entries of the first frame
  cv::Mat1b grey_;                    ///< its brightness
  std::vector<cv::Mat1i> gradients_;  ///< of that: right and down
  std::vector<Window> windows_;
  cv::Rect reach_;    ///< of all windows, however they are turned, and of the first frame
  cv::Mat1b object_;  ///< the silhouette in there
  std::map<std::pair<size_t, int>, PartAppearance> parts_;  ///< by part and whole turn steps
};

}  // namespace chain_tracker
