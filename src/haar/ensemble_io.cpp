// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/haar/ensemble_io.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include <yaml-cpp/yaml.h>

#include "yaml/yaml_document.h"

namespace chain_tracker::haar {
namespace {

/// One place in a document.
class Reader {
 public:
  Reader(const YAML::Node& node, std::string source, int line)
      : node_(node), source_(std::move(source)), line_(line) {}

  /// The values of exactly these keys, in this order.
  std::vector<Reader> values(const std::vector<std::string>& keys) const {
    if (!node_.IsMap()) refuse("must be a map with the keys " + listOf(keys));
    std::map<std::string, Reader> found;
    for (const auto& entry : node_) {
      const Reader key(entry.first, source_, entry.first.Mark().line + 1);
      const std::string name = key.text("a key");
      if (std::find(keys.begin(), keys.end(), name) == keys.end()) {
        key.refuse("unknown key '" + name + "', must be one of " + listOf(keys));
      }
      if (!found.emplace(name, Reader(entry.second, source_, key.line_)).second) {
        key.refuse("key '" + name + "' is there twice");
      }
    }
    std::vector<Reader> values;  // assigning one YAML node to another would change the document
    for (const std::string& key : keys) {
      const auto value = found.find(key);
      if (value == found.end()) refuse("key '" + key + "' is missing");
      values.push_back(value->second);
    }
    return values;
  }

  std::vector<Reader> items(const std::string& kind) const {
    if (!node_.IsSequence()) refuse("must be a list of " + kind);
    std::vector<Reader> items;
    for (const YAML::Node& item : node_) items.emplace_back(item, source_, item.Mark().line + 1);
    return items;
  }

  std::string text(const std::string& kind) const { return as<std::string>(kind); }
  int integer() const { return as<int>("a whole number"); }

  [[noreturn]] void refuse(const std::string& reason) const {
    throw std::invalid_argument(source_ + ":" + std::to_string(line_) + ": " + reason);
  }

 private:
  template <typename Value>
  Value as(const std::string& kind) const {
    if (!node_.IsScalar()) refuse("must be " + kind);
    try {
      return node_.as<Value>();
    } catch (const YAML::Exception&) {
      refuse("'" + node_.Scalar() + "' must be " + kind);
    }
  }

  static std::string listOf(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list;
  }

  YAML::Node node_;
  std::string source_;
  int line_;
};

WeightedRectangle readRectangle(const Reader& reader) {
  const std::vector<Reader> items = reader.items("[x, y, width, height, weight]");
  if (items.size() != 5) {
    reader.refuse("has " + std::to_string(items.size()) +
                  " numbers, must be [x, y, width, height, weight]");
  }
  return {items[0].integer(), items[1].integer(), items[2].integer(), items[3].integer(),
          items[4].integer()};
}

HaarFeature readFeature(const Reader& reader) {
  const std::vector<Reader> values = reader.values({"name", "rectangles"});
  HaarFeature feature;
  feature.name = values[0].text("text");
  for (const Reader& item : values[1].items("rectangles")) {
    feature.rectangles.push_back(readRectangle(item));
  }
  const std::string fault = faultOf(feature);
  if (!fault.empty()) reader.refuse(fault);
  return feature;
}

}  // namespace

FeatureEnsemble parseEnsemble(const std::string& yaml, const std::string& source) {
  const YAML::Node document = parseYamlDocument(yaml, source);
  const Reader reader(document, source, std::max(1, document.Mark().line + 1));
  const std::vector<Reader> values = reader.values({"name", "features"});
  const std::string name = values[0].text("text");
  std::vector<HaarFeature> features;
  std::set<std::string> names;
  for (const Reader& item : values[1].items("features")) {
    features.push_back(readFeature(item));
    if (!names.insert(features.back().name).second) {
      item.refuse("feature '" + features.back().name + "' is there twice");
    }
  }
  if (features.empty()) values[1].refuse("ensemble '" + name + "' has no features");
  return {name, std::move(features)};
}

FeatureEnsemble loadEnsemble(const std::string& path) {
  return parseEnsemble(textOfFile(path, "ensemble"), path);
}

CascadeFeatures loadCascade(const std::string& path) {
  return parseCascade(textOfFile(path, "ensemble"), path);
}

}  // namespace chain_tracker::haar
