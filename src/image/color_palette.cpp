// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/image/color_palette.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "chain_tracker/image/multiversion.h"

namespace chain_tracker {
namespace {

constexpr int kBits = 5;
constexpr int kLevels = 1 << kBits;
constexpr int kShift = 8 - kBits;
/// Enough for 24 clusters; more pixels change the centres by less than a level.
constexpr int kMaxSamples = 6000;
/// Of the object and of the ring each, if they have as many: neither is drowned by the other.
constexpr int kMinSamples = 500;

struct Samples {
  cv::Mat3b colors;  // BGR, one row
  std::vector<bool> on_object;
};

cv::Vec3b colorAt(const cv::Mat& image, int row, int column) {
  if (image.channels() == 3) return image.at<cv::Vec3b>(row, column);
  const uchar grey = image.at<uchar>(row, column);
  return {grey, grey, grey};
}

/// Adds every n-th pixel under the mask.
void addSamples(const cv::Mat& image, const cv::Mat1b& mask, bool on_object, int stride,
                Samples& samples) {
  int seen = 0;
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      if (mask(row, column) == 0 || seen++ % stride != 0) continue;
      samples.colors.push_back(colorAt(image, row, column));
      samples.on_object.push_back(on_object);
    }
  }
}

Samples sampleColors(const cv::Mat& image, const cv::Mat1b& object, const cv::Mat1b& ring) {
  const int object_pixels = cv::countNonZero(object);
  const int ring_pixels = cv::countNonZero(ring);
  const int stride = (object_pixels + ring_pixels) / kMaxSamples;
  const auto stride_of = [&](int pixels) {
    return std::max(1, std::min(stride, pixels / kMinSamples));
  };
  Samples samples;
  addSamples(image, object, true, stride_of(object_pixels), samples);
  addSamples(image, ring, false, stride_of(ring_pixels), samples);
  samples.colors = samples.colors.reshape(3, 1);
  return samples;
}

cv::Mat toLab(const cv::Mat3b& colors) {
  cv::Mat scaled;
  colors.convertTo(scaled, CV_32FC3, 1.0 / 255.0);
  cv::Mat lab;
  cv::cvtColor(scaled, lab, cv::COLOR_BGR2Lab);
  return lab.reshape(1, static_cast<int>(colors.total()));
}

/// Centres nearer than this look alike [Lab units].
constexpr double kSameColor = 0.5;

/// Where there are fewer colours than clusters, k-means fills the superfluous ones with single
/// pixels of a colour that has one already; such a twin's share of the object would be decided by
/// chance.
cv::Mat1f withoutTwins(const cv::Mat1f& centers) {
  cv::Mat1f distinct;
  for (int c = 0; c < centers.rows; ++c) {
    bool is_twin = false;
    for (int i = 0; i < distinct.rows; ++i) {
      is_twin = is_twin || cv::norm(centers.row(c), distinct.row(i)) < kSameColor;
    }
    if (!is_twin) distinct.push_back(centers.row(c));
  }
  return distinct;
}

/// cv::kmeans draws from the thread's generator; a fixed state makes the palette reproducible and
/// leaves the caller's sequence of random numbers as it was.
cv::Mat1f clusterCenters(const cv::Mat& lab, int clusters) {
  const cv::RNG callers_generator = cv::theRNG();
  cv::theRNG() = cv::RNG(1);
  cv::Mat labels;
  cv::Mat1f centers;
  const cv::TermCriteria criteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 0.2);
  cv::kmeans(lab, clusters, labels, criteria, 1, cv::KMEANS_PP_CENTERS, centers);
  cv::theRNG() = callers_generator;
  return withoutTwins(centers);
}

std::size_t nearestCluster(const float* lab, const cv::Mat1f& centers) {
  std::size_t nearest = 0;
  float nearest_distance = std::numeric_limits<float>::infinity();
  for (int c = 0; c < centers.rows; ++c) {
    const float* center = centers[c];
    const float dl = lab[0] - center[0];
    const float da = lab[1] - center[1];
    const float db = lab[2] - center[2];
    const float distance = dl * dl + da * da + db * db;
    if (distance < nearest_distance) {
      nearest_distance = distance;
      nearest = static_cast<std::size_t>(c);
    }
  }
  return nearest;
}

/// Share of the object in each cluster, as if object and ring had the same number of pixels.
std::vector<double> objectShares(const std::vector<bool>& on_object, const cv::Mat1f& lab,
                                 const cv::Mat1f& centers) {
  std::vector<double> object(static_cast<std::size_t>(centers.rows), 0.0);
  std::vector<double> ring(object.size(), 0.0);
  double object_total = 0.0;
  for (std::size_t i = 0; i < on_object.size(); ++i) {
    const std::size_t cluster = nearestCluster(lab[static_cast<int>(i)], centers);
    (on_object[i] ? object : ring)[cluster] += 1.0;
    object_total += on_object[i] ? 1.0 : 0.0;
  }
  const double ring_total = static_cast<double>(on_object.size()) - object_total;
  std::vector<double> shares(object.size(), 0.0);
  for (std::size_t c = 0; c < shares.size(); ++c) {
    const double p_object = object[c] / std::max(object_total, 1.0);
    const double p_ring = ring[c] / std::max(ring_total, 1.0);
    if (p_object + p_ring > 0.0) shares[c] = p_object / (p_object + p_ring);
  }
  return shares;
}

