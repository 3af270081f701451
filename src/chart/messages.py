"""What the chart says, and how it ends: the program's words and exit statuses."""
import signal
import sys

WRONG_INPUT, NO_SOLUTION, NO_OUTPUT, STOPPED = 2, 3, 4, 5


class Refusal(Exception):
    """The chart cannot be made.  @param status  the exit status"""

    def __init__(self, text, status=WRONG_INPUT):
        super().__init__(text)
        self.status = status


def complain(text):
    print(f"cablenet: error: {text}", file=sys.stderr)


def note(text):
    print(f"cablenet: note: {text}", file=sys.stderr)


def listed(names, most=6):
    """Names, but not too many."""
    names = list(names)
    return ", ".join(names[:most]) + (f" and {len(names) - most} more" if len(names) > most else "")


def counted(number, thing):
    return f"{number} {thing}" + ("" if number == 1 else "s")


def multiple(factor):
    """A factor in words: x 2, / 4."""
    return f"x {factor}" if factor >= 1 else f"/ {1 / factor}"


def percent(error):
    """A share of a range, with two digits."""
    return f"{100 * error:.2g} %" if error < 0.995 else f"{100 * error:.0f} %"


def seconds(value):
    return f"{value:.3g} s" if value >= 0.01 else f"{1000 * value:.2g} ms"


def stepping_text(stepping):
    if stepping is None:
        return "static"
    if stepping.tolerance is not None:
        return f"adaptive, tolerance {stepping.tolerance:.3g} m"
    return f"step {stepping.step:.4g} s"


class Signals:
    """A signal interrupts what is being done.  Libraries may swallow that, so that it is also remembered."""
    has_come = False

    @classmethod
    def catch(cls):
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, cls._stop)

    @classmethod
    def _stop(cls, *_):
        cls.has_come = True
        raise KeyboardInterrupt

    @classmethod
    def obey(cls):
        if cls.has_come:
            raise KeyboardInterrupt


class Progress:
    """One line that changes on a terminal, plain lines elsewhere."""
    WIDTH = 24

    def __init__(self, stream=sys.stderr):
        self.stream = stream
        self.is_terminal = stream.isatty()
        self.runs = 0

    def show(self, spent, budget, text):
        self.runs += 1
        done = min(self.WIDTH, int(self.WIDTH * spent / budget))
        head = f"run {self.runs}, {spent:.1f} of {budget:.4g} s of CPU"
        if self.is_terminal:
            bar = "#" * done + "-" * (self.WIDTH - done)
            print(f"\r\033[K[{bar}] {head}: {text}"[:118], end="", file=self.stream, flush=True)
        else:
            print(f"cablenet: {head}: {text}", file=self.stream, flush=True)

    def finish(self):
        if self.is_terminal and self.runs:
            print("\r\033[K", end="", file=self.stream, flush=True)
