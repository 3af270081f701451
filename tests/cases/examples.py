"""Each example's own run line works, and the numbers that its README gives are those of its runs."""
import pathlib
import sys

import example_numbers
from bench import arguments
from example_claims import Claims

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main():
    given = arguments(__doc__)
    examples = sorted(path.parent for path in (ROOT / "examples").glob("*/README.md"))
    wrong = 0
    for example in examples:
        claims = Claims(example, given.program, given.scratch)
        try:
            getattr(example_numbers, example.name)(claims)
        except AssertionError as error:
            claims.wrong.append(str(error))
        print(f"{example.name}: {claims.compared} numbers compared, {claims.count} runs", flush=True)
        wrong += len(claims.wrong)
        print("".join(f"FAIL {example.name}: {text}\n" for text in claims.wrong), end="")
    return 1 if wrong or not examples else 0


if __name__ == "__main__":
    sys.exit(main())
