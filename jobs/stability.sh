#!/usr/bin/env bash
# stability.sh [--cases WORD,...] [--methods WORD,...] ...: builds, runs hard cases by every scheme, and draws the map.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
bash "$root/jobs/setup.sh" --no-pictures >&2
source "$root/jobs/environment.sh"
exec /usr/bin/python3 "$root/jobs/stability/stability.py" --program "$root/build/cablenet" "$@"
