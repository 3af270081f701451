"""Writes the scenes through time that body_ranks.py and water_ranks.py make, for tests/parallel/resume_test.cpp.

write_scenes.py FOLDER
"""
import json
import pathlib
import shutil
import sys

import body_ranks
import water_ranks


def scenes():
    """{name: scene}"""
    made = {f"bodies, {name}": body_ranks.scene(keys) for name, keys in body_ranks.SCHEMES.items()}
    made.update({f"water, {name}": keys for name, keys in water_ranks.variants().items()})
    return {name: keys for name, keys in made.items() if "time" in keys}


def main():
    folder = pathlib.Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name, keys in scenes().items():
        path = folder / f"{name.replace(',', '').replace(' ', '_')}.yaml"
        path.write_text(json.dumps(keys), encoding="utf-8")   # JSON is YAML


if __name__ == "__main__":
    main()
