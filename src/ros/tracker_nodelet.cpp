// SPDX-License-Identifier: BSD-3-Clause
/// The adapter between ROS and the tracker.
///
/// Three kinds of threads: the nodelet manager's, which only put images into the mailbox; the
/// worker, which tracks and publishes; those of the commands.
#include <algorithm>
#include <chrono>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <boost/make_shared.hpp>
#include <diagnostic_updater/diagnostic_updater.h>
#include <image_transport/image_transport.h>
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>
#include <ros/ros.h>
#include <sensor_msgs/image_encodings.h>

#include "chain_tracker/TrackedObjectArray.h"
#include "chain_tracker/chain/target_checks.h"
#include "chain_tracker/image/color_palette.h"
#include "chain_tracker/ros/frame_mailbox.h"
#include "chain_tracker/ros/image_conversion.h"
#include "chain_tracker/ros/image_history.h"
#include "chain_tracker/ros/log_throttle.h"
#include "chain_tracker/ros/parameters.h"
#include "chain_tracker/ros/target_commands.h"
#include "chain_tracker/ros/target_registry.h"
#include "chain_tracker/ros/tracker_diagnostics.h"
#include "chain_tracker/ros/visualization.h"

namespace chain_tracker {
namespace {

/// Images wait here only until the callback has moved them into the mailbox, where drops count.
constexpr std::uint32_t kImageQueueSize = 5;
constexpr std::uint32_t kPublisherQueueSize = 5;
constexpr std::chrono::seconds kLogPeriod(5);
/// Checks without an image until the user is told where images are awaited; one a second.
constexpr int kPatience = 10;

bool isEmpty(const sensor_msgs::Image& image) { return image.width == 0 || image.height == 0; }

}  // namespace

class TrackerNodelet : public nodelet::Nodelet {
 public:
  TrackerNodelet() = default;
  ~TrackerNodelet() override;

 private:
  void onInit() override;
  void configure();
  void advertise();
  void subscribe();
  void stop();

  void check();
  void receive(const sensor_msgs::ImageConstPtr& image);
  void work();
  cv_bridge::CvImageConstPtr read(const Frame& frame);
  void track(const Frame& frame);
  void log(const FrameResult& result);
  void visualize(const cv_bridge::CvImage& image, const TrackedObjectArray& objects);

  // Set before the first callback, constant ever after
  TrackerParameters parameters_;
  std::string image_topic_;

  // The way of an image
  std::uint64_t frames_received_ = 0;
  bool last_was_empty_ = false;
  int checks_without_image_ = 0;
  int checks_without_report_ = 0;
  std::unique_ptr<ImageHistory> history_;
  FrameMailbox mailbox_;
  TargetRegistry registry_;
  std::unique_ptr<TargetCommands> commands_;
  TrackerDiagnostics diagnostics_;
  LogThrottle throttle_{kLogPeriod};  // of the worker

  // ROS communication
  image_transport::Subscriber image_subscriber_;
  ros::Publisher objects_publisher_;
  ros::Publisher markers_publisher_;
  image_transport::Publisher overlay_publisher_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  ros::WallTimer check_timer_;
  std::thread worker_;
};

TrackerNodelet::~TrackerNodelet() { stop(); }

void TrackerNodelet::stop() {
  image_subscriber_.shutdown();
  check_timer_.stop();
  // Closing ends all waiting, so that the threads can be joined at once; the worker speaks to the
  // commands up to its end.
  registry_.close();
  mailbox_.close();
  if (worker_.joinable()) worker_.join();
  commands_.reset();
}

void TrackerNodelet::onInit() {
  try {
    configure();
    advertise();
    worker_ = std::thread(&TrackerNodelet::work, this);
    subscribe();
  } catch (const std::exception& error) {
    NODELET_FATAL_STREAM(getName() << " is not configured and stays idle: " << error.what());
    stop();
  }
}

void TrackerNodelet::configure() {
  const XmlRpc::XmlRpcValue tree = privateParameters(getPrivateNodeHandle());
  for (const std::string& sentence : unknownKeysIn(tree)) {
    NODELET_ERROR_STREAM(getName() << ": " << sentence);
  }
  parameters_ = parametersFrom(tree);
  prepareForPalettes();
  const int cores = std::min(cv::getNumberOfCPUs(), kMostThreads);
  registry_.useThreads(parameters_.threads > 0 ? parameters_.threads : cores);
  history_ = std::make_unique<ImageHistory>(static_cast<std::size_t>(parameters_.history));
  image_topic_ = getNodeHandle().resolveName("image");
  commands_ = std::make_unique<TargetCommands>(getName(), image_topic_, getPrivateNodeHandle(),
                                               parameters_, &registry_, history_.get());
  commands_->startOnFirstImage(initialTargetsFrom(tree, parameters_));
}

void TrackerNodelet::advertise() {
  ros::NodeHandle node = getPrivateNodeHandle();
  objects_publisher_ = node.advertise<TrackedObjectArray>("objects", kPublisherQueueSize);
  markers_publisher_ =
      node.advertise<visualization_msgs::MarkerArray>("markers", kPublisherQueueSize);
  overlay_publisher_ = image_transport::ImageTransport(node).advertise("overlay", 1);

  updater_ = std::make_unique<diagnostic_updater::Updater>(getNodeHandle(), node, getName());
  updater_->setHardwareID("none");
  updater_->add("tracker", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
    diagnostics_.report(mailbox_.drops(), commands_->paused(), &status);
  });
  check_timer_ =
      node.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { check(); });
}

