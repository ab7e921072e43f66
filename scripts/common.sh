# SPDX-License-Identifier: BSD-3-Clause
# Sourced by the scripts beside it: where things are, installing packages, entering the workspace.
set -euo pipefail
shopt -s inherit_errexit

ROOT="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
BUILD="$ROOT/build"
CACHE="$BUILD/cache"

# ROS's programs are Python scripts that need the system's interpreter, not another one in PATH.
export PATH="/usr/bin:/bin:/usr/sbin:/sbin:${PATH:-}"
export ROS_HOME="$BUILD/ros_home"  # logs stay in the build tree
unset PYTHONHOME

# What the scripts start talks to this machine alone, even where its host name does not resolve.
export ROS_IP=127.0.0.1
unset ROS_HOSTNAME

say() { printf '%s\n' "$*" >&2; }

fail() {  # fail STATUS MESSAGE
  say "$(basename "$0"): $2"
  exit "$1"
}

# Prints the comment block at the head of the calling script.
usage() { sed -n '3,/^[^#]/{s/^# \{0,1\}//p}' "$0"; }

as_root() {
  if [[ $EUID -eq 0 ]]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    fail 2 "needs root or sudo for: $*"
  fi
}

apt_get() { as_root env DEBIAN_FRONTEND=noninteractive apt-get "$@" </dev/null >&2; }

# Installs those of the Debian packages named that are missing.
install_packages() {
  local missing
  missing="$(comm -23 <(printf '%s\n' "$@" | sort -u) <(installed_packages "$@"))"
  [[ -n $missing ]] || return 0
  say "installing: ${missing//$'\n'/ }"
  apt_get -q update
  # shellcheck disable=SC2086  # one word a package
  apt_get -q install -y --no-install-recommends $missing
}

installed_packages() {
  { dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true; } |
    sed -n 's/^installed //p' | sort -u
}

# ROS Noetic on Ubuntu lives in /opt/ros; Debian's own packages live in /usr.
NOETIC=/opt/ros/noetic/setup.bash

install_with_rosdep() {
  install_packages python3-rosdep git
  [[ -e /etc/ros/rosdep/sources.list.d/20-default.list ]] || as_root rosdep init >&2
  rosdep update --rosdistro noetic >&2
  rosdep install --from-paths "$ROOT" --ignore-src --rosdistro noetic -y
}

install_dependencies() {
  if [[ -e $NOETIC ]]; then
    source_setup "$NOETIC"
    install_with_rosdep
  else
    # shellcheck disable=SC2046  # one word a package
    install_packages $(sed 's/#.*//' "$ROOT/scripts/packages.txt")
  fi
  ensure_localhost
}

# roslaunch needs it; a bare chroot has no /etc/hosts.
ensure_localhost() {
  getent hosts localhost >/dev/null && return
  say "localhost does not resolve: adding it to /etc/hosts"
  echo "127.0.0.1 localhost" | as_root tee -a /etc/hosts >/dev/null
}

# ROS's setup files read variables that may not be set.
source_setup() {
  set +u
  # shellcheck disable=SC1090
  source "$1"
  set -u
}

enter_workspace() { source_setup "$BUILD/devel/setup.bash"; }

# The directory of the built programs.
PROGRAMS="$BUILD/devel/lib/chain_tracker"
