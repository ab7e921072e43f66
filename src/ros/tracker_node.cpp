// SPDX-License-Identifier: BSD-3-Clause
/// The nodelet in a process of its own.
#include <cstdlib>
#include <iostream>
#include <string>

#include <nodelet/loader.h>
#include <ros/ros.h>

namespace {

constexpr int kExitWrongUsage = 2;

constexpr const char* kUsage =
    "Usage: tracker_node [image:=TOPIC] [_PARAMETER:=VALUE]...\n"
    "Tracks objects in the images of a topic, as the nodelet chain_tracker/TrackerNodelet does,\n"
    "whose topics, services and parameters it has.\n";

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "chain_tracker");  // takes its own arguments out
  const std::string argument = argc > 1 ? argv[1] : "";
  if (argument == "-h" || argument == "--help") {
    std::cout << kUsage;
    return EXIT_SUCCESS;
  }
  if (argc > 1) {
    std::cerr << "unknown argument '" << argument << "'\n" << kUsage;
    return kExitWrongUsage;
  }
  const bool offer_loading_services = false;
  nodelet::Loader loader(offer_loading_services);
  if (!loader.load(ros::this_node::getName(), "chain_tracker/TrackerNodelet",
                   ros::names::getRemappings(), nodelet::V_string())) {
    return EXIT_FAILURE;
  }
  ros::spin();
  return EXIT_SUCCESS;
}
