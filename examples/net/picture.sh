#!/usr/bin/env bash
# picture.sh [RUN_DIR]: writes RUN_DIR/picture.png, the net at three instants, coloured by tension.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
run=${1:-$root/build/net}
bash "$root/jobs/with_xvfb.sh" pvbatch "$root/jobs/picture.py" "$run" "$run/picture.png" \
  --times 0,0.96,1.44 --width 1.5
