#!/usr/bin/env bash
# couplings.sh [DIR]: runs the three couplings into DIR and writes DIR/couplings.png.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$here/../../build
out=${1:-$build/cable_body_couplings}
for scene in scene link bar; do
  "$build/cablenet" run "$here/$scene.yaml" -o "$out/$scene"
done
/usr/bin/python3 "$here/couplings.py" "$out"
