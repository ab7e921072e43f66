// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "chain_tracker/haar/ensemble_io.h"
#include "xml_elements.h"

namespace chain_tracker::haar {
namespace {

class CascadeReader {
 public:
  explicit CascadeReader(const std::string& source) : source_(source) {}

  CascadeFeatures read(const XmlElement& root) const {
    const XmlElement& cascade = required(root, "cascade");
    const XmlElement& type = required(cascade, "featureType");
    if (textOf(type) != "HAAR") refuse(type, "featureType is '" + textOf(type) + "', must be HAAR");
    std::vector<HaarFeature> upright;
    std::vector<std::string> tilted;
    int index = 0;
    for (const XmlElement& element : required(cascade, "features").children) {
      HaarFeature feature{"feature_" + std::to_string(index++), {}};
      if (isTilted(element)) {
        tilted.push_back(feature.name);
        continue;
      }
      readRectangles(required(element, "rects"), feature);
      const std::string fault = faultOf(feature);
      if (!fault.empty()) refuse(element, fault);
      upright.push_back(std::move(feature));
    }
    if (upright.empty()) refuse(cascade, "there is no upright feature");
    return {{source_, std::move(upright)}, std::move(tilted)};
  }

 private:
  const XmlElement& required(const XmlElement& parent, const std::string& name) const {
    const XmlElement* element = parent.child(name);
    if (element == nullptr) refuse(parent, "<" + parent.name + "> has no <" + name + ">");
    return *element;
  }

  static std::string textOf(const XmlElement& element) {
    std::istringstream words(element.text);
    std::string word;
    words >> word;
    return word;
  }

  bool isTilted(const XmlElement& feature) const {
    const XmlElement* tilted = feature.child("tilted");
    if (tilted == nullptr || textOf(*tilted) == "0") return false;
    if (textOf(*tilted) != "1") refuse(*tilted, "tilted must be 0 or 1");
    return true;
  }

  void readRectangles(const XmlElement& rectangles, HaarFeature& feature) const {
    for (const XmlElement& element : rectangles.children) {
      std::istringstream numbers(element.text);
      WeightedRectangle r;
      double weight = 0.0;
      std::string rest;
      if (!(numbers >> r.x >> r.y >> r.width >> r.height >> weight) || numbers >> rest) {
        refuse(element, "a rectangle must be 'x y width height weight'");
      }
      if (!(std::abs(weight) <= kMaxWeight) || weight != std::round(weight)) {
        refuse(element, "the weight must be a whole number within " + std::to_string(kMaxWeight));
      }
      r.weight = static_cast<int>(weight);
      feature.rectangles.push_back(r);
    }
  }

  [[noreturn]] void refuse(const XmlElement& element, const std::string& reason) const {
    throw std::invalid_argument(source_ + ":" + std::to_string(element.line) + ": " + reason);
  }

  const std::string& source_;
};

}  // namespace

CascadeFeatures parseCascade(const std::string& xml, const std::string& source) {
  return CascadeReader(source).read(parseXml(xml, source));
}

}  // namespace chain_tracker::haar
