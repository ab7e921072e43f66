// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/parameters.h"

#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>

#include "chain_tracker/chain/target_checks.h"

namespace chain_tracker {
namespace {

using XmlRpc::XmlRpcValue;

const std::set<std::string> kKeys = {
    "image_transport", "models_folder", "default_model", "default_id", "init_timeout",
    "history",         "pixel_size",    "threads",       "targets",    "points"};

/// Read by others in the nodelet's namespace: diagnostic_updater; the worker pool of a process that
/// holds this nodelet alone; plugins of image_transport, for the topics `image` and `~overlay`.
const std::set<std::string> kKeysOfOthers = {"diagnostic_period", "num_worker_threads", "image",
                                             "overlay"};

std::string valueText(const XmlRpcValue& value) {
  std::ostringstream text;
  if (value.getType() == XmlRpcValue::TypeString) {
    text << '\'' << static_cast<std::string>(value) << '\'';
  } else if (value.getType() == XmlRpcValue::TypeBoolean) {
    text << (static_cast<bool>(XmlRpcValue(value)) ? "true" : "false");
  } else {
    value.write(text);
  }
  return text.str();
}

std::string fault(const std::string& key, const XmlRpcValue& value, const std::string& allowed) {
  return "~" + key + " is " + valueText(value) + ", must be " + allowed;
}

std::string unknownKeySentence(const std::string& key, const std::string& known) {
  return "~" + key + " is unknown and has no effect, must be one of " + known;
}

bool isNumber(const XmlRpcValue& value) {
  return value.getType() == XmlRpcValue::TypeDouble || value.getType() == XmlRpcValue::TypeInt;
}

double numberFrom(const XmlRpcValue& value) {
  return value.getType() == XmlRpcValue::TypeInt ? static_cast<int>(value)
                                                 : static_cast<double>(value);
}

/// Reads keys of one struct and collects what is wrong with them.
class Reader {
 public:
  explicit Reader(const XmlRpcValue& tree) : tree_(tree) {}

  void read(const std::string& key, bool may_be_empty, std::string* value) {
    if (!has(key)) return;
    if (tree_[key].getType() != XmlRpcValue::TypeString) {
      faults_ += fault(key, tree_[key], "a string") + "\n";
    } else if (static_cast<std::string>(tree_[key]).empty() && !may_be_empty) {
      faults_ += fault(key, tree_[key], "a string that is not empty") + "\n";
    } else {
      *value = static_cast<std::string>(tree_[key]);
    }
  }

  void readFolder(const std::string& key, std::string* value) {
    read(key, true, value);
    if (value->empty() || std::filesystem::is_directory(*value)) return;
    faults_ += fault(key, tree_[key],
                     "empty or a folder, and there is none at " +
                         std::filesystem::absolute(*value).string()) +
               "\n";
  }

  void read(const std::string& key, double least, double most, double* value) {
    if (!has(key)) return;
    if (isNumber(tree_[key]) && numberFrom(tree_[key]) >= least && numberFrom(tree_[key]) <= most) {
      *value = numberFrom(tree_[key]);
      return;
    }
    std::ostringstream allowed;
    allowed << "a number in [" << least << ", " << most << "]";
    faults_ += fault(key, tree_[key], allowed.str()) + "\n";
  }

  void read(const std::string& key, int least, int most, int* value) {
    if (!has(key)) return;
    if (tree_[key].getType() == XmlRpcValue::TypeInt && static_cast<int>(tree_[key]) >= least &&
        static_cast<int>(tree_[key]) <= most) {
      *value = static_cast<int>(tree_[key]);
      return;
    }
    faults_ +=
        fault(key, tree_[key],
              "an integer in [" + std::to_string(least) + ", " + std::to_string(most) + "]") +
        "\n";
  }

  const std::string& faults() const { return faults_; }

 private:
  bool has(const std::string& key) const { return tree_.valid() && tree_.hasMember(key); }

  const XmlRpcValue tree_;
  std::string faults_;
};

}  // namespace

XmlRpcValue privateParameters(const ros::NodeHandle& private_node) {
  XmlRpcValue tree;
  private_node.getParam(private_node.getNamespace(), tree);
  return tree;
}

TrackerParameters parametersFrom(const XmlRpcValue& tree) {
  TrackerParameters parameters;
  Reader reader(tree);
  reader.read("image_transport", false, &parameters.image_transport);
  reader.readFolder("models_folder", &parameters.models_folder);
  reader.read("default_model", false, &parameters.default_model);
  reader.read("default_id", false, &parameters.default_id);
  reader.read("init_timeout", 0.1, 600.0, &parameters.init_timeout);
  reader.read("history", 0, 1000, &parameters.history);
  reader.read("pixel_size", 1e-6, 1.0, &parameters.pixel_size);
  reader.read("threads", 0, kMostThreads, &parameters.threads);
  if (!reader.faults().empty()) throw std::invalid_argument(reader.faults());
  return parameters;
}

std::vector<std::string> unknownKeysIn(const XmlRpcValue& tree) {
  std::vector<std::string> sentences;
  if (!tree.valid()) return sentences;
  std::string known;
  for (const std::string& key : kKeys) known += (known.empty() ? "~" : ", ~") + key;
  for (const auto& [key, value] : tree) {
    if (kKeys.count(key) == 0 && kKeysOfOthers.count(key) == 0) {
      sentences.push_back(unknownKeySentence(key, known));
    }
  }
  return sentences;
}

}  // namespace chain_tracker
