#!/usr/bin/env bash
# Which lines of src the tests run: builds the preset "coverage", runs the tests and counts (needs gcovr). Arguments go to ctest.
#   tests/coverage.sh            all tests
#   tests/coverage.sh -L unit    those of a label
# Leaves build/coverage/coverage.txt, a line per file with the lines that no test runs.
set -euo pipefail
cd "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/.."
command -v gcovr >/dev/null || { echo "gcovr is not installed (package gcovr)" >&2; exit 1; }
cmake --preset coverage --log-level=WARNING >/dev/null
cmake --build build/coverage
find build/coverage -name '*.gcda' -delete
# Tests of times and of memory may fail in this build: what ran is counted all the same.
ctest --preset coverage --parallel 2 "$@" || echo "some tests failed; their lines count" >&2
gcovr --root . --filter src/ --gcov-ignore-parse-errors --object-directory build/coverage --txt build/coverage/coverage.txt
tail -3 build/coverage/coverage.txt
