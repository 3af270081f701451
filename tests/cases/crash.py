"""Kills a running simulation at random moments and checks that the files which it had closed are whole."""
import argparse
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml

import h5py
import numpy

from bench import ENVIRONMENT, SCENES

TYPES = {("Float", "8"): numpy.float64, ("Int", "4"): numpy.int32}
SCENE = (SCENES / "crash.yaml").read_text(encoding="utf-8")

SIGNS = ("cables.xmf", "mesh.h5", "cables.xmf", None)      # the file whose writing starts the delay until the kill


class Damage(Exception):
    pass


def require(truth, text):
    if not truth:
        raise Damage(text)


def members(session):
    """The live processes of a session: mpirun gives each rank a process group of its own."""
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            fields = (folder / "stat").read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        if int(fields[3]) == session and fields[0] != "Z":
            yield int(folder.name)


def remove_leftovers(mpirun):
    """Removes the shared memory and the session folder that killed ranks leave behind.  Nothing else removes them."""
    for session in pathlib.Path(tempfile.gettempdir()).glob(f"ompi.*/pid.{mpirun.pid}"):
        contact = session / "contact.txt"
        if contact.exists():
            family = int(contact.read_text().split(".")[0]) >> 16      # each mpirun has a family of job numbers
            for segment in pathlib.Path("/dev/shm").glob(f"vader_segment.*.{family:x}????.*"):
                segment.unlink(missing_ok=True)
        shutil.rmtree(session, ignore_errors=True)


def kill(mpirun):
    """Kills mpirun and all its ranks at once."""
    while pids := list(members(mpirun.pid)):
        for pid in pids:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        time.sleep(0.01)
    mpirun.wait()
    remove_leftovers(mpirun)


def identity(path):
    try:
        status = path.stat()
    except FileNotFoundError:
        return None
    return status.st_ino, status.st_mtime_ns


def run_and_kill(program, scene, run, sign, delay):
    """Kills a run `delay` seconds after it has written the file `sign`, or after its start."""
    before = identity(run / sign) if sign else None
    with open(run.parent / "log", "ab") as log:
        mpirun = subprocess.Popen(["mpirun", "-n", "2", program, "run", scene, "-o", run], env=ENVIRONMENT,
                                  stdout=log, stderr=log, start_new_session=True)
    try:
        deadline = time.monotonic() + 60
        while sign and identity(run / sign) in (None, before):
            require(mpirun.poll() is None, f"the run ended by itself: see {run.parent / 'log'}")
            require(time.monotonic() < deadline, f"no {sign} after 60 s")
            time.sleep(0.002)
        time.sleep(delay)
        require(mpirun.poll() is None, f"the run ended by itself: see {run.parent / 'log'}")
    finally:
        kill(mpirun)


def check_dataset(run, item):
    file, name = item.text.split(":")
    with h5py.File(run / file, "r") as data:
        require(name in data, f"{item.text} is not there")
        values = data[name][()]
    shape = tuple(int(size) for size in item.get("Dimensions").split())
    require(values.shape == shape, f"{item.text}: shape {values.shape} instead of {shape}")
    require(values.dtype == TYPES[item.get("NumberType"), item.get("Precision")], f"{item.text}: {values.dtype}")
    require(numpy.isfinite(values).all(), f"{item.text}: not finite")


def check_frames(run):
    """Checks that all frames of the index are whole and in result.h5.  @return their number"""
    steps = xml.parse(run / "cables.xmf").getroot().findall("./Domain/Grid/Grid")
    with h5py.File(run / "result.h5", "r") as result:
        for number, step in enumerate(steps):
            time_listed = float(step.find("Time").get("Value"))
            require(result[f"frames/{number:08}"].attrs["time"] == time_listed, f"frame {number}: another time")
    for item in {item.text: item for step in steps for item in step.iter("DataItem")}.values():
        check_dataset(run, item)
    return len(steps)


def check_history(run):
    """Checks that all rows have a number for each column, but for the last row, which the kill may have cut."""
    if not (run / "history.csv").exists():
        return
    header, *rows = (run / "history.csv").read_text().split("\n")[:-1] or [""]
    for row in rows:
        require(len([float(cell) for cell in row.split(",")]) == header.count(",") + 1, f"history row {row!r}")


def check(run):
    """@return number of frames that survived"""
    if not run.exists():
        return 0
    for path in run.glob("*.h5"):
        try:
            h5py.File(path, "r").close()
        except OSError as error:
            raise Damage(f"{path.name}: {error}") from error
    check_history(run)
    return check_frames(run) if (run / "cables.xmf").exists() else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--scratch", type=pathlib.Path, required=True)
    parser.add_argument("--kills", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    shutil.rmtree(given.scratch, ignore_errors=True)
    given.scratch.mkdir(parents=True)
    scene = given.scratch / "scene.yaml"
    scene.write_text(SCENE)
    chance = random.Random(given.seed)
    survivors = []
    for number in range(given.kills):
        # All runs use one folder, so that a kill can also hit the removal of an earlier run.
        sign = SIGNS[number % len(SIGNS)]
        delay = chance.uniform(0, 1.5)
        moment = f"kill {number}, {delay:.3f} s after {sign or 'its start'}"
        try:
            run_and_kill(given.program, scene, given.scratch / "run", sign, delay)
            survivors.append(check(given.scratch / "run"))
        except (Damage, KeyError, OSError, xml.ParseError) as damage:
            print(f"{moment}: {damage}")
            return 1
        print(f"{moment}: {survivors[-1]} frames, all whole", flush=True)
    if not any(survivors):
        print("no run lived long enough to close a segment: nothing was tested")
        return 1
    shutil.rmtree(given.scratch)
    return 0


if __name__ == "__main__":
    sys.exit(main())
