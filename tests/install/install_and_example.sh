#!/usr/bin/env bash
# install_and_example.sh BUILD SOURCE CMAKE: installs into an empty prefix, moves it, builds the example against it, runs it on
# the installed scene, and looks at its pictures.
set -euo pipefail
build=$1 source=$2 cmake=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/prefix" # nothing may depend on where it was installed
cp -r "$source/examples/hello_planet" "$work/source"
"$cmake" -S "$work/source" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/log" 2>&1 ||
  { cat "$work/log"; exit 1; }
"$cmake" --build "$work/build" || { echo "the example does not build"; exit 1; }

cd "$work"
scene=$work/prefix/share/welkin/scenes/small.json # a budget that a test has time to fill
sed 's/"512MiB"/"64MiB"/' "$work/prefix/share/welkin/scenes/earth.json" >"$scene"
env -u WELKIN_SHADERS "$work/build/hello_planet" "$scene"
for i in 0 1 2; do
  picture=hello_$i.ppm
  [ "$(head -c 13 "$picture")" = "P6 160 90 255" ] || { echo "$picture: not a picture of 160x90"; exit 1; }
  # A black or plain picture has one byte value or two; air and cloud give shades.
  shades=$(tail -c +15 "$picture" | od -An -v -tu1 -w1 | sort -u | wc -l)
  echo "$picture: $shades different byte values"
  [ "$shades" -ge 32 ] || { echo "$picture: hardly anything in it"; exit 1; }
done
# The shaders came from the moved installation: with an empty folder in their place the example fails.
mv "$work/prefix/share/welkin/shaders" "$work/away"
mkdir "$work/prefix/share/welkin/shaders"
if env -u WELKIN_SHADERS "$work/build/hello_planet" "$scene" 2>"$work/err"; then
  echo "the example read its shaders from somewhere else"
  exit 1
fi
rmdir "$work/prefix/share/welkin/shaders"
mv "$work/away" "$work/prefix/share/welkin/shaders"
"$work/prefix/bin/welkin" --help >/dev/null
