#!/usr/bin/env bash
# picture.sh [RUN_DIR]: writes RUN_DIR/picture.png, cable and bodies at four instants, coloured by tension.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
run=${1:-$root/build/tow_fish}
bash "$root/jobs/with_xvfb.sh" pvbatch "$root/jobs/picture.py" "$run" "$run/picture.png" --times 0,2,4,last
