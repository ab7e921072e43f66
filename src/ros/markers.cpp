// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>

#include "chain_tracker/ros/visualization.h"

namespace chain_tracker {
namespace {

using visualization_msgs::Marker;

/// Of the label [px].
constexpr double kLetterHeight = 20.0;

/// Ids of an object's markers within its namespace.
enum MarkerId { kWindows, kChain, kCentres, kLabel };

/// From the image to the marker's plane.
class Plane {
 public:
  explicit Plane(double pixel_size) : pixel_size_(pixel_size) {}

  double length(double pixels) const { return pixels * pixel_size_; }
  geometry_msgs::Point point(double x, double y) const {
    geometry_msgs::Point point;
    point.x = length(x);
    point.y = length(y);
    return point;
  }

 private:
  double pixel_size_;
};

Marker markerOf(const std_msgs::Header& header, const std::string& id, MarkerId number, int type) {
  Marker marker;
  marker.header = header;
  marker.ns = id;
  marker.id = number;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.color.a = 1.0;
  return marker;
}

double meanSize(const TrackedObject& object) {
  double sum = 0.0;
  for (const PartPose& part : object.parts) sum += part.size;
  return sum / static_cast<double>(std::max<std::size_t>(1, object.parts.size()));
}

/// The four sides of every part's window.
Marker windowsOf(const std_msgs::Header& header, const TrackedObject& object, const Plane& plane) {
  Marker marker = markerOf(header, object.id, kWindows, Marker::LINE_LIST);
  marker.scale.x = plane.length(0.04 * meanSize(object));
  for (const PartPose& part : object.parts) {
    const double half = 0.5 * part.size;
    const double cosine = half * std::cos(part.pose.theta);
    const double sine = half * std::sin(part.pose.theta);
    const auto corner = [&](int along, int across) {
      return plane.point(part.pose.x + along * cosine - across * sine,
                         part.pose.y + along * sine + across * cosine);
    };
    for (const auto& end : {corner(-1, -1), corner(1, -1), corner(1, -1), corner(1, 1),
                            corner(1, 1), corner(-1, 1), corner(-1, 1), corner(-1, -1)}) {
      marker.points.push_back(end);
      marker.colors.push_back(colorOf(part.confidence, part.visible));
    }
  }
  return marker;
}

Marker partsAs(int type, MarkerId number, const std_msgs::Header& header,
               const TrackedObject& object, const Plane& plane) {
  Marker marker = markerOf(header, object.id, number, type);
  for (const PartPose& part : object.parts) {
    marker.points.push_back(plane.point(part.pose.x, part.pose.y));
    marker.colors.push_back(colorOf(part.confidence, part.visible));
  }
  return marker;
}

Marker chainOf(const std_msgs::Header& header, const TrackedObject& object, const Plane& plane) {
  Marker marker = partsAs(Marker::LINE_STRIP, kChain, header, object, plane);
  marker.scale.x = plane.length(0.1 * meanSize(object));
  return marker;
}

Marker centresOf(const std_msgs::Header& header, const TrackedObject& object, const Plane& plane) {
  Marker marker = partsAs(Marker::SPHERE_LIST, kCentres, header, object, plane);
  marker.scale.x = marker.scale.y = marker.scale.z = plane.length(0.3 * meanSize(object));
  return marker;
}

/// Above the highest part.
Marker labelOf(const std_msgs::Header& header, const TrackedObject& object, const Plane& plane) {
  Marker marker = markerOf(header, object.id, kLabel, Marker::TEXT_VIEW_FACING);
  double top = object.pose.y;
  for (const PartPose& part : object.parts) top = std::min(top, part.pose.y - 0.5 * part.size);
  marker.pose.position = plane.point(object.pose.x, top - kLetterHeight);
  marker.scale.z = plane.length(kLetterHeight);
  marker.color = colorOf(object.confidence, true);
  marker.text = object.id + " " + std::to_string(std::lround(100.0 * object.confidence)) + " %";
  return marker;
}

}  // namespace

std_msgs::ColorRGBA colorOf(double confidence, bool visible) {
  std_msgs::ColorRGBA color;
  color.a = 1.0f;
  if (!visible) {
    color.r = color.g = color.b = 0.6f;
    return color;
  }
  const auto share = static_cast<float>(std::min(1.0, std::max(0.0, confidence)));
  color.r = std::min(1.0f, 2.0f - 2.0f * share);
  color.g = 0.15f + 0.85f * std::min(1.0f, 2.0f * share);
  color.b = 0.15f;
  return color;
}

visualization_msgs::MarkerArray toMarkers(const TrackedObjectArray& objects, double pixel_size) {
  const Plane plane(pixel_size);
  visualization_msgs::MarkerArray array;
  Marker delete_all;
  delete_all.header = objects.header;
  delete_all.action = Marker::DELETEALL;
  array.markers.push_back(delete_all);
  for (const TrackedObject& object : objects.objects) {
    // A line needs two points, and rviz refuses lists without any.
    if (object.state == TrackedObject::LOST || object.parts.empty()) continue;
    array.markers.push_back(windowsOf(objects.header, object, plane));
    if (object.parts.size() > 1) array.markers.push_back(chainOf(objects.header, object, plane));
    array.markers.push_back(centresOf(objects.header, object, plane));
    array.markers.push_back(labelOf(objects.header, object, plane));
  }
  return array;
}

}  // namespace chain_tracker
