#!/usr/bin/env bash
# build.sh FOLDER JOBS ON|OFF: configures (Release, Ninja, ccache) and builds the program, or with ON the tests too.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1 jobs=$2 tests=$3

# The pinned search path finds Debian's glad, whichever Python comes first on the PATH.
if [ ! -f "$build/build.ninja" ]; then
  cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release --log-level=WARNING
fi
if [ "$tests" = ON ]; then
  cmake --build "$build" -j "$jobs"
else
  cmake --build "$build" -j "$jobs" --target welkin
fi
