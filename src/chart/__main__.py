"""cablenet chart: the program starts this folder as  python3 FOLDER PROGRAM WORDS...

It needs numpy, PyYAML and matplotlib.
"""
import sys

import messages


def main():
    program, words = sys.argv[1], sys.argv[2:]
    messages.Signals.catch()
    try:
        from command_line import parse
        given = parse(words)
        from chart import make_chart
        return make_chart(program, given)
    except ModuleNotFoundError as error:
        messages.complain(f"chart needs Python's module {error.name}, which {sys.executable} does not have; install it "
                          "(Debian: python3-numpy, python3-yaml, python3-matplotlib), or name another Python in "
                          "CABLENET_PYTHON")
        return messages.WRONG_INPUT
    except messages.Refusal as refusal:
        messages.complain(refusal)
        return refusal.status
    except OSError as error:
        messages.complain(f"{error.filename or 'a file'}: {error.strerror or error}")
        return messages.NO_OUTPUT
    except KeyboardInterrupt:
        messages.complain("stopped; the finished runs are kept, and the same command goes on with them")
        return messages.STOPPED


if __name__ == "__main__":
    sys.exit(main())
