#!/usr/bin/env bash
# picture.sh [RUN_DIR]: writes RUN_DIR/picture.png, the free end against the reference, and RUN_DIR/shapes.png.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
run=${1:-$root/build/free_fall}
/usr/bin/python3 "$root/jobs/plot.py" "$run/history.csv" "$run/picture.png" --reference "$here/reference.csv" \
  --title "Free fall of a pinned cable: its free end" \
  --panel "position [m]=free.x,free.z" --panel "velocity [m/s]=free.vx,free.vz" \
  --panel "energy [J]=energy.kinetic,energy.gravity,energy.strain,energy.total"
bash "$root/jobs/with_xvfb.sh" pvbatch "$root/jobs/picture.py" "$run" "$run/shapes.png" \
  --times 0,0.2,0.4,0.5,0.6,0.8,1.0,1.2 --view y --range 0,3 --size 1200x1000
