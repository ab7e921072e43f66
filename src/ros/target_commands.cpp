// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/target_commands.h"

#include <chrono>
#include <exception>
#include <future>
#include <memory>
#include <sstream>
#include <stdexcept>

#include <ros/console.h>

namespace chain_tracker {
namespace {

constexpr std::uint32_t kPolygonQueueSize = 5;
/// One command may wait for an image while others are served.
constexpr std::uint32_t kThreads = 2;
/// By which the last click of a closed outline misses the first, at most [px].
constexpr double kClosingGap = 5.0;
constexpr char kAuto[] = "auto";

bool isClosedQuadrilateral(const std::vector<cv::Point2d>& points) {
  return points.size() == 5 && cv::norm(points.front() - points.back()) <= kClosingGap;
}

void requireDefaultModel(const std::string& model, const ModelFolder& models) {
  if (model == kAuto) return;
  try {
    models.load(model);
  } catch (const std::exception& error) {
    throw std::invalid_argument(std::string("~default_model: ") + error.what());
  }
}

}  // namespace

TargetCommands::TargetCommands(const std::string& name, const std::string& image_topic,
                               const ros::NodeHandle& private_node,
                               const TrackerParameters& parameters, TargetRegistry* registry,
                               const ImageHistory* history)
    : name_(name),
      image_topic_(image_topic),
      parameters_(parameters),
      models_(parameters.models_folder.empty() ? ModelFolder::ofThisPackage()
                                               : parameters.models_folder),
      registry_(registry),
      history_(history),
      spinner_(kThreads, &queue_) {
  requireDefaultModel(parameters_.default_model, models_);
  ros::NodeHandle node = private_node;
  node.setCallbackQueue(&queue_);
  services_ = {node.advertiseService("set_target", &TargetCommands::setTarget, this),
               node.advertiseService("remove_target", &TargetCommands::removeTarget, this),
               node.advertiseService("reset", &TargetCommands::reset, this),
               node.advertiseService("pause", &TargetCommands::pause, this)};
  polygon_subscriber_ =
      node.subscribe("init_polygon", kPolygonQueueSize, &TargetCommands::receivePolygon, this);
  spinner_.start();
}

TargetCommands::~TargetCommands() { spinner_.stop(); }

void TargetCommands::startOnFirstImage(const InitialTargets& targets) {
  for (const std::string& fault : targets.faults) ROS_FATAL_STREAM(name_ << ": " << fault);
  for (const TargetRequest& request : targets.requests) {
    const auto answer = [name = name_, id = request.id](const std::string& refusal) {
      if (!refusal.empty()) {
        ROS_ERROR_STREAM(name << ": '" << id << "' is not tracked: " << refusal);
      }
    };
    try {
      registry_->startAtNextFrame(request, models_.loadFor(request.points, request.model), answer);
    } catch (const std::exception& error) {
      answer(error.what());
    }
  }
}

void TargetCommands::noteImage(const std::string& fault) {
  const std::lock_guard<std::mutex> lock(image_fault_mutex_);
  image_fault_ = fault;
}

bool TargetCommands::setTarget(SetTarget::Request& request, SetTarget::Response& response) {
  TargetRequest target{request.id.empty() ? parameters_.default_id : request.id,
                       request.model.empty() ? parameters_.default_model : request.model,
                       {}};
  for (const auto& point : request.points) target.points.emplace_back(point.x, point.y);
  try {
    response.message = start(target, models_.loadFor(target.points, target.model), request.stamp);
    response.success = true;
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  return true;  // the call itself has worked; the response says how it went
}

void TargetCommands::receivePolygon(const geometry_msgs::PolygonStampedConstPtr& polygon) {
  TargetRequest target{parameters_.default_id, parameters_.default_model, {}};
  for (const auto& point : polygon->polygon.points) target.points.emplace_back(point.x, point.y);
  // Tools differ in whether they pass on the image's stamp or write the time of the click.
  const ros::Time& stamp = polygon->header.stamp;
  try {
    const bool is_box = isClosedQuadrilateral(target.points) && takesCorners(target.model);
    if (is_box) target.points.pop_back();
    const ChainModel model = is_box && target.model == kAuto
                                 ? models_.loadForAuto(target.points, "box")
                                 : models_.loadFor(target.points, target.model);
    start(target, model, history_->holds(stamp) ? stamp : ros::Time());
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM(name_ << ": ~init_polygon is refused: " << error.what());
  }
}

/// Whether the model is a rectangle: the last point of any other outline counts.
bool TargetCommands::takesCorners(const std::string& model) const {
  if (model == kAuto) return true;
  const ChainModel loaded = models_.load(model);
  return loaded.segments.size() == 1 && !loaded.segment_per_edge &&
         isGrid(loaded.segments.front().layout);
}

/// Returns what was done; throws with the reason why not.
std::string TargetCommands::start(const TargetRequest& request, const ChainModel& model,
                                  const ros::Time& stamp) {
  if (paused_) throw std::runtime_error("the tracker is paused, call ~pause with false first");
  if (stamp.isZero()) {
    startOnNextImage(request, model);
  } else {
    registry_->startAt(history_->at(stamp), request, model, *history_);
  }
  return "'" + request.id + "' is tracked with the model '" + model.name + "'";
}

void TargetCommands::startOnNextImage(const TargetRequest& request, const ChainModel& model) {
  const auto refusal = std::make_shared<std::promise<std::string>>();
  std::future<std::string> answer = refusal->get_future();
  const std::uint64_t ticket = registry_->startAtNextFrame(
      request, model, [refusal](const std::string& text) { refusal->set_value(text); });
  const std::chrono::duration<double> timeout(parameters_.init_timeout);
  if (answer.wait_for(timeout) == std::future_status::timeout) {
    if (const auto reason = registry_->withdraw(ticket)) refuseForWantOfAnImage(*reason);
  }
  const std::string text = answer.get();
  if (!text.empty()) throw std::runtime_error(text);
}

/// `reason`: why the images that came do not do, if they can be read.
void TargetCommands::refuseForWantOfAnImage(const std::string& reason) const {
  const std::lock_guard<std::mutex> lock(image_fault_mutex_);
  const std::string& fault = image_fault_.empty() ? reason : image_fault_;
  std::ostringstream sentence;
  sentence << "no image on topic " << image_topic_ << " within " << parameters_.init_timeout << " s"
           << (paused_ ? ", as the tracker has been paused" : "")
           << (fault.empty() ? "" : " that can be used: " + fault);
  throw std::runtime_error(sentence.str());
}

bool TargetCommands::removeTarget(RemoveTarget::Request& request,
                                  RemoveTarget::Response& response) {
  const std::string& id = request.id.empty() ? parameters_.default_id : request.id;
  response.success = registry_->remove(id);
  response.message = "'" + id + "' " + (response.success ? "is removed" : "is unknown");
  return true;
}

bool TargetCommands::reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  const std::size_t count = registry_->restartAll();
  response.success = true;
  response.message = std::to_string(count) + " objects start again on the next image";
  return true;
}

bool TargetCommands::pause(std_srvs::SetBool::Request& request,
                           std_srvs::SetBool::Response& response) {
  paused_ = request.data;
  response.success = true;
  response.message = paused_ ? "images are ignored now" : "images are processed now";
  return true;
}

}  // namespace chain_tracker
