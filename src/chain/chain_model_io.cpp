// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/chain/chain_model_io.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include <yaml-cpp/yaml.h>

#include "yaml/yaml_document.h"

namespace chain_tracker {
namespace {

/// Lines of the keys read, by their paths as in the sentences of faultsOf().
using KeyLines = std::map<std::string, int>;

/// One place in a document: for errors that name file, line and key.
class Reader {
 public:
  Reader(const YAML::Node& node, std::string source, std::string path, int line, KeyLines* lines)
      : node_(node),
        source_(std::move(source)),
        path_(std::move(path)),
        line_(line),
        lines_(lines) {
    (*lines_)[path_] = line_;
  }

  using Readers = std::map<std::string, std::function<void(const Reader&)>>;

  /// Reads a map; every key must have a reader and may be there once.
  void readMap(const Readers& readers) const {
    if (!node_.IsMap()) refuse("must be a map of keys");
    std::set<std::string> seen;
    for (const auto& entry : node_) {
      const int line = entry.first.Mark().line + 1;
      const Reader key(entry.first, source_, path_, line, lines_);
      const std::string name = key.as<std::string>("a name");
      const auto reader = readers.find(name);
      if (reader == readers.end()) {
        key.refuse("unknown key '" + name + "', must be one of: " + namesOf(readers));
      }
      if (!seen.insert(name).second) key.refuse("key '" + name + "' is there twice");
      const std::string path = path_.empty() ? name : path_ + "/" + name;
      reader->second(Reader(entry.second, source_, path, line, lines_));
    }
  }

  std::vector<Reader> items() const {
    if (!node_.IsSequence()) refuse("must be a list");
    std::vector<Reader> items;
    for (size_t i = 0; i < node_.size(); ++i) {
      items.emplace_back(node_[i], source_, path_ + "[" + std::to_string(i) + "]",
                         node_[i].Mark().line + 1, lines_);
    }
    return items;
  }

  template <typename Value>
  Value as(const std::string& kind) const {
    if (!node_.IsScalar()) refuse("is '" + textOf(node_) + "', must be " + kind);
    try {
      return node_.as<Value>();
    } catch (const YAML::Exception&) {
      refuse("is '" + textOf(node_) + "', must be " + kind);
    }
  }

  void read(int& value) const { value = as<int>("a whole number"); }
  void read(bool& value) const { value = as<bool>("true or false"); }
  void read(double& value) const { value = as<double>("a number"); }
  void read(std::string& value) const { value = as<std::string>("text"); }
  void read(Layout& value) const {
    const std::map<std::string, Layout> layouts = {{"elongated", Layout::kElongated},
                                                   {"planar", Layout::kPlanar},
                                                   {"deformable", Layout::kDeformable},
                                                   {"points", Layout::kPoints}};
    const std::string name = as<std::string>("text");
    const auto layout = layouts.find(name);
    if (layout == layouts.end()) {
      refuse("is '" + name + "', must be one of: " + namesOf(layouts));
    }
    value = layout->second;
  }

  [[noreturn]] void refuse(const std::string& reason) const {
    throw std::invalid_argument(source_ + ":" + std::to_string(line_) + ": " +
                                (path_.empty() ? "" : path_ + " ") + reason);
  }

 private:
  template <typename Map>
  static std::string namesOf(const Map& map) {
    std::string names;
    for (const auto& entry : map) names += (names.empty() ? "" : ", ") + entry.first;
    return names;
  }

  static std::string textOf(const YAML::Node& node) {
    std::ostringstream text;
    text << node;
    return text.str();
  }

