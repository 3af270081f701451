"""The size rule: headers <= 120 lines, sources <= 300, functions <= 40."""
import argparse
import ast
import pathlib
import re
import sys

HEADER_LINES = 120
SOURCE_LINES = 300
FUNCTION_LINES = 40

# A counter of braces must not see comments, literals (raw ones too) and preprocessor lines.
HIDDEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'|^[ \t]*#(?:\\\n|[^\n])*",
    re.DOTALL | re.MULTILINE)
TEMPLATE = re.compile(r"template\s*<[^<>]*(?:<[^<>]*>[^<>]*)*>")
ACCESS = re.compile(r"\b(?:public|protected|private)\s*:(?!:)")
CONTAINER = re.compile(r"^(?:inline\s+)?namespace\b|^(?:typedef\s+)?(?:class|struct|union|enum)\b|^extern\s*$")


def blank(match):
    """The text with everything but its line ends removed, so that line numbers stay."""
    return " " + "\n" * match[0].count("\n")


def head_text(head):
    return ACCESS.sub(" ", TEMPLATE.sub(" ", head)).strip()


def function_name(head):
    names = re.findall(r"((?:\w+::)*~?\w+|operator\s*\S+?)\s*\(", head)
    return names[0] if names else head


def functions(text):
    """(name, first line, number of lines) of each function outside other functions."""
    text = HIDDEN.sub(blank, text)
    found, depth, line = [], 0, 1          # depth: number of open braces inside a function or an initialiser
    head, head_line = "", 1
    for position, char in enumerate(text):
        if depth == 0 and char == "{":
            if CONTAINER.match(head_text(head)):
                head = ""
            else:
                depth = 1
        elif depth and char in "{}":
            depth += 1 if char == "{" else -1
            if depth == 0 and not re.match(r"\s*[,;{)]", text[position + 1:position + 200]):
                if "(" in head:
                    found.append((function_name(head_text(head)), head_line, line - head_line + 1))
                head = ""
        elif depth == 0 and char in ";}":
            head = ""
        elif depth == 0 and (head or not char.isspace()):
            head_line = head_line if head else line
            head += char
        line += char == "\n"
    return found


def python_functions(text):
    """The same of a file in Python."""
    return [(node.name, node.lineno, node.end_lineno - node.lineno + 1) for node in ast.walk(ast.parse(text))
            if isinstance(node, ast.FunctionDef)]


def complaints_in(path):
    text = path.read_text(encoding="utf-8")
    lines = text.count("\n")
    limit = HEADER_LINES if path.suffix == ".hpp" else SOURCE_LINES
    if lines > limit:
        yield f"{path}: {lines} lines, at most {limit}"
    for name, line, length in python_functions(text) if path.suffix == ".py" else functions(text):
        if length > FUNCTION_LINES:
            yield f"{path}:{line}: {name} has {length} lines, at most {FUNCTION_LINES}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, required=True)
    root = parser.parse_args().root
    files = sorted(path for top in ("include", "src") for suffix in ("hpp", "cpp", "py")
                   for path in (root / top).rglob(f"*.{suffix}"))
    complaints = [text for path in files for text in complaints_in(path)]
    print("\n".join(complaints + [f"{len(files)} files, {len(complaints)} complaints"]))
    return 1 if complaints or not files else 0


if __name__ == "__main__":
    sys.exit(main())
