#!/usr/bin/env bash
# setup.sh: installs the Debian packages that building, testing and flying need, if any is missing. Quick when none is.
# setup.sh --try PACKAGE...: installs tools that the rest works without, if it can; never fails.
set -euo pipefail

packages=(
  g++ cmake ninja-build ccache pkg-config python3-glad          # to build
  libglm-dev libfmt-dev libspdlog-dev nlohmann-json3-dev libcli11-dev liblodepng-dev libopenexr-dev libsodium-dev libstb-dev
  libegl-dev libopengl-dev libgl-dev libegl-mesa0 libgl1-mesa-dri   # OpenGL without a window, in software if need be
  libglfw3-dev libimgui-dev libx11-dev fonts-dejavu-core        # the window
  libgtest-dev libgmock-dev                                     # tests
  xvfb xauth xdotool jwm x11-xserver-utils x11-utils            # tests of the window
  python3-matplotlib                                            # the plot of a flight
)
needed=true
if [ "${1:-}" = --try ]; then
  needed=false
  shift
  packages=("$@")
elif [ $# -gt 0 ]; then
  echo "usage: setup.sh [--try PACKAGE...]" >&2
  exit 2
fi

if ! command -v dpkg-query >/dev/null 2>&1; then
  if $needed; then echo "setup: not a Debian system; going on with what is installed" >&2; fi
  exit 0
fi

missing=()
for p in "${packages[@]}"; do
  case $p in # tools: the command counts, wherever it came from
    g++ | cmake | ccache | pkg-config | ffmpeg | npm) command -v "$p" >/dev/null 2>&1 && continue ;;
  esac
  # A virtual package or one of another architecture does not count as installed.
  [ "$(dpkg-query -W -f='${db:Status-Status} ' "$p" 2>/dev/null)" = "installed " ] || missing+=("$p")
done
if [ ${#missing[@]} -eq 0 ]; then exit 0; fi

if [ "$(id -u)" = 0 ]; then
  as_root=(env)
elif command -v sudo >/dev/null 2>&1 && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
  as_root=(sudo env)
elif $needed; then
  echo "setup: packages are missing and installing them needs root. Run this once, then repeat what you ran:" >&2
  echo "  su -c 'apt-get update && apt-get install -y --no-install-recommends ${missing[*]}'" >&2
  exit 1
else
  exit 0
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt_get() { "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 "$@" </dev/null >"$log" 2>&1; }

echo "setup: installing ${missing[*]}" >&2
apt_get update || echo "setup: apt-get update failed, trying with the package lists that are there" >&2
if ! apt_get install -y --no-install-recommends "${missing[@]}"; then
  if $needed; then
    tail -n 15 "$log" >&2
    echo "setup: apt-get install failed" >&2
    exit 1
  fi
  echo "setup: going on without ${missing[*]}" >&2
fi
