// SPDX-License-Identifier: BSD-3-Clause
/// As much XML as OpenCV writes: elements, text, comments; every element knows its line.
#pragma once

#include <string>
#include <vector>

namespace chain_tracker::haar {

struct XmlElement {
  std::string name;
  std::string text;  ///< of the element itself, without that of its children
  int line = 0;      ///< where it begins, from 1
  std::vector<XmlElement> children;

  /// The first child of a name, or null.
  const XmlElement* child(const std::string& child_name) const;
};

/// Elements in elements are looked at down to this depth.
constexpr size_t kMaxXmlDepth = 64;

/// The root element. Throws std::invalid_argument that names `source`, the line and the reason.
XmlElement parseXml(const std::string& xml, const std::string& source);

}  // namespace chain_tracker::haar
