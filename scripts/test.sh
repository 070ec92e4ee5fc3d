#!/usr/bin/env bash
# test.sh BUILD: runs every test. One at a time by default: tests that draw use all cores of a software renderer.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
start=$SECONDS
status=0
ctest --test-dir "$build" --output-on-failure --no-tests=error -j "${TEST_JOBS:-1}" || status=$?
echo "make test: $((SECONDS - start)) s of tests, exit $status"
exit $status
