#!/usr/bin/env bash
# picture.sh [RUNS_DIR]: writes RUNS_DIR/tensions.png, the tensions beside the reference, and RUNS_DIR/picture.png, the
# riser over one period of the surge.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
runs=${1:-$root/build/low_langley}
/usr/bin/python3 "$here/figure.py" "$runs"
bash "$root/jobs/with_xvfb.sh" pvbatch "$root/jobs/picture.py" "$runs/surge" "$runs/picture.png" \
  --times 54,57.4,60.7,64.1,67.5,70.9,74.2,77.6 --view y --size 1400x900
