// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>

#include "chain_tracker/haar/convolution_plan.h"

namespace chain_tracker::haar {
namespace {

/// Names of the features that a node is.
std::string featureNames(const ConvolutionPlan& plan, size_t node) {
  std::string names;
  for (size_t i = 0; i < plan.tree().features.size(); ++i) {
    if (plan.tree().features[i].node != static_cast<int>(node)) continue;
    names += (names.empty() ? "" : ", ") + plan.ensemble().features()[i].name;
  }
  return names;
}

void describeNode(const ConvolutionPlan& plan, size_t node, const std::string& indent,
                  std::ostream& out) {
  const std::vector<PassNode>& nodes = plan.tree().nodes;
  out << indent << (node == 0 ? "integral image" : nodes[node].edge.text());
  const std::string names = featureNames(plan, node);
  if (!names.empty()) out << "  => " << names;
  for (const PlanBuffer& buffer : plan.buffers()) {
    if (buffer.node != static_cast<int>(node)) continue;
    out << "  [" << (buffer.lane == Lane::k16 ? 16 : 32) << " bit, " << buffer.delays + 1
        << " rows]";
  }
  out << "\n";
  for (size_t child = node + 1; child < nodes.size(); ++child) {
    if (nodes[child].parent == static_cast<int>(node)) {
      describeNode(plan, child, indent + "  ", out);
    }
  }
}

std::string proofText(std::int64_t accesses, std::int64_t least) {
  if (accesses == least) return "proven to be the fewest of the parser's space";
  return "the fewest found; no tree of the parser's space has fewer than " + std::to_string(least);
}

}  // namespace

std::string ConvolutionPlan::describe() const {
  std::ostringstream out;
  out << "ensemble " << ensemble_.name() << ": " << ensemble_.size() << " features\n"
      << "accesses per pixel: classic " << classicAccesses() << ", parsed " << parsedAccesses()
      << " (" << proofText(parsedAccesses(), tree_.least_accesses) << ")\n"
      << "run with " << accesses() << " (" << tree_.reads() << " reads, " << tree_.writes()
      << " writes)"
      << (accesses() == parsedAccesses() ? "" : ", more of which have 16 bits instead of 32")
      << ":\n";
  describeNode(*this, 0, "", out);
  out << "rows needed below a response: " << lookahead()
      << "; pixels outside the image count as 0\n";
  for (size_t i = 0; i < ensemble_.size(); ++i) {
    const cv::Rect bounds = ensemble_.features()[i].bounds();
    out << "  " << ensemble_.features()[i].name << ": columns " << bounds.x << " .. "
        << bounds.br().x - 1 << ", rows " << bounds.y << " .. " << bounds.br().y - 1
        << ", response in [" << ranges_[i].low << ", " << ranges_[i].high << "]\n";
  }
  return out.str();
}

std::string ConvolutionPlan::dot() const {
  std::ostringstream out;
  out << "digraph plan {\n  rankdir=LR;\n  node [shape=box, fontname=Helvetica];\n";
  for (size_t i = 0; i < tree_.nodes.size(); ++i) {
    const std::string names = featureNames(*this, i);
    out << "  n" << i << " [label=\"" << (i == 0 ? "integral image" : names) << "\""
        << (names.empty() ? "" : ", style=filled, fillcolor=lightblue") << "];\n";
    if (i == 0) continue;
    out << "  n" << tree_.nodes[i].parent << " -> n" << i << " [label=\""
        << tree_.nodes[i].edge.text() << "\"];\n";
  }
  out << "}\n";
  return out.str();
}

}  // namespace chain_tracker::haar
