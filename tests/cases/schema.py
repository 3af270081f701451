"""The JSON Schema that the program prints takes every valid scene, and refuses the broken ones where one key is wrong."""
import argparse
import json
import pathlib
import re
import subprocess
import sys

import jsonschema
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASES = ROOT / "tests" / "cases"
# Broken by a rule between keys, by a name that nothing bears, by values that must differ, or by what YAML itself hides.
BEYOND = """
    009-013 021 028 032-033 035-038 045 048 057-058 060-061 065 068 071-076 078 081-084 087 091-098
    100-102 105-111 114 119-121 123-124 126-127 134-135 137 139-145 147-149 158 160-179 183 202-205 209
    215 224-227 232-233 243-244 250-251 253-259 261 265
"""


class Loader(yaml.SafeLoader):
    """Reads plain words as an editor does: by YAML 1.2, where yes is a text and 1e3 a number."""
    yaml_implicit_resolvers = {}

    def construct_mapping(self, node, deep=False):
        """Names are texts, also 1 and true."""
        return {key.value: self.construct_object(value, deep=True) for key, value in node.value}


def add_type(tag, pattern):
    Loader.add_implicit_resolver(f"tag:yaml.org,2002:{tag}", re.compile(pattern), None)


add_type("bool", r"^(true|false)$")
add_type("null", r"^(~|null|)$")
add_type("int", r"^[-+]?[0-9]+$")
add_type("float", r"^[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?$")
Loader.add_constructor("tag:yaml.org,2002:int", lambda loader, node: int(node.value))
Loader.add_constructor("tag:yaml.org,2002:float", lambda loader, node: float(node.value))
Loader.add_constructor("tag:yaml.org,2002:map", lambda loader, node: loader.construct_mapping(node))


def load(path):
    return yaml.load(path.read_text(), Loader)


def first_error(validator, path):
    """What the schema says against a scene, or nothing."""
    error = jsonschema.exceptions.best_match(validator.iter_errors(load(path)))
    return f"{'.'.join(map(str, error.path))}: {error.message[:200]}" if error else None


def is_document(path):
    try:
        load(path)
        return True
    except yaml.YAMLError:
        return False


def numbered(text):
    """The numbers in a text like "003 007-009"."""
    ends = [list(map(int, part.split("-"))) for part in text.split()]
    return {number for first, *last in ends for number in range(first, (last or [first])[0] + 1)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--scratch", required=True, help="not needed: nothing is written")
    options = parser.parse_args()
    done = subprocess.run([options.program, "schema"], capture_output=True, text=True, check=True, timeout=60)
    schema = json.loads(done.stdout)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    failures = []
    valid = [*(CASES / "valid").glob("*.yaml"), *(ROOT / "examples").glob("**/scene*.yaml")]
    assert len(valid) >= 14, f"only {len(valid)} scenes found"
    failures += [f"{path.relative_to(ROOT)}: {error}" for path in valid if (error := first_error(validator, path))]
    broken = {int(path.name[:3]): path for path in sorted((CASES / "broken").glob("*.yaml"))}
    taken = {number for number, path in broken.items() if is_document(path) and not first_error(validator, path)}
    beyond = numbered(BEYOND)
    assert len(broken) - len(beyond) >= 120, "too few broken scenes are left to the schema"
    failures += [f"{broken[number].name}: the schema takes it" for number in sorted(taken - beyond)]
    failures += [f"{broken[number].name}: the schema refuses it, so take it out of BEYOND"
                 for number in sorted(beyond - taken)]
    print("\n".join(failures))
    print(f"{len(valid)} valid scenes, {len(broken)} broken ones, {len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
