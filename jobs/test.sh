#!/usr/bin/env bash
# test.sh [ctest options]: builds and runs every test; the exit status is ctest's.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
bash jobs/setup.sh
source jobs/environment.sh
exec ctest --test-dir build --output-on-failure -j 2 "$@"
