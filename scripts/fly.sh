#!/usr/bin/env bash
# fly.sh BUILD PATH.json FOLDER [options of welkin fly]: replays a flight, then plots its pass times.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1 path=$2 out=$3
shift 3
scripts/setup.sh --try ffmpeg
video=()
if command -v ffmpeg >/dev/null 2>&1; then
  video=(--video "$out/flight.mp4")
else
  echo "fly: ffmpeg is not installed: no video" >&2
fi
"$build/welkin" fly "$path" --out "$out" --json "$out/timings.json" "${video[@]}" "$@"
/usr/bin/python3 scripts/plot_timings.py "$out/timings.json" -o "$out/passes.png"
