// SPDX-License-Identifier: BSD-3-Clause
#include "bag_frames.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <cv_bridge/cv_bridge.h>
#include <opencv2/imgcodecs.hpp>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include "chain_tracker/TrackedObjectArray.h"

namespace chain_tracker {
namespace {

constexpr const char* kImageType = "sensor_msgs/Image";
constexpr const char* kCompressedType = "sensor_msgs/CompressedImage";
constexpr const char* kTruthType = "chain_tracker/TrackedObjectArray";
/// A pause this many times the usual one between frames counts as a gap.
constexpr double kGapFactor = 2.5;

/// An open bag with the messages of one topic.
class BagTopic {
 public:
  BagTopic(const std::string& path, const std::string& topic, const std::set<std::string>& types) {
    try {
      bag_.open(path, rosbag::bagmode::Read);
    } catch (const rosbag::BagUnindexedException&) {
      throw std::invalid_argument(path +
                                  " has no index, as a recording cut off has: repair it "
                                  "with `rosbag reindex " +
                                  path + "`");
    } catch (const rosbag::BagException& error) {
      throw std::invalid_argument(path + " cannot be read as a bag: " + error.what());
    }
    requireTopic(path, topic, types);
    view_.addQuery(bag_, rosbag::TopicQuery(topic));
  }

  rosbag::View& view() { return view_; }

 private:
  void requireTopic(const std::string& path, const std::string& topic,
                    const std::set<std::string>& types) {
    rosbag::View all(bag_);
    std::string known;
    for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
      if (types.count(connection->datatype) == 0) continue;
      if (connection->topic == topic) return;
      known += (known.empty() ? "" : ", ") + connection->topic;
    }
    std::string wanted;
    for (const std::string& type : types) wanted += (wanted.empty() ? "" : " or ") + type;
    throw std::invalid_argument(path + " has no topic '" + topic + "' of type " + wanted +
                                "; topics of that type: " + (known.empty() ? "none" : known));
  }

  rosbag::Bag bag_;
  rosbag::View view_;
};

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
      decoded.image = cv_bridge::toCvCopy(raw, sensor_msgs::image_encodings::BGR8)->image;
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
    ++next_;
    ++index_;
    return true;
  }

  int count() const override {
    return static_cast<int>(const_cast<BagTopic&>(topic_).view().size());
  }

 private:
  BagTopic topic_;
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
    if (step <= 0.0) text << "frame " << i << ": the stamp goes back by " << -step << " s";
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

GroundTruth readTruthTopic(const std::string& bag, const std::string& truth_topic,
                           const std::string& image_topic) {
  std::map<ros::Time, int> frame_of;
  BagTopic images(bag, image_topic, kImageTypes);
  for (const rosbag::MessageInstance& message : images.view()) {
    const int index = static_cast<int>(frame_of.size());
    frame_of.emplace(decode(message, false).header.stamp, index);
  }
  GroundTruth truth;
  BagTopic recorded(bag, truth_topic, {kTruthType});
  for (const rosbag::MessageInstance& message : recorded.view()) {
    const auto array = message.instantiate<TrackedObjectArray>();
    const auto frame = frame_of.find(array->header.stamp);
    if (frame == frame_of.end() || array->objects.empty()) continue;
    const TrackedObject& object = array->objects.front();
    if (object.state == TrackedObject::LOST) continue;
    for (std::size_t k = 0; k < object.points.size(); ++k) {
      const TrackedPoint& point = object.points[k];
      truth.points[frame->second][static_cast<int>(k)] = {{point.x, point.y}, point.visible != 0};
    }
  }
  return truth;
}

}  // namespace chain_tracker
