// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/visualization.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace chain_tracker {
namespace {

using visualization_msgs::Marker;

const cv::Size kSize(640, 480);

PartPose part(double x, double y, float size, double theta = 0.0) {
  PartPose part;
  part.pose.x = x;
  part.pose.y = y;
  part.pose.theta = theta;
  part.size = size;
  part.confidence = 1.0f;
  part.visible = true;
  return part;
}

/// Parts in a row at y = 200, far from the label.
TrackedObject row(const std::string& id) {
  TrackedObject object;
  object.id = id;
  object.state = TrackedObject::TRACKING;
  object.confidence = 0.87f;
  object.pose.x = 150.0;
  object.pose.y = 200.0;
  object.parts = {part(100.0, 200.0, 40.0f), part(200.0, 200.0, 40.0f)};
  object.roi.x_offset = 80;
  object.roi.y_offset = 180;
  object.roi.width = 140;
  object.roi.height = 40;
  return object;
}

TrackedObject lost(const std::string& id) {
  TrackedObject object = row(id);
  object.state = TrackedObject::LOST;
  object.roi = sensor_msgs::RegionOfInterest();
  for (PartPose& part : object.parts) {
    part.pose.x = part.pose.y = part.pose.theta = std::numeric_limits<double>::quiet_NaN();
  }
  return object;
}

TrackedObjectArray array(const std::vector<TrackedObject>& objects) {
  TrackedObjectArray array;
  array.header.frame_id = "camera";
  array.header.stamp = ros::Time(12.5);
  array.objects = objects;
  return array;
}

/// Where the overlay differs from the image.
cv::Mat1b drawnOn(const cv::Mat& image, const TrackedObjectArray& objects) {
  cv::Mat difference;
  cv::absdiff(image, drawOverlay(image, objects), difference);
  std::vector<cv::Mat> channels;
  cv::split(difference, channels);
  return cv::Mat1b(cv::max(channels[0], cv::max(channels[1], channels[2])));
}

cv::Mat blackImage(const cv::Size& size = kSize) { return cv::Mat(size, CV_8UC3, cv::Scalar()); }

TEST(ColorOf, GoesFromRedToGreenAndIsGreyForHidden) {
  EXPECT_GT(colorOf(0.0, true).r, colorOf(0.0, true).g);
  EXPECT_LT(colorOf(1.0, true).r, colorOf(1.0, true).g);
  EXPECT_FLOAT_EQ(colorOf(1.0, false).r, colorOf(1.0, false).g);
  EXPECT_EQ(colorOf(2.0, true), colorOf(1.0, true));
}

TEST(Overlay, LeavesTheImageAsItIs) {
  const cv::Mat image = blackImage();
  const cv::Mat overlay = drawOverlay(image, array({row("a")}));
  EXPECT_EQ(cv::countNonZero(image.reshape(1)), 0);
  EXPECT_EQ(overlay.size(), image.size());
  EXPECT_EQ(overlay.type(), CV_8UC3);
  EXPECT_EQ(cv::countNonZero(drawnOn(image, array({}))), 0);
}

TEST(Overlay, DrawsTheWindowsWhereThePartsAre) {
  const cv::Mat1b drawn = drawnOn(blackImage(), array({row("a")}));
  for (const cv::Point corner : {cv::Point(80, 180), cv::Point(220, 220), cv::Point(120, 180)}) {
    EXPECT_GT(drawn(corner), 60) << corner;
  }
  EXPECT_GT(drawn(200, 150), 60);  // the line from centre to centre
  EXPECT_EQ(drawn(225, 150), 0);
  EXPECT_EQ(cv::countNonZero(drawn.rowRange(240, 480)), 0);
}

TEST(Overlay, TurnsTheWindowsWithTheParts) {
  TrackedObject object = row("a");
  object.parts = {part(320.0, 300.0, 100.0f, 0.785398)};
  const cv::Mat1b drawn = drawnOn(blackImage(), array({object}));
  EXPECT_GT(drawn(300, 320 + 70), 60);
  EXPECT_GT(drawn(300 + 70, 320), 60);
  EXPECT_EQ(drawn(300 + 48, 320 + 48), 0);
}

TEST(Overlay, ShowsHiddenPartsInGrey) {
  TrackedObject object = row("a");
  object.parts[0].visible = false;
  const cv::Mat overlay = drawOverlay(blackImage(), array({object}));
  const cv::Vec3b& hidden = overlay.at<cv::Vec3b>(190, 90);
  const cv::Vec3b& seen = overlay.at<cv::Vec3b>(190, 190);
  EXPECT_EQ(hidden[0], hidden[1]);
  EXPECT_EQ(hidden[1], hidden[2]);
  EXPECT_GT(seen[1], seen[0] + 20);
}

TEST(Overlay, DrawsOutlineAndPoints) {
  TrackedObject object = row("a");
  object.parts.clear();
  for (const cv::Point2f corner : {cv::Point2f(300, 100), cv::Point2f(400, 100),
                                   cv::Point2f(400, 300), cv::Point2f(300, 300)}) {
    geometry_msgs::Point32 point;
    point.x = corner.x;
    point.y = corner.y;
    object.outline.points.push_back(point);
  }
  object.points.resize(1);
  object.points[0].x = 500.0f;
  object.points[0].y = 400.0f;
  const cv::Mat1b drawn = drawnOn(blackImage(), array({object}));
  EXPECT_GT(drawn(200, 300), 100);
  EXPECT_GT(drawn(300, 350), 100);
  EXPECT_EQ(drawn(200, 350), 0);
  EXPECT_GT(cv::countNonZero(drawn(cv::Rect(490, 390, 20, 20))), 20);
}

TEST(Overlay, ALostObjectIsALabelOnly) {
  const cv::Mat1b drawn = drawnOn(blackImage(), array({lost("a")}));
  EXPECT_GT(cv::countNonZero(drawn(cv::Rect(0, 0, 200, 40))), 200);
  EXPECT_EQ(cv::countNonZero(drawn.rowRange(60, 480)), 0);
}

TEST(Overlay, LabelsOfLostObjectsDoNotCoverEachOther) {
  const int one = cv::countNonZero(drawnOn(blackImage(), array({lost("a")})));
  const int two = cv::countNonZero(drawnOn(blackImage(), array({lost("a"), lost("b")})));
  EXPECT_NEAR(two, 2 * one, 0.1 * one);
}

/// Of the left border of a window in the middle of an image of that size [px].
int borderWidth(const cv::Size& size) {
  TrackedObject object = row("a");
  object.parts = {
      part(0.5 * size.width, 0.5 * size.height, 0.25f * static_cast<float>(size.width))};
  const cv::Mat1b drawn = drawnOn(blackImage(size), array({object}));
  const cv::Point left(cvRound(0.375 * size.width), cvRound(0.45 * size.height));
  return cv::countNonZero(drawn(cv::Rect(left.x - 10, left.y, 20, 1)) > 100);
}

TEST(Overlay, LinesGrowWithTheImage) {
  EXPECT_GT(borderWidth({640, 480}), 0);
  EXPECT_GT(borderWidth({2560, 1920}), borderWidth({640, 480}));
}

TEST(Overlay, WorksOnAnySizeAndOutsideTheImage) {
  TrackedObject object = row("an id that is much longer than the image is wide");
  object.parts.push_back(part(-500.0, 1e5, 80.0f));
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(16, 300), cv::Size(300, 16)}) {
    EXPECT_EQ(drawOverlay(blackImage(size), array({object, lost("b")})).size(), size);
  }
}

