// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/reference_executor.h"

namespace chain_tracker::haar {
namespace {

/// Values of one node at the columns and rows of `region`, row by row.
struct NodeImage {
  cv::Rect region;
  std::vector<std::int64_t> values;

  explicit NodeImage(const cv::Rect& where)
      : region(where),
        values(static_cast<size_t>(where.width) * static_cast<size_t>(where.height)) {}
  std::int64_t& at(int x, int y) {
    return values[static_cast<size_t>(y - region.y) * static_cast<size_t>(region.width) +
                  static_cast<size_t>(x - region.x)];
  }
};

/// Where values can be needed: around the image by the delays of the features and their kernels.
cv::Rect canvasOf(const PassTree& tree, const cv::Size& image) {
  cv::Rect canvas(cv::Point(), image);
  for (const FeatureNode& feature : tree.features) {
    const cv::Point reach = tree.nodes[static_cast<size_t>(feature.node)].kernel.maxDelay();
    const cv::Rect needed(cv::Point(), image);
    canvas |= needed - feature.delay;
    canvas |= needed - feature.delay - reach;
  }
  return canvas;
}

NodeImage integralOf(const cv::Mat1b& image, const cv::Rect& canvas) {
  NodeImage integral(canvas);
  const cv::Rect pixels(cv::Point(), image.size());
  for (int y = canvas.y; y < canvas.br().y; ++y) {
    std::int64_t row_sum = 0;
    for (int x = canvas.x; x < canvas.br().x; ++x) {
      if (pixels.contains({x, y})) row_sum += image(y, x);
      integral.at(x, y) = row_sum + (y > canvas.y ? integral.at(x, y - 1) : 0);
    }
  }
  return integral;
}

/// Values whose sources lie outside the canvas are not needed and stay 0.
NodeImage convolve(NodeImage& source, const SparseKernel& edge) {
  NodeImage target(source.region);
  const cv::Rect& canvas = source.region;
  const cv::Point reach = edge.maxDelay();
  for (int y = canvas.y + reach.y; y < canvas.br().y; ++y) {
    for (int x = canvas.x + reach.x; x < canvas.br().x; ++x) {
      for (const KernelTap& tap : edge.taps()) {
        target.at(x, y) += tap.weight * source.at(x - tap.dx, y - tap.dy);
      }
    }
  }
  return target;
}

}  // namespace

std::vector<cv::Mat1i> runReference(const ConvolutionPlan& plan, const cv::Mat1b& image) {
  const PassTree& tree = plan.tree();
  std::vector<NodeImage> nodes = {integralOf(image, canvasOf(tree, image.size()))};
  for (size_t i = 1; i < tree.nodes.size(); ++i) {
    const PassNode& node = tree.nodes[i];
    nodes.push_back(convolve(nodes[static_cast<size_t>(node.parent)], node.edge));
  }
  std::vector<cv::Mat1i> responses;
  for (const FeatureNode& feature : tree.features) {
    NodeImage& node = nodes[static_cast<size_t>(feature.node)];
    cv::Mat1i response(image.size());
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        response(y, x) =
            static_cast<int>(feature.scale * node.at(x - feature.delay.x, y - feature.delay.y));
      }
    }
    responses.push_back(response);
  }
  return responses;
}

}  // namespace chain_tracker::haar
