#!/usr/bin/env bash
# picture.sh [RUN_DIR]: writes RUN_DIR/picture.png, the body at three instants, and RUN_DIR/motion.png, its motion over time.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
run=${1:-$root/build/hung_body}
/usr/bin/python3 "$root/jobs/plot.py" "$run/history.csv" "$run/motion.png" --title "A body hung by four ropes" \
  --panel "position [m]=box.x,box.y,box.z" --panel "angular velocity [rad/s]=box.wx,box.wy,box.wz" \
  --panel "energy [J]=energy.kinetic,energy.gravity,energy.strain,energy.total"
bash "$root/jobs/with_xvfb.sh" pvbatch "$root/jobs/picture.py" "$run" "$run/picture.png" \
  --times 0.6,1.2,1.8 --view y --size 1200x1000
