// SPDX-License-Identifier: BSD-3-Clause
#include "support/brute_force.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chain_tracker {
namespace brute_force {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<cv::Point> statesOf(const cv::Mat1f& map) {
  std::vector<cv::Point> states;
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.cols; ++column) states.emplace_back(column, row);
  }
  return states;
}

/// Counts up: the next of all sequences of digits below `base`; false after the last one.
bool advance(std::vector<size_t>& digits, size_t base) {
  for (size_t& digit : digits) {
    if (++digit < base) return true;
    digit = 0;
  }
  return false;
}

}  // namespace

double stencilCost(const EdgeStencil& stencil, const cv::Point& offset) {
  double least = kInfinity;
  for (const StencilOffset& entry : stencil) {
    if (entry.columns == offset.x && entry.rows == offset.y) {
      least = std::min(least, static_cast<double>(entry.cost));
    }
  }
  return least;
}

ConvolvedMap minConvolve(const cv::Mat1f& in, const EdgeStencil& stencil) {
  ConvolvedMap result{cv::Mat1d(in.size(), kInfinity), 0};
  for (const cv::Point& to : statesOf(in)) {
    for (const cv::Point& from : statesOf(in)) {
      const double cost = in(from) + stencilCost(stencil, to - from);
      result.map(to) = std::min(result.map(to), cost);
      ++result.pairs;
    }
  }
  return result;
}

EdgeCost edgeCostOf(const std::vector<EdgeStencil>& edges) {
  return [edges](size_t k, const cv::Point& from, const cv::Point& to) {
    return stencilCost(edges[k], to - from);
  };
}

double energyOf(const std::vector<cv::Mat1f>& unary, const EdgeCost& edge,
                const std::vector<cv::Point>& states) {
  double energy = 0.0;
  for (size_t k = 0; k < unary.size(); ++k) {
    energy += unary[k](states[k]);
    if (k > 0) energy += edge(k - 1, states[k - 1], states[k]);
  }
  return energy;
}

AllChains enumerateChains(const std::vector<cv::Mat1f>& unary, const EdgeCost& edge) {
  AllChains all;
  all.cost = kInfinity;
  for (const cv::Mat1f& map : unary) all.marginals.emplace_back(map.size(), kInfinity);
  const std::vector<cv::Point> states = statesOf(unary.front());
  std::vector<size_t> digits(unary.size(), 0);
  std::vector<cv::Point> chain(unary.size());
  do {
    for (size_t k = 0; k < chain.size(); ++k) chain[k] = states[digits[k]];
    const double energy = energyOf(unary, edge, chain);
    all.cost = std::min(all.cost, energy);
    for (size_t k = 0; k < chain.size(); ++k) {
      all.marginals[k](chain[k]) = std::min(all.marginals[k](chain[k]), energy);
    }
    ++all.chains;
  } while (advance(digits, states.size()));
  return all;
}

double springCost(const EdgePotential& spring, const cv::Point2d& edge) {
  const double length = std::sqrt(edge.x * edge.x + edge.y * edge.y);
  const cv::Point2d unit = length > 0.0 ? edge / length : cv::Point2d(1.0, 0.0);
  const cv::Point2d rest(std::cos(spring.direction), std::sin(spring.direction));
  const double stretch = (length - spring.length) / spring.length_sigma;
  const double turn = std::atan2(rest.cross(unit), rest.dot(unit)) / spring.direction_sigma;
  if (std::abs(stretch) > 3.0 || std::abs(turn) > 3.0) return kInfinity;
  return 0.5 * stretch * stretch + 0.5 * turn * turn;
}

cv::Mat1b entriesOf(const cv::Mat& image, const ColorPalette& palette) {
  cv::Mat1b entries(image.size());
  cv::Mat1b one;
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      palette.classify(image, {column, row, 1, 1}, {}, one);
      entries(row, column) = one(0, 0);
    }
  }
  return entries;
}

WindowCounts countWindow(const cv::Mat1b& entries, int palette_size, const cv::Point& corner,
                         int side) {
  const cv::Rect image(cv::Point(), entries.size());
  WindowCounts window{std::vector<int>(static_cast<size_t>(palette_size), 0), 0};
  for (int y = corner.y; y < corner.y + side; ++y) {
    for (int x = corner.x; x < corner.x + side; ++x) {
      const bool inside = image.contains({x, y});
      ++window.counts[inside ? entries(y, x) : size_t(ColorPalette::kOther)];
      ++window.pixels;
    }
  }
  return window;
}

}  // namespace brute_force
}  // namespace chain_tracker
