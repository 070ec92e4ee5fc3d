#!/usr/bin/env bash
# format.sh [options of clang-format]: over all sources that git knows.
set -euo pipefail
cd "$(dirname "$0")/.."
tool=$(command -v clang-format || command -v clang-format-14 || true)
if [ -z "$tool" ]; then
  echo "format: clang-format is not installed (Debian: clang-format)" >&2
  exit 1
fi
git ls-files -z -- '*.cpp' '*.h' ':!*.glsl.h' | xargs -0 "$tool" "$@"