std::vector<Marker> added(const visualization_msgs::MarkerArray& markers) {
  std::vector<Marker> result;
  std::copy_if(markers.markers.begin(), markers.markers.end(), std::back_inserter(result),
               [](const Marker& marker) { return marker.action == Marker::ADD; });
  return result;
}

Marker markerOf(const visualization_msgs::MarkerArray& markers, int type) {
  for (const Marker& marker : markers.markers) {
    if (marker.action == Marker::ADD && marker.type == type) return marker;
  }
  ADD_FAILURE() << "no marker of type " << type;
  return Marker();
}

TEST(Markers, LieInTheImagesFrameInMetres) {
  const visualization_msgs::MarkerArray markers = toMarkers(array({row("a")}), 0.002);
  const Marker chain = markerOf(markers, Marker::LINE_STRIP);
  ASSERT_EQ(chain.points.size(), 2u);
  EXPECT_DOUBLE_EQ(chain.points[1].x, 0.4);
  EXPECT_DOUBLE_EQ(chain.points[1].y, 0.4);
  EXPECT_DOUBLE_EQ(chain.points[1].z, 0.0);
  for (const Marker& marker : markers.markers) {
    EXPECT_EQ(marker.header.frame_id, "camera");
    EXPECT_EQ(marker.header.stamp, ros::Time(12.5));
    if (marker.action == Marker::ADD) {
      EXPECT_EQ(marker.ns, "a");
      EXPECT_GT(marker.color.a, 0.0f);
      EXPECT_EQ(marker.pose.orientation.w, 1.0);
    }
  }
}

