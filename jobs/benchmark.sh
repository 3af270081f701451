#!/usr/bin/env bash
# benchmark.sh [--quick] [--output FILE] ...: builds, measures speeds and memory, prints them beside their targets.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
bash "$root/jobs/setup.sh" --no-pictures >&2
source "$root/jobs/environment.sh"
exec /usr/bin/python3 "$root/jobs/benchmark.py" "$@"