/// Palette entry of each cluster: its own, or "other".
std::vector<std::uint8_t> entriesOf(const std::vector<double>& shares, double min_share) {
  const double largest = *std::max_element(shares.begin(), shares.end());
  const double limit = std::min(min_share, largest);
  std::vector<std::uint8_t> entries;
  entries.reserve(shares.size());
  std::uint8_t next = ColorPalette::kOther;
  for (double share : shares) {
    entries.push_back(share >= limit ? ++next : ColorPalette::kOther);
  }
  return entries;
}

std::vector<std::uint8_t> nearestEntries(const cv::Mat3b& colors, const cv::Mat1f& centers,
                                         const std::vector<std::uint8_t>& entries) {
  const cv::Mat1f lab = toLab(colors);
  std::vector<std::uint8_t> table(colors.total());
  for (int i = 0; i < lab.rows; ++i) {
    table[static_cast<size_t>(i)] = entries[nearestCluster(lab[i], centers)];
  }
  return table;
}

/// The colour in the middle of each cell of the lookup table, in table order.
cv::Mat3b tableColors() {
  cv::Mat3b colors(1, kLevels * kLevels * kLevels);
  const auto level = [](int index) {
    return static_cast<uchar>(((index & (kLevels - 1)) << kShift) + (1 << (kShift - 1)));
  };
  for (int i = 0; i < colors.cols; ++i) {
    colors(0, i) = {level(i >> (2 * kBits)), level(i >> kBits), level(i)};
  }
  return colors;
}

cv::Mat3b greyLevels() {
  cv::Mat3b colors(1, 256);
  for (int i = 0; i < 256; ++i) colors(0, i) = cv::Vec3b::all(static_cast<uchar>(i));
  return colors;
}

/// Place of a level in the table; `gain` in ChannelGains::kUnit.
inline std::uint16_t tableLevel(std::uint16_t level, std::uint16_t gain) {
  static_assert(255 * ChannelGains::kMost <= std::numeric_limits<std::uint16_t>::max());
  const auto scaled = static_cast<std::uint16_t>(level * gain);
  const auto cell = static_cast<std::uint16_t>(scaled / (ChannelGains::kUnit << kShift));
  return std::min<std::uint16_t>(cell, kLevels - 1);
}

/// Indices of the lookup table.
CHAIN_TRACKER_MULTIVERSION
void indexPixels(const uchar* __restrict bgr, const ChannelGains& gains,
                 std::uint16_t* __restrict indices, std::ptrdiff_t pixels) {
  const auto blue = static_cast<std::uint16_t>(gains.steps[0]);
  const auto green = static_cast<std::uint16_t>(gains.steps[1]);
  const auto red = static_cast<std::uint16_t>(gains.steps[2]);
  for (std::ptrdiff_t i = 0; i < pixels; ++i) {
    indices[i] = static_cast<std::uint16_t>((tableLevel(bgr[3 * i], blue) << (2 * kBits)) |
                                            (tableLevel(bgr[3 * i + 1], green) << kBits) |
                                            tableLevel(bgr[3 * i + 2], red));
  }
}

/// Computes the indices apart from looking them up, as only they can be vectorised.
void classifyRow(const uchar* bgr, const ChannelGains& gains, const std::uint8_t* table,
                 uchar* entries, std::ptrdiff_t pixels) {
  constexpr std::ptrdiff_t kRun = 256;
  std::uint16_t indices[kRun];
  for (std::ptrdiff_t first = 0; first < pixels; first += kRun) {
    const std::ptrdiff_t run = std::min(kRun, pixels - first);
    indexPixels(bgr + 3 * first, gains, indices, run);
    for (std::ptrdiff_t i = 0; i < run; ++i) entries[first + i] = table[indices[i]];
  }
}

}  // namespace

void prepareForPalettes() { toLab(cv::Mat3b(1, 1, cv::Vec3b())); }

ColorPalette::ColorPalette(const cv::Mat& image, const cv::Mat1b& object, const cv::Mat1b& ring,
                           const PaletteOptions& options) {
  const Samples samples = sampleColors(image, object, ring);
  const cv::Mat1f lab = toLab(samples.colors);
  const cv::Mat1f centers = clusterCenters(lab, std::min(options.colors, lab.rows));
  const std::vector<std::uint8_t> entries =
      entriesOf(objectShares(samples.on_object, lab, centers), options.min_object_share);
  size_ = 1 + *std::max_element(entries.begin(), entries.end());
  if (image.channels() == 3) {
    bgr_table_ = nearestEntries(tableColors(), centers, entries);
  } else {
    grey_table_ = nearestEntries(greyLevels(), centers, entries);
  }
}

void ColorPalette::classify(const cv::Mat& image, const cv::Rect& region, const ChannelGains& gains,
                            cv::Mat1b& entries) const {
  entries.create(region.size());
  const cv::Rect inside = region & cv::Rect(0, 0, image.cols, image.rows);
  if (inside != region) entries.setTo(kOther);
  for (int row = inside.y; row < inside.y + inside.height; ++row) {
    uchar* out = entries[row - region.y] + (inside.x - region.x);
    if (image.channels() == 3) {
      classifyRow(image.ptr(row, inside.x), gains, bgr_table_.data(), out, inside.width);
    } else {
      const uchar* grey = image.ptr(row, inside.x);
      for (int i = 0; i < inside.width; ++i) {
        out[i] = grey_table_[static_cast<size_t>(
            std::min(grey[i] * gains.steps[0] / ChannelGains::kUnit, 255))];
      }
    }
  }
}

}  // namespace chain_tracker
