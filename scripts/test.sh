#!/usr/bin/env bash
# test.sh BUILD: runs every test. One at a time by default: tests that draw use all cores of a software renderer.
set -euo pipefail
cd "$(dirname "$0")/.."
exec ctest --test-dir "$1" --output-on-failure --no-tests=error -j "${TEST_JOBS:-1}"
