"""The notes on drawn shapes, by `check` and by a run on 1, 2 and 3 ranks: nodes inside the bed, and stretched cables."""
import re
import subprocess
import sys

from bench import ENVIRONMENT, arguments

SCENE = """
environment: {{gravity: 9.81, fluid: {{density: 1025, surface: 0}}, seabed: {{level: -200, stiffness: 3.0e6, damping: 3.0e5}}}}
cable_types: {{chain: {{diameter: 0.333, mass_per_length: 685, axial_stiffness: 3.27e9, tension_only: true}}}}
points:
  p: {{position: [-400, 0, {anchor}], motion: fixed}}
  q: {{position: [0, 0, 0], motion: fixed}}
  r: {{position: [10, 0, {end}]}}
cables:
  one: {{type: chain, from: p, to: q, {one}, elements: 20}}
  two: {{type: chain, from: q, to: r, {two}, elements: 4}}
{rest}
"""
USUAL = {"anchor": -200, "end": -100, "one": "length: 850, shape: catenary", "two": "length: 101",
         "rest": "time: {end: 0.02, step: 0.01}"}
LOW = "length: 510, shape: [[-400, 0, -200], [-300, 0, -260], [0, 0, 0]]"
failures = []


def expect(truth, text):
    print(("ok    " if truth else "FAIL  ") + text, flush=True)
    if not truth:
        failures.append(text)


def said(command):
    done = subprocess.run(command, env=ENVIRONMENT, text=True, capture_output=True, timeout=60)
    expect(done.returncode == 0, f"{command[-1]}: status {done.returncode}: {done.stderr}")
    return [line.removeprefix("cablenet: note: ") for line in done.stderr.splitlines() if "is drawn" in line or "inside the bed" in line]


def drawn(given, patterns, ranks=(), **keys):
    """Each pattern fits one note about the drawing, in their order.  @return the groups of the first"""
    scene = given.scratch / "scene.yaml"
    scene.write_text(SCENE.format(**{**USUAL, **keys}))
    notes = said([given.program, "check", str(scene)])
    found = [re.search(pattern, note) for pattern, note in zip(patterns, notes)]
    expect(len(notes) == len(patterns) and all(found), f"{keys}: {len(patterns)} notes: {notes}")
    expect(all(note.startswith(f"{scene}:") for note in notes), f"{keys}: they say where")
    for count in ranks:
        other = said(["mpirun", "-n", str(count), given.program, "run", str(scene), "-o", str(given.scratch / "run")])
        expect(other == notes, f"{keys}: the same notes on {count} ranks: {other}")
    return [match.groups() if match else () for match in found]


def main():
    given = arguments(__doc__)
    drawn(given, [], (1,))
    [[count, depth]] = drawn(given, [r":9: cables\.one: it is drawn inside the bed with (\d+) of its nodes, by up to (\S+) m, .*"
                                     r"as shape: catenary does, or start from initial: static\."], (1, 2, 3), one=LOW)
    # The legs are 116.6 m and 397.0 m long, so that nodes are 25.68 m apart: 3 on the first, 4 on the second below -200.
    expect(abs(float(depth) - 53.5) < 3 and int(count) in (7, 8), f"{count} nodes, {depth} m")
    drawn(given, [r"cables\.two: it is drawn inside the bed with 1 of its nodes, by up to 40 m"], end=-240, two="length: 250")
    drawn(given, [r"cables\.one: .*, which throws them out at the start; so is 1 of the scene's cables and nets more\. "],
          one=LOW, end=-240, two="length: 250")
    drawn(given, [], anchor=-203)
    net = "nets: {net: {type: chain, corners: [[0, 0, -195], [10, 0, -195], [10, 0, -205], [0, 0, -205]], meshes: [2, 2], fixed: [top]}}\n"
    drawn(given, [r":11: nets\.net: it is drawn inside the bed with 3 of its nodes, by up to 5 m.* at the start\. Draw it above environment"],
          rest=net + USUAL["rest"])
    drawn(given, [], one=LOW, rest=USUAL["rest"] + "\ninitial: static")
    drawn(given, [], one=LOW, rest="")
    # Its elements are 42.5 m long.
    held = r":9: cables\.one: 1 of its fixed or moved nodes starts inside the bed, by up to 50 m, from where .* Put it above"
    drawn(given, [held], anchor=-250, one="length: 850", rest="")
    drawn(given, [], anchor=-240, one="length: 850", rest="")
    # A sphere of 0.5 m^3 has a radius of 0.4924 m; a cube of 1000 kg with the inertia 1000/6 kg m^2 has edges of 1 m.
    sphere = "-199.8], mass: 2000, volume: 0.5, velocity: [0, 0, 0"
    usual = {"two": "length: 250", "end": sphere}
    [[depth]] = drawn(given, [r":7: points\.r: it is drawn inside the bed by (\S+) m, which throws it out at the start\. Draw"],
                      (1, 2, 3), **usual)
    expect(float(depth) == 0.292, f"{depth} m")
    cube = "bodies: {cube: {mass: 1000, inertia: [166.667, 166.667, 166.667], position: [0, 50, -199.8]}}\n"
    [[depth]] = drawn(given, [r":11: bodies\.cube: it is drawn inside the bed by (\S+) m, .*; so is 1 of the scene's points and "
                              r"bodies more\. Draw"], **usual, rest=cube + USUAL["rest"])
    expect(float(depth) == 0.3, f"{depth} m")
    drawn(given, [], **usual, rest=cube + USUAL["rest"] + "\ninitial: static")
    drawn(given, [], two="length: 250", end=sphere.replace("-199.8", "-199.5"))
    way = 447.2136
    [[strain, pull, drawn_length, length]] = drawn(given, [
        r":9: cables\.one: it is drawn (\S+) % stretched in its element \d+ of 20, which pulls with (\S+) N\. Its chords are "
        r"(\S+) m long in all, and length is (\S+) m: correct one of them\."], (1, 2, 3), one="length: 400")
    expect(abs(float(strain) - 100 * (way / 400 - 1)) < 0.1 and abs(float(pull) / (3.27e9 * (way / 400 - 1)) - 1) < 0.01
           and abs(float(drawn_length) - way) < 0.01 and float(length) == 400, f"{strain} %, {pull} N")
    drawn(given, [], one=f"length: {way / 1.049}")
    drawn(given, [r"cables\.one: .*; so is 1 of the scene's cables more"], one=f"length: {way / 1.2}", two="length: 90")
    # The ends of the one are held.  What hangs on the other finds its place.
    drawn(given, [r"cables\.one: .*N\. Its"], one=f"length: {way / 1.2}", two="length: 90", rest="")
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
