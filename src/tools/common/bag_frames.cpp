// SPDX-License-Identifier: BSD-3-Clause
#include "bag_frames.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include "bag_topic.h"
#include "chain_tracker/ros/image_conversion.h"

namespace chain_tracker {
namespace {

constexpr const char* kImageType = "sensor_msgs/Image";
constexpr const char* kCompressedType = "sensor_msgs/CompressedImage";
/// A pause this many times the usual one between frames counts as a gap.
constexpr double kGapFactor = 2.5;

const std::set<std::string> kImageTypes = {kImageType, kCompressedType};

struct ImageMessage {
  std_msgs::Header header;
  std::string encoding;
  cv::Mat image;
  std::string fault;
};

ImageMessage decode(const rosbag::MessageInstance& message, bool with_pixels) {
  ImageMessage decoded;
  try {
    if (const auto raw = message.instantiate<sensor_msgs::Image>()) {
      decoded.header = raw->header;
      decoded.encoding = raw->encoding;
      if (!with_pixels) return decoded;
      decoded.image = toBgr8(raw)->image.clone();  // which may share the message's memory
    } else if (const auto compressed = message.instantiate<sensor_msgs::CompressedImage>()) {
      decoded.header = compressed->header;
      decoded.encoding = compressed->format;
      if (!with_pixels) return decoded;
      decoded.image = cv::imdecode(compressed->data, cv::IMREAD_COLOR);
    }
    if (decoded.image.empty()) decoded.fault = "no image in a message of " + message.getTopic();
  } catch (const std::exception& error) {
    decoded.fault = "message of " + message.getTopic() + ": " + error.what();
  }
  return decoded;
}

class BagSource : public FrameSource {
 public:
  BagSource(const std::string& path, const std::string& topic)
      : topic_(path, topic, kImageTypes), next_(topic_.view().begin()) {}

  bool next(SourceFrame& frame) override {
    if (next_ == topic_.view().end()) return false;
    const ImageMessage message = decode(*next_, true);
    frame = {index_, message.header.stamp.toSec(), message.image, message.fault};
    if (!frame.fault.empty()) {
      frame.fault = "frame " + std::to_string(index_) + ", a " + frame.fault;
    }
    ++next_;
    ++index_;
    return true;
  }

  int count() const override { return static_cast<int>(topic_.view().size()); }

 private:
  mutable BagTopic topic_;  // a view counts its messages when it is asked
  rosbag::View::iterator next_;
  int index_ = 0;
};

template <typename Value>
std::string listOf(const std::set<Value>& values) {
  std::ostringstream text;
  for (const Value& value : values)
    text << (value == *values.begin() ? "'" : ", '") << value << "'";
  return text.str();
}

std::vector<std::string> findGaps(const std::vector<double>& stamps) {
  std::vector<std::string> findings;
  std::vector<double> steps;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    const double step = stamps[i] - stamps[i - 1];
    if (step > 0.0) steps.push_back(step);
  }
  if (steps.empty()) return findings;
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                   steps.end());
  const double usual = steps[steps.size() / 2];
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    const double step = stamps[i] - stamps[i - 1];
    std::ostringstream text;
    if (step == 0.0) text << "frame " << i << ": the stamp is that of the frame before";
    if (step < 0.0) text << "frame " << i << ": the stamp goes back by " << -step << " s";
    if (step > kGapFactor * usual) {
      text << "frame " << i << ": a gap of " << step << " s, usual are " << usual << " s";
    }
    if (!text.str().empty()) findings.push_back(text.str());
  }
  return findings;
}

}  // namespace

std::unique_ptr<FrameSource> openBagFrames(const std::string& bag, const std::string& topic) {
  return std::make_unique<BagSource>(bag, topic);
}

std::vector<std::string> checkBag(const std::string& bag, const std::string& topic) {
  BagTopic images(bag, topic, kImageTypes);
  std::vector<double> stamps;
  std::set<std::string> frame_ids;
  std::set<std::string> encodings;
  for (const rosbag::MessageInstance& message : images.view()) {
    const ImageMessage decoded = decode(message, false);
    if (!decoded.fault.empty()) continue;  // the run will tell of it
    stamps.push_back(decoded.header.stamp.toSec());
    frame_ids.insert(decoded.header.frame_id);
    encodings.insert(decoded.encoding);
  }
  std::vector<std::string> findings = findGaps(stamps);
  if (stamps.empty()) findings.push_back("there are no messages on " + topic);
  if (frame_ids.size() > 1) findings.push_back("the frame id changes: " + listOf(frame_ids));
  if (frame_ids.count("") != 0) findings.push_back("the frame id is empty");
  if (encodings.size() > 1) findings.push_back("the encoding changes: " + listOf(encodings));
  return findings;
}

double longestPause(const std::map<ros::Time, int>& index_of) {
  double longest = 0.0;
  for (auto later = index_of.begin(); later != index_of.end(); ++later) {
    if (later == index_of.begin()) continue;
    longest = std::max(longest, (later->first - std::prev(later)->first).toSec());
  }
  return longest;
}

std::map<ros::Time, int> indexByStamp(const std::string& bag, const std::string& topic) {
  std::map<ros::Time, int> index_of;
  BagTopic images(bag, topic, kImageTypes);
  int index = 0;
  for (const rosbag::MessageInstance& message : images.view()) {
    index_of.emplace(decode(message, false).header.stamp, index);
    ++index;
  }
  return index_of;
}

std::map<ros::Time, int> indexByOwnStamps(const std::string& bag, const std::string& topic) {
  const auto refuse = [&](int index, const std::string& reason) {
    throw std::invalid_argument(
        bag + ": frame " + std::to_string(index) + " of " + topic + " " + reason +
        ", but a live tracker's messages are matched by stamps; use `evaluate --bag`");
  };
  std::map<ros::Time, int> index_of;
  BagTopic images(bag, topic, kImageTypes);
  int index = 0;
  for (const rosbag::MessageInstance& message : images.view()) {
    const ImageMessage decoded = decode(message, false);
    if (decoded.fault.empty()) {
      if (decoded.header.stamp.isZero()) refuse(index, "has no stamp");
      const auto [same, is_new] = index_of.emplace(decoded.header.stamp, index);
      if (!is_new) refuse(index, "has the stamp of frame " + std::to_string(same->second));
    }
    ++index;
  }
  return index_of;
}

}  // namespace chain_tracker
