#!/usr/bin/env bash
# extras.sh BUILD FOLDER [SIZE]: the documented views of the Earth and the zoom series, converged, as PNG.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1 out=$2 size=${3:-1280x720}
mkdir -p "$out"
for view in disc limb orbit cyclone layers inside overcast sunset; do
  "$build/welkin" render scenes/earth.json --view "$view" --size "$size" -o "$out/$view.png"
done
for view in zoom-58 zoom-30 zoom-10 zoom-3 zoom-1 zoom-0.3 zoom-0.1; do
  "$build/welkin" render scenes/earth.json --view "$view" --size 640x360 -o "$out/$view.png"
done
