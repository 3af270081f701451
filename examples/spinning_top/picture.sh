#!/usr/bin/env bash
# picture.sh [RUN_DIR]: writes RUN_DIR/picture.png, the top at four instants, and RUN_DIR/motion.png, its motion over time.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
run=${1:-$root/build/spinning_top}
/usr/bin/python3 "$root/jobs/plot.py" "$run/history.csv" "$run/motion.png" --reference "$here/reference.csv" \
  --title "Spinning top: centre of gravity and attitude" \
  --panel "position [m]=top.x,top.y,top.z" --panel "quaternion=top.qw,top.qx,top.qy,top.qz"
bash "$root/jobs/with_xvfb.sh" pvbatch "$root/jobs/picture.py" "$run" "$run/picture.png" \
  --times 0,0.39,0.79,1.18 --view=-0.6,0.4,-0.35 --range 0,25 --size 1200x900
