#!/usr/bin/env bash
# charts.sh [--stored] [-o DIR]: draws error over cost beside MoorDyn-C, and the stability map; --stored runs nothing.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/jobs/environment.sh"
case " $* " in *" --stored "* | *" --help "* | *" -h "*) ;; *) bash "$root/jobs/setup.sh" --no-pictures >&2 ;; esac
exec /usr/bin/python3 "$root/jobs/charts/charts.py" "$@"
