#!/usr/bin/env bash
# picture.sh [RUN_DIR]: of circle.yaml's run writes RUN_DIR/picture.png, the cable at six instants from above,
# RUN_DIR/side.png, the same from the side, and RUN_DIR/motion.png, the sled's depth and the ship's tension over time.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
run=${1:-$root/build/biomapper}
/usr/bin/python3 "$root/jobs/plot.py" "$run/history.csv" "$run/motion.png" --title "The Biomapper sled in a circle" \
  --panel "height [m]=sled.z" --panel "tension [N]=tow_cable.tension_from,tow_cable.tension_to" \
  --panel "ship's velocity [m/s]=ship.vx,ship.vy"
draw() {
  bash "$root/jobs/with_xvfb.sh" pvbatch "$root/jobs/picture.py" "$run" "$run/$1" --times 2200,2350,2500,2650,2800,3000 \
    --range 5000,15500 --width 3 "${@:2}"
}
draw picture.png --view 0,0.001,-1 --size 1500x700
draw side.png --view y --size 1500x900
