# SPDX-License-Identifier: BSD-3-Clause
# Fails when the core knows ROS: by an include in its files or by a library it is linked with.
# Usage: cmake -DSOURCE_DIR=... -DCORE_LIBRARY=... -P core_has_no_ros.cmake
cmake_minimum_required(VERSION 3.16)

string(CONCAT ros_include "^[ \t]*#[ \t]*include[ \t]*[<\"]"
  "(ros/|ros\\.h|rosbag|roslib|rosconsole|nodelet|pluginlib|cv_bridge|image_transport|"
  "image_geometry|dynamic_reconfigure|diagnostic_updater|message_filters|class_loader|"
  "tf/|tf2|chain_tracker/ros/|[a-z0-9_]+_msgs/|std_srvs/|"
  "chain_tracker/[A-Z])")  # messages of this package are the only CamelCase headers

set(faults "")
set(checked 0)
foreach(part image chain haar evaluation yaml)
  file(GLOB_RECURSE files
    ${SOURCE_DIR}/include/chain_tracker/${part}/* ${SOURCE_DIR}/src/${part}/*)
  foreach(file IN LISTS files)
    math(EXPR checked "${checked} + 1")
    file(STRINGS ${file} includes REGEX "${ros_include}")
    foreach(include IN LISTS includes)
      string(APPEND faults "${file}: ${include}\n")
    endforeach()
  endforeach()
endforeach()
if(checked EQUAL 0)
  message(FATAL_ERROR "no file of the core below ${SOURCE_DIR}")
endif()

# The transitive list, so that ROS cannot come in through another library either.
execute_process(COMMAND ldd ${CORE_LIBRARY} OUTPUT_VARIABLE libraries RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "ldd ${CORE_LIBRARY} failed")
endif()
string(REGEX MATCHALL
  "lib(ros[a-z0-9_]*|nodelet[a-z]*|class_loader|cv_bridge|image_transport|tf2?[a-z_]*|cpp_common|xmlrpcpp|chain_tracker_nodelet)\\.so[0-9a-z.]*"
  ros_libraries "${libraries}")
list(REMOVE_DUPLICATES ros_libraries)
foreach(library IN LISTS ros_libraries)
  string(APPEND faults "${CORE_LIBRARY} is linked with ${library}\n")
endforeach()

if(faults)
  message(FATAL_ERROR "the core must not know ROS:\n${faults}")
endif()
message(STATUS "${checked} files and the library of the core are free of ROS")
