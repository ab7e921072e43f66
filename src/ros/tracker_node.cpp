// SPDX-License-Identifier: BSD-3-Clause
/// The nodelet in a process of its own.
#include <cstdlib>

#include <nodelet/loader.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "chain_tracker");
  const bool offer_loading_services = false;
  nodelet::Loader loader(offer_loading_services);
  const nodelet::V_string arguments(argv + 1, argv + argc);
  if (!loader.load(ros::this_node::getName(), "chain_tracker/TrackerNodelet",
                   ros::names::getRemappings(), arguments)) {
    return EXIT_FAILURE;
  }
  ros::spin();
  return EXIT_SUCCESS;
}
