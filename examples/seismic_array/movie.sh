#!/usr/bin/env bash
# movie.sh [RUN_DIR]: writes RUN_DIR/movie.gif, the array from above.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
run=${1:-$here/../../build/seismic_array}
/usr/bin/python3 "$here/movie.py" "$run" "$run/movie.gif"