TEST(Markers, AreColouredByConfidence) {
  TrackedObject object = row("a");
  object.parts[0].confidence = 0.0f;
  object.parts[1].visible = false;
  const Marker centres = markerOf(toMarkers(array({object}), 0.001), Marker::SPHERE_LIST);
  ASSERT_EQ(centres.colors.size(), 2u);
  EXPECT_EQ(centres.colors[0], colorOf(0.0, true));
  EXPECT_EQ(centres.colors[1], colorOf(1.0, false));
}

TEST(Markers, TheWindowsAreTurned) {
  TrackedObject object = row("a");
  object.parts = {part(0.0, 0.0, 2.0f, 0.5)};
  const Marker windows = markerOf(toMarkers(array({object}), 1.0), Marker::LINE_LIST);
  ASSERT_EQ(windows.points.size(), 8u);
  EXPECT_NEAR(windows.points[1].x, std::cos(0.5) + std::sin(0.5), 1e-12);
  EXPECT_NEAR(windows.points[1].y, std::sin(0.5) - std::cos(0.5), 1e-12);
}

TEST(Markers, TheLabelNamesTheObjectAboveIt) {
  const Marker label = markerOf(toMarkers(array({row("cup")}), 0.001), Marker::TEXT_VIEW_FACING);
  EXPECT_EQ(label.text, "cup 87 %");
  EXPECT_LT(label.pose.position.y, 0.180);
}

TEST(Markers, LostOrGoneObjectsLeaveNothing) {
  for (const TrackedObjectArray& objects : {array({}), array({lost("a")})}) {
    const visualization_msgs::MarkerArray markers = toMarkers(objects, 0.001);
    ASSERT_EQ(markers.markers.size(), 1u);
    EXPECT_EQ(markers.markers[0].action, Marker::DELETEALL);
  }
  const visualization_msgs::MarkerArray both = toMarkers(array({lost("a"), row("b")}), 0.001);
  EXPECT_EQ(both.markers[0].action, Marker::DELETEALL);
  for (const Marker& marker : added(both)) EXPECT_EQ(marker.ns, "b");
}

TEST(Markers, AreOfDifferentIds) {
  std::set<std::pair<std::string, int>> names;
  const std::vector<Marker> markers = added(toMarkers(array({row("a"), row("b")}), 0.001));
  for (const Marker& marker : markers) names.insert({marker.ns, marker.id});
  EXPECT_EQ(names.size(), markers.size());
  EXPECT_GE(markers.size(), 6u);
}

}  // namespace
}  // namespace chain_tracker
