#!/bin/bash
# with_xvfb.sh COMMAND...: runs COMMAND under a virtual X server of its own and returns its exit status.
# Debian's ParaView draws through GLX only, so pvbatch needs this even where no picture is made.
set -u

fail() {
  echo "with_xvfb.sh: $1" >&2
  exit 1
}

[ $# -gt 0 ] || fail "usage: with_xvfb.sh COMMAND..."
command -v Xvfb > /dev/null || fail "Xvfb is not installed"

display_file=$(mktemp) || fail "no temporary file"
# -displayfd: Xvfb finds a free display by itself, so that several can start at once.
# -noreset: it would otherwise reset when pvbatch closes its first, probing connection, and refuse the next.
Xvfb -displayfd 5 -screen 0 "${XVFB_SCREEN:-1920x1080x24}" -nolisten tcp -noreset 5> "$display_file" > /dev/null 2>&1 &
server=$!
trap 'kill "$server" 2> /dev/null; wait "$server" 2> /dev/null; rm -f "$display_file"' EXIT
trap 'exit 143' TERM
trap 'exit 130' INT

for _ in $(seq 200); do
  [ -s "$display_file" ] && break
  kill -0 "$server" 2> /dev/null || fail "Xvfb did not start"
  sleep 0.05
done
[ -s "$display_file" ] || fail "Xvfb was not ready after 10 s"

DISPLAY=:$(cat "$display_file") "$@"
