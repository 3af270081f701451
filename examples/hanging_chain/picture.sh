#!/usr/bin/env bash
# picture.sh [RUN_DIR]: writes RUN_DIR/picture.png, the tip against linear theory.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
run=${1:-$root/build/hanging_chain}
/usr/bin/python3 "$root/jobs/plot.py" "$run/history.csv" "$run/picture.png" --reference "$here/reference.csv" \
  --title "Hanging chain let go in its first mode" \
  --panel "sideways [m]=tip.x" --panel "tension [N]=chain.tension_from,chain.tension_to" \
  --panel "energy.total [J]=energy.total"
