// SPDX-License-Identifier: BSD-3-Clause
#include "chain_tracker/ros/parameters.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace chain_tracker {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue pointList(const std::vector<cv::Point2d>& points) {
  XmlRpcValue list;
  list.setSize(static_cast<int>(points.size()));
  for (int i = 0; i < list.size(); ++i) {
    list[i][0] = points[static_cast<std::size_t>(i)].x;
    list[i][1] = static_cast<int>(points[static_cast<std::size_t>(i)].y);
  }
  return list;
}

XmlRpcValue target(const std::string& id) {
  XmlRpcValue value;
  value["id"] = id;
  value["points"] = pointList({{10.5, 20.0}, {30.0, 40.0}});
  return value;
}

std::string refusalOf(const XmlRpcValue& tree) {
  try {
    parametersFrom(tree);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Parameters, AreTheDefaultsWhereNoneIsSet) {
  const TrackerParameters parameters = parametersFrom(XmlRpcValue());
  EXPECT_EQ(parameters.image_transport, "raw");
  EXPECT_EQ(parameters.history, 30);
  EXPECT_EQ(parameters.init_timeout, 5.0);
  EXPECT_TRUE(unknownKeysIn(XmlRpcValue()).empty());
  EXPECT_TRUE(initialTargetsFrom(XmlRpcValue(), parameters).requests.empty());
}

TEST(Parameters, AreRead) {
  XmlRpcValue tree;
  tree["image_transport"] = "compressed";
  tree["models_folder"] = "/tmp";
  tree["default_model"] = "cable";
  tree["default_id"] = "hose";
  tree["init_timeout"] = 2;
  tree["history"] = 0;
  tree["pixel_size"] = 0.002;
  tree["threads"] = 3;
  const TrackerParameters parameters = parametersFrom(tree);
  EXPECT_EQ(parameters.image_transport, "compressed");
  EXPECT_EQ(parameters.models_folder, "/tmp");
  EXPECT_EQ(parameters.default_model, "cable");
  EXPECT_EQ(parameters.default_id, "hose");
  EXPECT_EQ(parameters.init_timeout, 2.0);
  EXPECT_EQ(parameters.history, 0);
  EXPECT_EQ(parameters.pixel_size, 0.002);
  EXPECT_EQ(parameters.threads, 3);
}

struct Wrong {
  std::string key;
  XmlRpcValue value;
  std::string refusal;
};

class WrongParameter : public testing::TestWithParam<Wrong> {};

TEST_P(WrongParameter, IsRefusedWithKeyValueAndWhatIsAllowed) {
  XmlRpcValue tree;
  tree[GetParam().key] = GetParam().value;
  EXPECT_EQ(refusalOf(tree), GetParam().refusal + "\n");
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongParameter,
    testing::Values(
        Wrong{"history", -1, "~history is -1, must be an integer in [0, 1000]"},
        Wrong{"history", 2.5, "~history is 2.5, must be an integer in [0, 1000]"},
        Wrong{"history", true, "~history is true, must be an integer in [0, 1000]"},
        Wrong{"history", "9", "~history is '9', must be an integer in [0, 1000]"},
        Wrong{"init_timeout", 0.0, "~init_timeout is 0, must be a number in [0.1, 600]"},
        Wrong{"init_timeout", "5 s", "~init_timeout is '5 s', must be a number in [0.1, 600]"},
        Wrong{"threads", -1, "~threads is -1, must be an integer in [0, 256]"},
        Wrong{"pixel_size", -0.001, "~pixel_size is -0.001, must be a number in [1e-06, 1]"},
        Wrong{"models_folder", "/no/such",
              "~models_folder is '/no/such', must be empty or a folder, and there is none at "
              "/no/such"},
        Wrong{"models_folder", 7, "~models_folder is 7, must be a string"},
        Wrong{"default_id", 7, "~default_id is 7, must be a string"},
        Wrong{"default_id", "", "~default_id is '', must be a string that is not empty"}));

TEST(Parameters, AllFaultsAreNamedAtOnce) {
  XmlRpcValue tree;
  tree["history"] = -1;
  tree["default_id"] = 7;
  const std::string refusal = refusalOf(tree);
  EXPECT_NE(refusal.find("~history"), std::string::npos);
  EXPECT_NE(refusal.find("~default_id"), std::string::npos);
}

TEST(Parameters, UnknownKeysAreNamed) {
  XmlRpcValue tree;
  tree["histroy"] = 5;
  tree["history"] = 5;
  tree["overlay"]["compressed"]["jpeg_quality"] = 50;
  tree["diagnostic_period"] = 2.0;
  const std::vector<std::string> sentences = unknownKeysIn(tree);
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_NE(sentences[0].find("~histroy is unknown"), std::string::npos);
  EXPECT_NE(sentences[0].find("~history"), std::string::npos);
}

TEST(InitialTargets, AreReadFromTheList) {
  XmlRpcValue tree;
  tree["targets"][0] = target("a");
  tree["targets"][1] = target("b");
  tree["targets"][1]["model"] = "cable";
  const InitialTargets targets = initialTargetsFrom(tree, parametersFrom(tree));
  EXPECT_TRUE(targets.faults.empty());
  ASSERT_EQ(targets.requests.size(), 2u);
  EXPECT_EQ(targets.requests[0].id, "a");
  EXPECT_EQ(targets.requests[0].model, TrackerParameters().default_model);
  EXPECT_EQ(targets.requests[1].model, "cable");
  ASSERT_EQ(targets.requests[1].points.size(), 2u);
  EXPECT_EQ(targets.requests[1].points[0], cv::Point2d(10.5, 20.0));
}

TEST(InitialTargets, AFaultyOneDoesNotTouchTheOthers) {
  XmlRpcValue tree;
  tree["targets"][0] = target("a");
  tree["targets"][1] = "nonsense";
  tree["targets"][2] = target("c");
  tree["targets"][2]["points"] = pointList({{1.0, 2.0}});
  tree["targets"][3] = target("d");
  tree["targets"][3]["colour"] = "red";
  tree["targets"][4] = target("a");
  tree["targets"][5] = target("f");
  tree["targets"][5]["points"][0][1] = "20";
  tree["targets"][6] = target("g");
  tree["targets"][6]["id"] = "";
  const InitialTargets targets = initialTargetsFrom(tree, parametersFrom(XmlRpcValue()));
  ASSERT_EQ(targets.requests.size(), 1u);
  EXPECT_EQ(targets.requests[0].id, "a");
  const std::vector<std::string> beginnings = {"~targets[1] is nonsense, must be {id",
                                               "~targets[2]/points is {{1,2}}, must be a list",
                                               "~targets[3]/colour is red, must be left out",
                                               "~targets[4] has the id 'a', must be",
                                               "~targets[5]/points is 20, must be a number",
                                               "~targets[6]/id is , must be a string"};
  ASSERT_EQ(targets.faults.size(), beginnings.size());
  for (std::size_t i = 0; i < beginnings.size(); ++i) {
    EXPECT_EQ(targets.faults[i].substr(0, beginnings[i].size()), beginnings[i]);
  }
}

TEST(InitialTargets, AreReadFromText) {
  XmlRpcValue tree;
  tree["points"] = "10, 20.5,30,40";
  tree["default_id"] = "hose";
  const InitialTargets targets = initialTargetsFrom(tree, parametersFrom(tree));
  EXPECT_TRUE(targets.faults.empty());
  ASSERT_EQ(targets.requests.size(), 1u);
  EXPECT_EQ(targets.requests[0].id, "hose");
  const std::vector<cv::Point2d> expected = {{10.0, 20.5}, {30.0, 40.0}};
  EXPECT_EQ(targets.requests[0].points, expected);
}

TEST(PointsFromText, AreWholePairsOfNumbers) {
  const std::vector<cv::Point2d> expected = {{-1.0, 2.5}, {3.0, 4.0}};
  EXPECT_EQ(pointsFromText("-1, 2.5,3,4"), expected);
  for (const std::string text :
       {"", "1,2", "1,2,3,4,5", "1,2,3,x", "1,2,3,4px", "1,2,,4", "nan,2,3,4"}) {
    EXPECT_FALSE(pointsFromText(text)) << text;
  }
}

TEST(InitialTargets, EmptyTextMeansNone) {
  XmlRpcValue tree;
  tree["points"] = "";
  const InitialTargets targets = initialTargetsFrom(tree, TrackerParameters());
  EXPECT_TRUE(targets.requests.empty());
  EXPECT_TRUE(targets.faults.empty());
}

TEST(InitialTargets, OtherTextIsRefused) {
  const std::vector<XmlRpcValue> wrong = {"1,2", "1,2,3", "1,2,3,x", "1,2,3,4 5", "1 2 3 4", 5};
  for (const XmlRpcValue& value : wrong) {
    SCOPED_TRACE(value.toXml());
    XmlRpcValue tree;
    tree["points"] = value;
    const InitialTargets targets = initialTargetsFrom(tree, TrackerParameters());
    EXPECT_TRUE(targets.requests.empty());
    ASSERT_EQ(targets.faults.size(), 1u);
    EXPECT_EQ(targets.faults[0].substr(0, 11), "~points is ");
  }
}

}  // namespace
}  // namespace chain_tracker
