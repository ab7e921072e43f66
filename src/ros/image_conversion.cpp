// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/image_conversion.h"

#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include <boost/make_shared.hpp>
#include <sensor_msgs/image_encodings.h>

namespace chain_tracker {
namespace {

namespace encodings = sensor_msgs::image_encodings;

std::string describe(const sensor_msgs::Image& message) {
  return "image of encoding '" + message.encoding + "', " + std::to_string(message.width) + " x " +
         std::to_string(message.height) + " px";
}

/// The colour encoding that a plain OpenCV encoding stands for; any other is itself.
std::string colorEncodingOf(const std::string& encoding) {
  static const std::map<std::string, std::string> kColorEncodings = {
      {encodings::TYPE_8UC1, encodings::MONO8},  {encodings::TYPE_8UC3, encodings::BGR8},
      {encodings::TYPE_8UC4, encodings::BGRA8},  {encodings::TYPE_16UC1, encodings::MONO16},
      {encodings::TYPE_16UC3, encodings::BGR16}, {encodings::TYPE_16UC4, encodings::BGRA16},
  };
  const auto found = kColorEncodings.find(encoding);
  return found == kColorEncodings.end() ? encoding : found->second;
}

/// cv_bridge fails on values of 16 bits whose upper byte comes first.
sensor_msgs::ImageConstPtr lowByteFirst(const sensor_msgs::ImageConstPtr& message) {
  if (message->is_bigendian == 0 || encodings::bitDepth(message->encoding) != 16) return message;
  const auto swapped = boost::make_shared<sensor_msgs::Image>(*message);
  swapped->is_bigendian = 0;
  for (std::size_t i = 1; i < swapped->data.size(); i += 2) {
    std::swap(swapped->data[i - 1], swapped->data[i]);
  }
  return swapped;
}

}  // namespace

cv_bridge::CvImageConstPtr toBgr8(const sensor_msgs::ImageConstPtr& message) {
  if (message->width == 0 || message->height == 0) {
    throw std::invalid_argument(describe(*message) + " is empty");
  }
  try {
    const sensor_msgs::ImageConstPtr readable = lowByteFirst(message);
    const std::string color_encoding = colorEncodingOf(readable->encoding);
    if (color_encoding == readable->encoding) {
      return cv_bridge::toCvShare(readable, encodings::BGR8);
    }
    auto renamed = boost::make_shared<cv_bridge::CvImage>(*cv_bridge::toCvShare(readable));
    renamed->encoding = color_encoding;
    // cvtColor copies even where there is nothing to convert.
    return color_encoding == encodings::BGR8 ? renamed
                                             : cv_bridge::cvtColor(renamed, encodings::BGR8);
  } catch (const std::exception& error) {
    throw std::invalid_argument(describe(*message) +
                                " cannot be used, allowed is every colour, grey or Bayer encoding "
                                "of 8 or 16 bits: " +
                                error.what());
  }
}

}  // namespace chain_tracker
