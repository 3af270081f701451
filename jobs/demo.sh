#!/usr/bin/env bash
# demo.sh [PETSc options]: builds, runs the towed array on two ranks and draws it.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
bash jobs/setup.sh
source jobs/environment.sh

echo "demo: running examples/towed_array/scene.yaml on 2 ranks"
mpirun -n 2 build/cablenet run examples/towed_array/scene.yaml -o build/demo "$@"

echo "demo: drawing"
bash examples/towed_array/picture.sh build/demo

echo "demo: results  $root/build/demo (history.csv, run.yaml; open cables.xmf in ParaView)"
echo "demo: picture  $root/build/demo/picture.png"
