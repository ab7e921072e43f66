// SPDX-License-Identifier: BSD-3-Clause
/// What users say to the nodelet: its services, the topic ~init_polygon, the initial targets.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include <geometry_msgs/PolygonStamped.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include "chain_tracker/RemoveTarget.h"
#include "chain_tracker/SetTarget.h"
#include "chain_tracker/ros/image_history.h"
#include "chain_tracker/ros/model_folder.h"
#include "chain_tracker/ros/parameters.h"
#include "chain_tracker/ros/target_registry.h"

namespace chain_tracker {

/// Serves its commands in threads of its own: some of them wait for an image, and would otherwise
/// keep a manager of few threads from delivering it.
class TargetCommands {
 public:
  /// `name` begins every line of the log, `image_topic` is named where no image comes.
  /// The registry and the history must outlive this object. Throws std::invalid_argument if there
  /// is no such default model.
  TargetCommands(const std::string& name, const std::string& image_topic,
                 const ros::NodeHandle& private_node, const TrackerParameters& parameters,
                 TargetRegistry* registry, const ImageHistory* history);
  /// The registry must be closed, so that no command waits.
  ~TargetCommands();

  /// Starts objects on the first image, and logs what is refused.
  void startOnFirstImage(const InitialTargets& targets);

  /// Why the last image could not be read, for those who wait for one; empty if it could.
  void noteImage(const std::string& fault);

  /// Whether images are to be ignored.
  bool paused() const { return paused_; }

 private:
  bool setTarget(SetTarget::Request& request, SetTarget::Response& response);
  bool removeTarget(RemoveTarget::Request& request, RemoveTarget::Response& response);
  bool reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  void receivePolygon(const geometry_msgs::PolygonStampedConstPtr& polygon);
  bool takesCorners(const std::string& model) const;

  std::string start(const TargetRequest& request, const ChainModel& model, const ros::Time& stamp);
  void startOnNextImage(const TargetRequest& request, const ChainModel& model);
  [[noreturn]] void refuseForWantOfAnImage(const std::string& reason) const;

  const std::string name_;
  const std::string image_topic_;
  const TrackerParameters parameters_;
  const ModelFolder models_;
  TargetRegistry* const registry_;
  const ImageHistory* const history_;
  std::atomic<bool> paused_{false};
  mutable std::mutex image_fault_mutex_;
  std::string image_fault_;

  ros::CallbackQueue queue_;
  std::vector<ros::ServiceServer> services_;
  ros::Subscriber polygon_subscriber_;
  ros::AsyncSpinner spinner_;
};

}  // namespace chain_tracker
