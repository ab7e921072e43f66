// SPDX-License-Identifier: BSD-3-Clause
/// The few colours that tell the object from its surroundings, learned in the first frame, and the
/// lookup table that turns pixels into them (thesis ch. 3.2.1: colour histograms as appearance).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace chain_tracker {

struct PaletteOptions {
  int colors = 24;                ///< clusters looked for, in [2, 254]
  double min_object_share = 0.5;  ///< in [0, 1)
};

/// Of each channel, blue, green and red, or of the one of a grey image: by which its levels are
/// multiplied before they are looked up, so that a palette learned in one light serves in another.
/// Counted in whole steps of 1 / kUnit, in [kLeast, kMost].
struct ChannelGains {
  static constexpr int kUnit = 128;
  static constexpr int kLeast = kUnit / 2;
  static constexpr int kMost = kUnit * 2;
  std::array<int, 3> steps = {kUnit, kUnit, kUnit};
};

/// Does what the first palette of a process would have to do: OpenCV builds its tables at the first
/// conversion to Lab, which takes a third of a second, or ten frames. Call it before they come.
void prepareForPalettes();

class ColorPalette {
 public:
  /// Entry of every colour that is not the object's, and of all that lies outside the image.
  static constexpr std::uint8_t kOther = 0;

  /// Clusters the Lab colours under both masks; a cluster whose share of the object, p_object /
  /// (p_object + p_ring), is below min_object_share is merged into "other". If that leaves none,
  /// the cluster with the largest share stays.
  /// `image`: CV_8UC3 (BGR) or CV_8UC1; masks: of its size, `object` not all zero.
  /// The same image and masks always give the same palette.
  ColorPalette(const cv::Mat& image, const cv::Mat1b& object, const cv::Mat1b& ring,
               const PaletteOptions& options);

  /// Number of entries, "other" included; entries are 0 .. size() - 1.
  int size() const { return size_; }

  /// Entries of the pixels in `region`, which may reach outside the image, in the light that
  /// `gains` make up for. `entries` gets the region's size. O(region).
  void classify(const cv::Mat& image, const cv::Rect& region, const ChannelGains& gains,
                cv::Mat1b& entries) const;

 private:
  int size_ = 1;
  std::vector<std::uint8_t> bgr_table_;   ///< 5 bits a channel
  std::vector<std::uint8_t> grey_table_;  ///< 8 bits, for one-channel images
};

}  // namespace chain_tracker
