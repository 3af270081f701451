"""Counts instructions by callgrind, because a busy machine does not disturb that number."""
import re
import shutil

from . import scenes

SCHEMES = {"energy_momentum": {"scheme": "energy_momentum"},
           "generalized_alpha, spectral_radius 0.8": {"scheme": "generalized_alpha", "spectral_radius": 0.8}}


def collected(laboratory, scene, steps):
    """The number of instructions of a whole run."""
    out = laboratory.folder / "callgrind.out"
    tool = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}"]
    laboratory.execute([*tool, *laboratory.command(scene, "-ts_max_steps", steps)])
    return int(re.search(r"^(?:totals|summary): (\d+)", out.read_text(encoding="utf-8"), re.MULTILINE)[1])


def free_fall(laboratory, page, few, many):
    page.heading("7. Instructions of a step of the free fall, 24 elements, step 1e-3 s")
    if not shutil.which("valgrind"):
        page.write("not measured: valgrind is not installed")
        return
    rows = []
    for name, scheme in SCHEMES.items():
        scene = scenes.chain(24, 1e-3, scheme=scheme)
        newton = [laboratory.run(scene, steps=steps).report["newton_iterations"] for steps in (few, many)]
        counts = [collected(laboratory, scene, steps) for steps in (few, many)]
        rows.append([name, f"{few} to {many}", f"{(newton[1] - newton[0]) / (many - few):.2f}",
                     f"{(counts[1] - counts[0]) / (many - few):,.0f}"])
    page.table(["scheme", "steps", "Newton per step", "instructions per step"], rows)
