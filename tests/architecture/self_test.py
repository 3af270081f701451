"""The checkers of this folder find what is planted, and nothing in a tree that is right."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOMS = ["--physics", "base", "elements", "--machinery", "system", "output", "solve", "app"]
GOOD = {
    "include/cablenet/base/errors.hpp": "#include <stdexcept>\n",
    "include/cablenet/elements/cable.hpp": '#include "cablenet/base/errors.hpp"\n',
    "src/solve/dynamics.cpp": '#include <petscts.h>\n#include "cablenet/elements/cable.hpp"\n#include "private.hpp"\n',
    "src/solve/private.hpp": "#include <mpi.h>\n",
    "src/app/run.cpp": '#include "cablenet/output/series.hpp"\n',
    "include/cablenet/output/series.hpp": "",
}


def check(script, planted, arguments=()):
    """Runs a checker over the good tree with `planted` added.  @return (exit status, what it printed)"""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**GOOD, **planted}.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        command = [sys.executable, str(HERE / script), "--root", folder, *arguments]
        result = subprocess.run(command, capture_output=True, text=True)
        return result.returncode, result.stdout


class Includes(unittest.TestCase):
    def expect_complaint(self, name, line, words):
        status, printed = check("includes.py", {name: f"#pragma once\n{line}\n"}, ROOMS)
        self.assertEqual(status, 1, printed)
        self.assertIn(name, printed)
        self.assertIn(words, printed)
        self.assertIn("1 complaints", printed)

    def test_right_tree_passes(self):
        status, printed = check("includes.py", {}, ROOMS)
        self.assertEqual(status, 0, printed)

    def test_arrow_to_the_right(self):
        self.expect_complaint("src/elements/cable.cpp", '#include "cablenet/system/state.hpp"', "rooms to its left")

    def test_relative_arrow_to_the_right(self):
        self.expect_complaint("src/elements/cable.cpp", '#include "../app/run.hpp"', "rooms to its left")

    def test_unknown_folder(self):
        self.expect_complaint("src/util/things.cpp", "", "no known room")

    def test_file_outside_rooms(self):
        self.expect_complaint("include/cablenet/all.hpp", "", "no known room")

    def test_unknown_room_included(self):
        self.expect_complaint("src/app/main.cpp", "#include <cablenet/util/things.hpp>", "is no room")

    def test_machinery_in_physics(self):
        for header in ("mpi.h", "petscvec.h", "petsc/private/vecimpl.h", "metis.h", "hdf5.h"):
            self.expect_complaint("src/elements/cable.cpp", f"#include <{header}>", "physics rooms")

    def test_solve_includes_output(self):
        line = '#include "cablenet/output/series.hpp"'
        self.expect_complaint("src/solve/run.cpp", line, "solve does not know output")

    def test_empty_tree_fails(self):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, str(HERE / "includes.py"), "--root", folder, *ROOMS]
            self.assertEqual(subprocess.run(command, capture_output=True).returncode, 1)


class Sizes(unittest.TestCase):
    HEAD = "namespace a {\nstruct B {\n  B() : x{1}, y{2} {}\n  int x, y;\n};\nconst char* brace = \"{\";   // {\n"

    def sizes(self, name, text):
        return check("sizes.py", {name: text})

    def test_functions(self):
        for lines, status in ((40, 0), (41, 1)):
            body = "  if (x) {\n  }\n" + "  ++x;\n" * (lines - 4)
            text = f"{self.HEAD}template <class T>\nint after(T);\nint B::planted(int x) const {{\n{body}}}\n}}\n"
            found, printed = self.sizes("src/app/planted.cpp", text)
            self.assertEqual(found, status, printed)
            self.assertEqual("src/app/planted.cpp:9: B::planted has 41 lines" in printed, status == 1, printed)

    def test_constructor_with_braced_members(self):
        body = "  ++x;\n" * 40
        found, printed = self.sizes("src/app/planted.cpp", f"B::B(int n)\n    : x{{n}}, y{{n}} {{\n{body}}}\n")
        self.assertEqual(found, 1, printed)
        self.assertIn("B::B has 43 lines", printed)

    def test_tables_are_no_functions(self):
        table = "const std::array<int, 60> table = {\n" + "    1,\n" * 60 + "};\n"
        found, printed = self.sizes("src/app/table.cpp", table)
        self.assertEqual(found, 0, printed)

    def test_functions_in_python(self):
        for lines, status in ((40, 0), (41, 1)):
            text = "class A:\n    def planted(self):\n" + "        x = 1\n" * (lines - 1) + "\n\ny = 2\n"
            found, printed = self.sizes("src/app/planted.py", text)
            self.assertEqual(found, status, printed)
            self.assertEqual("src/app/planted.py:2: planted has 41 lines" in printed, status == 1, printed)

    def test_files(self):
        for name, limit in (("include/cablenet/app/long.hpp", 120), ("src/app/long.cpp", 300), ("src/app/long.py", 300)):
            line = "x = 1\n" if name.endswith(".py") else "int x;\n"
            self.assertEqual(self.sizes(name, line * limit)[0], 0)
            found, printed = self.sizes(name, line * (limit + 1))
            self.assertEqual(found, 1, printed)
            self.assertIn(f"{limit + 1} lines, at most {limit}", printed)


class Rebuilds(unittest.TestCase):
    """Every source in src/app/ includes a kernel through another header."""
    ROOMS = ["--rooms", "elements", "--data", "elements/cable_data.hpp"]
    TREE = {"include/cablenet/elements/cable_data.hpp": "",
            "include/cablenet/elements/cable.hpp": '#include "cablenet/elements/cable_data.hpp"\n',
            "src/app/near.hpp": '#include "cablenet/elements/cable.hpp"\n'}

    def rebuilds(self, sources, changed={}):
        users = {f"src/app/user_{i}.cpp": '#include "near.hpp"\n' for i in range(sources)}
        return check("rebuilds.py", {**self.TREE, **users, **changed}, self.ROOMS)

    def test_users_are_counted_through_headers(self):
        # The good tree has one more source, src/solve/dynamics.cpp.
        for sources, status in ((14, 0), (15, 1)):
            found, printed = self.rebuilds(sources)
            self.assertEqual(found, status, printed)
            self.assertIn(f"elements/cable.hpp: {sources + 1} files", printed)
            self.assertEqual("src/app/user_0.cpp" in printed, status == 1, printed)

    def test_data_may_be_everywhere(self):
        found, printed = self.rebuilds(15, {"src/app/near.hpp": '#include "cablenet/elements/cable_data.hpp"\n'})
        self.assertEqual(found, 0, printed)

    def test_data_header_that_is_gone(self):
        status, printed = check("rebuilds.py", {}, self.ROOMS)
        self.assertEqual(status, 1, printed)
        self.assertIn("elements/cable_data.hpp: there is no such header", printed)


if __name__ == "__main__":
    unittest.main()