  YAML::Node node_;
  std::string source_;
  std::string path_;
  int line_;
  KeyLines* lines_;
};

template <typename Value>
std::function<void(const Reader&)> into(Value& value) {
  return [&value](const Reader& reader) { reader.read(value); };
}

void readSegment(const Reader& reader, SegmentModel& segment) {
  reader.readMap({{"name", into(segment.name)},
                  {"layout", into(segment.layout)},
                  {"parts", into(segment.parts)},
                  {"aspect", into(segment.aspect)},
                  {"measure_aspect", into(segment.measure_aspect)},
                  {"margin", into(segment.margin)},
                  {"window", into(segment.window)},
                  {"measure_window", into(segment.measure_window)},
                  {"stretch_sigma", into(segment.stretch_sigma)},
                  {"bend_sigma", into(segment.bend_sigma)},
                  {"shape_memory", into(segment.shape_memory)},
                  {"orientation_hypotheses", into(segment.orientation_hypotheses)},
                  {"orientation_step", into(segment.orientation_step)},
                  {"orientation_sigma", into(segment.orientation_sigma)},
                  {"scale_hypotheses", into(segment.scale_hypotheses)},
                  {"scale_step", into(segment.scale_step)},
                  {"scale_sigma", into(segment.scale_sigma)}});
}

void readAppearance(const Reader& reader, AppearanceModel& appearance) {
  reader.readMap({{"palette_colors", into(appearance.palette_colors)},
                  {"ring", into(appearance.ring)},
                  {"min_object_share", into(appearance.min_object_share)},
                  {"weight", into(appearance.weight)},
                  {"edge_weight", into(appearance.edge_weight)},
                  {"haar_weight", into(appearance.haar_weight)},
                  {"outlier_below", into(appearance.outlier_below)},
                  {"outlier_slope", into(appearance.outlier_slope)},
                  {"light_rate", into(appearance.light_rate)}});
}

void readSearch(const Reader& reader, SearchModel& search) {
  reader.readMap({{"radius", into(search.radius)},
                  {"lost_below", into(search.lost_below)},
                  {"found_above", into(search.found_above)},
                  {"lost_share", into(search.lost_share)},
                  {"occluded_below", into(search.occluded_below)},
                  {"travel_weight", into(search.travel_weight)},
                  {"doubt_below", into(search.doubt_below)}});
}

void readSegments(const Reader& reader, std::vector<SegmentModel>& segments) {
  segments.clear();
  for (const Reader& item : reader.items()) {
    segments.emplace_back();
    readSegment(item, segments.back());
  }
}

void readJoints(const Reader& reader, std::vector<JointModel>& joints) {
  for (const Reader& item : reader.items()) {
    joints.emplace_back();
    item.readMap({{"min_angle", into(joints.back().min_angle)},
                  {"max_angle", into(joints.back().max_angle)}});
  }
}

/// `lines`: each sentence of faultsOf() begins with its key.
void requireUsable(const ChainModel& model, const std::string& source, const KeyLines& lines) {
  std::string message;
  for (const std::string& fault : faultsOf(model)) {
    const auto line = lines.find(fault.substr(0, fault.find(' ')));
    const std::string place =
        line == lines.end() ? source : source + ":" + std::to_string(line->second);
    if (!message.empty()) message += '\n';
    message.append(place).append(": ").append(fault);
  }
  if (!message.empty()) throw std::invalid_argument(message);
}

}  // namespace

ChainModel parseChainModel(const std::string& yaml, const std::string& source) {
  const YAML::Node document = parseYamlDocument(yaml, source);
  ChainModel model;
  KeyLines lines;
  Reader(document, source, "", std::max(1, document.Mark().line + 1), &lines)
      .readMap({{"name", into(model.name)},
                {"segments", [&](const Reader& r) { readSegments(r, model.segments); }},
                {"segment_per_edge", into(model.segment_per_edge)},
                {"joints", [&](const Reader& r) { readJoints(r, model.joints); }},
                {"appearance", [&](const Reader& r) { readAppearance(r, model.appearance); }},
                {"search", [&](const Reader& r) { readSearch(r, model.search); }}});
  requireUsable(model, source, lines);
  return model;
}

ChainModel loadChainModel(const std::string& path) {
  return parseChainModel(textOfFile(path, "model"), path);
}

}  // namespace chain_tracker
