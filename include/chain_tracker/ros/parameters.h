// SPDX-License-Identifier: BSD-3-Clause
/// The nodelet's private parameters: the only place where they are read, and their only defaults.
///
/// The functions take the nodelet's private namespace as one value, a struct or nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include "chain_tracker/ros/target_request.h"

namespace chain_tracker {

struct TrackerParameters {
  std::string image_transport = "raw";  ///< transport of the topic `image`
  std::string models_folder;            ///< of the models by name; empty = those of this package
  std::string default_model = "auto";   ///< of objects given without a model
  std::string default_id = "target";    ///< of objects given without an id
  double init_timeout = 5.0;            ///< longest wait for an image [s], in [0.1, 600]
  int history = 30;                     ///< images held for ~set_target with a stamp, in [0, 1000]
  double pixel_size = 0.001;            ///< of the markers [m/px], in [1e-6, 1]
  int threads = 0;                      ///< of an update, in [0, 256]; 0: one a core
};

/// The private parameters of a node as one value.
XmlRpc::XmlRpcValue privateParameters(const ros::NodeHandle& private_node);

/// Throws std::invalid_argument: every parameter of a wrong type or out of range, one a line, with
/// its value and what is allowed.
TrackerParameters parametersFrom(const XmlRpc::XmlRpcValue& tree);

/// One sentence for every private key that no one reads, with the keys there are.
std::vector<std::string> unknownKeysIn(const XmlRpc::XmlRpcValue& tree);

/// Points written "x,y,x,y,..."; nullopt unless they are at least two and nothing else.
std::optional<std::vector<cv::Point2d>> pointsFromText(const std::string& text);

/// The objects to track from the first image on: `~targets` and `~points`.
struct InitialTargets {
  std::vector<TargetRequest> requests;
  std::vector<std::string> faults;  ///< one for each object left out: key, value, what is allowed
};
InitialTargets initialTargetsFrom(const XmlRpc::XmlRpcValue& tree,
                                  const TrackerParameters& parameters);

}  // namespace chain_tracker
