#!/usr/bin/env bash
# picture.sh [RUN_DIR]: writes RUN_DIR/picture.png, the mass against the reference.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
run=${1:-$root/build/conical_pendulum}
/usr/bin/python3 "$root/jobs/plot.py" "$run/history.csv" "$run/picture.png" --reference "$here/reference.csv" \
  --title "Flexible conical pendulum: its mass" \
  --panel "position [m]=mass.x,mass.y,mass.z" --panel "velocity [m/s]=mass.vx,mass.vy,mass.vz" \
  --panel "energy [J]=energy.kinetic,energy.gravity,energy.strain,energy.total"