void TrackerNodelet::subscribe() {
  // Subscribed whether anyone listens or not: a tracker that misses frames loses its objects.
  // Settings of the transport's plugin have a namespace of their own, ~image.
  const image_transport::TransportHints hints(parameters_.image_transport, ros::TransportHints(),
                                              ros::NodeHandle(getPrivateNodeHandle(), "image"));
  try {
    image_subscriber_ =
        image_transport::ImageTransport(getNodeHandle())
            .subscribe("image", kImageQueueSize, &TrackerNodelet::receive, this, hints);
  } catch (const image_transport::TransportLoadException& error) {
    throw std::invalid_argument(
        "~image_transport is '" + parameters_.image_transport +
        "', must be raw or a plugin of image_transport that is installed: " + error.what());
  }
}

void TrackerNodelet::check() {
  // The updater's own clock is of ROS, which stands still or goes back where a bag is played.
  if (++checks_without_report_ >= updater_->getPeriod()) {
    updater_->force_update();
    checks_without_report_ = 0;
  }
  if (frames_received_ > 0 || commands_->paused()) return;
  if (++checks_without_image_ == kPatience) {
    const bool clock_is_silent = ros::Time::isSimTime() && ros::Time::now().isZero();
    NODELET_WARN_STREAM(getName() << ": no image has come on topic " << image_topic_ << " yet; "
                                  << (clock_is_silent
                                          ? "/use_sim_time is true and nothing publishes /clock"
                                          : "remap `image` if this is not the camera's"));
  }
}

void TrackerNodelet::receive(const sensor_msgs::ImageConstPtr& image) {
  if (commands_->paused()) return;
  // image_publisher sends one empty image whenever a video begins again, and nothing else where it
  // cannot read the file.
  const bool last_was_empty = std::exchange(last_was_empty_, isEmpty(*image));
  if (last_was_empty_ && !last_was_empty) return;
  const Frame frame{++frames_received_, image};
  history_->add(frame);
  mailbox_.put(frame);
}

void TrackerNodelet::work() {
  while (const std::optional<Frame> frame = mailbox_.take()) {
    try {
      track(*frame);
    } catch (const std::exception& error) {
      if (!throttle_.passes(frame->image->encoding)) continue;
      NODELET_ERROR_STREAM(getName() << ": topic " << image_topic_ << ": " << error.what());
    }
  }
}

cv_bridge::CvImageConstPtr TrackerNodelet::read(const Frame& frame) {
  try {
    cv_bridge::CvImageConstPtr image = toBgr8(frame.image);
    commands_->noteImage("");
    return image;
  } catch (const std::exception& error) {
    commands_->noteImage(error.what());
    diagnostics_.recordUnreadable(error.what());
    throw;
  }
}

void TrackerNodelet::track(const Frame& frame) {
  const auto start = std::chrono::steady_clock::now();
  const cv_bridge::CvImageConstPtr image = read(frame);
  FrameResult result = registry_.process(frame, image->image);

  const auto objects = boost::make_shared<TrackedObjectArray>();
  objects->header = frame.image->header;
  objects->objects = std::move(result.objects);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  objects->processing_time = ros::Duration(elapsed.count());
  objects_publisher_.publish(objects);

  diagnostics_.record(*objects, ros::Time::now() - objects->header.stamp);
  log(result);
  visualize(*image, *objects);
}

void TrackerNodelet::log(const FrameResult& result) {
  for (const std::string& note : result.notes) NODELET_WARN_STREAM(getName() << ": " << note);
  for (const FrameResult::Fault& fault : result.faults) {
    if (!throttle_.passes("object " + fault.id)) continue;
    NODELET_ERROR_STREAM(getName() << ": '" << fault.id << "': " << fault.reason);
  }
}

void TrackerNodelet::visualize(const cv_bridge::CvImage& image, const TrackedObjectArray& objects) {
  if (overlay_publisher_.getNumSubscribers() > 0) {
    overlay_publisher_.publish(cv_bridge::CvImage(objects.header,
                                                  sensor_msgs::image_encodings::BGR8,
                                                  drawOverlay(image.image, objects))
                                   .toImageMsg());
  }
  if (markers_publisher_.getNumSubscribers() > 0) {
    markers_publisher_.publish(toMarkers(objects, parameters_.pixel_size));
  }
}

}  // namespace chain_tracker

PLUGINLIB_EXPORT_CLASS(chain_tracker::TrackerNodelet, nodelet::Nodelet)
