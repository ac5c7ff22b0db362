"""Times of the editor by bodies: text to drawing, to motion, to a page that works out motions; frames of a drag.

    python -m benchmarks.editor 6 30 100 [--browser]

A scissor lift of so many bodies is checked and run as the page asks for it, first as it was opened, then after each of
three changes of a number, with what was loaded before out of the collector's sight, as in the server. Processor time is
that of this process [s]. With `--browser` Chromium drags a pin until there are twelve pictures: how many come in a
second, the server's processor time for each [s], and that of the page's thread for each of its frames [ms]. Before
that keys are typed into the text: the page's processor time for each [ms]. Then the page works out motions itself: its
processor time for a start [s] and for each second of motion [s].
"""

from __future__ import annotations

import argparse
import gc
import itertools
import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from symgen.cli._editor.drafts import Drafts

if TYPE_CHECKING:
    from tests.browser.chromium import Chromium
    from tests.browser.editor_page import Page

#: Half of a bar [m] and its angle at the start [rad].
HALF, ANGLE = 0.25, 0.6
#: What the mass of the first bar becomes [kg].
VALUES = (1.1, 1.2, 1.3)


def scissor_lift(bodies: int) -> str:
    """Return a file of a scissor lift: two bars a stage, a foot on a pin, a foot in a slot, a spring between them."""
    height, side = 2.0 * HALF * math.sin(ANGLE), HALF * math.cos(ANGLE)
    parts = ['[mechanism]\nname = "scissors"\ngravity = [0.0, -9.81]\n\n[run]\nuntil = 2.0\n']
    parts.append("[parameters]\nJ = 0.025\nk = 20000.0\n")
    for k in range(bodies // 2):
        inertia = 0.02 if k else '"J"'
        for name, angle in ((f"a{k}", ANGLE), (f"b{k}", math.pi - ANGLE)):
            parts.append(
                f"[bodies.{name}]\nmass = 1.0\ninertia = {inertia}\n"
                f"points = {{ A = [{-HALF}, 0.0], B = [{HALF}, 0.0] }}\n"
                f"position = [0.0, {height * (k + 0.5)!r}]\nangle = {angle!r}\n"
            )
    for k in range(bodies // 2):
        parts.append(f'[joints.m{k}]\ntype = "revolute"\nbetween = ["a{k}", "b{k}"]\nat = ["centre", "centre"]\n')
        for name, low, high in ((f"r{k}", f"a{k - 1}", f"b{k}"), (f"l{k}", f"b{k - 1}", f"a{k}")):
            if k:
                parts.append(f'[joints.{name}]\ntype = "revolute"\nbetween = ["{low}", "{high}"]\nat = ["B", "A"]\n')
    parts += [
        f'[joints.foot]\ntype = "revolute"\nbetween = ["ground", "a0"]\nat = [[{-side!r}, 0.0], "A"]\n',
        f'[joints.slot]\ntype = "pin-in-slot"\nbetween = ["b0", "ground"]\nat = ["A", [{side!r}, 0.0]]\n'
        "axis = [1.0, 0.0]\n",
        '[forces.hold]\ntype = "spring-damper"\nbetween = ["a0", "b0"]\nat = ["A", "A"]\n'
        'stiffness = "k"\ndamping = 300.0\nfree_length = 0.45\n',
    ]
    return "\n".join(parts)


def measure(bodies: int) -> list[tuple[str, float, float, float]]:
    """Return for each change of a number: what it is, and processor time of the drawing, the motion, the live part."""
    drafts, text, rows = Drafts(Path("scissors.toml")), scissor_lift(bodies), list[tuple[str, float, float, float]]()
    gc.collect()
    gc.freeze()
    for k, value in enumerate((1.0, *VALUES)):
        now, times = text.replace("mass = 1.0", f"mass = {value}", 1), [time.process_time()]
        drafts.check_text(now)
        times.append(time.process_time())
        drafts.run_motion(now, "a", k)
        times.append(time.process_time())
        drafts.live_page_data(now, "a", k)
        drawing, motion, live = (b - a for a, b in itertools.pairwise([*times, time.process_time()]))
        rows.append((f"mass {value}" if k else "opened", drawing, motion, live))
    gc.unfreeze()
    return rows


class Drag(NamedTuple):
    """What a drag was like.

    Attributes
    ----------
    pictures : float
        Pictures of the mechanism with its loops closed, each second.
    served : float
        Processor time of this process for each of them, the browser's protocol included [s].
    mean : float
        Processor time of the page's thread for a frame [ms].
    worst : float
        The longest frame by the clock [ms].
    """

    pictures: float
    served: float
    mean: float
    worst: float


class Worked(NamedTuple):
    """Processor time of a page that works out motions.

    Attributes
    ----------
    start : float
        For a start, closed anew [s].
    second : float
        For a second of motion, by the steps of the file [s].
    """

    start: float
    second: float


#: Notes how long frames take: from the beginning of one until the page has time for something else.
_WATCH = """(() => {
  const found = (window.worked = []), channel = new MessageChannel();
  let began = 0;
  channel.port1.onmessage = () => found.push(performance.now() - began);
  const frame = () => {
    began = performance.now();
    channel.port2.postMessage(0);
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
})()"""


def _thread_time(chromium: Chromium) -> float:
    """Return the processor time of the page's tasks [s]."""
    metrics = {entry["name"]: entry["value"] for entry in chromium.call("Performance.getMetrics")["metrics"]}
    return float(metrics["TaskDuration"])


@contextmanager
def opened_editor(bodies: int) -> Iterator[tuple[Chromium, Page]]:
    """Open the editor of a lift in Chromium, and wait until its page rests."""
    import tempfile

    from tests.browser.chromium import Chromium
    from tests.browser.editor_page import Page

    with tempfile.TemporaryDirectory() as folder, Chromium() as chromium:
        file = Path(folder) / "scissors.toml"
        file.write_text(scissor_lift(bodies))
        with Page.of(chromium, file) as page:
            page.editor.prepare()
            page.open()
            page.rested()
            yield chromium, page


def frames_of_drag(bodies: int, pictures: int = 12, patience: float = 60.0) -> Drag:
    """Return the times of a drag: a pin of the top, in Chromium, until the page has drawn some pictures."""
    with opened_editor(bodies) as (chromium, page):
        name = f"bodies.a{bodies // 2 - 1}.points.B"
        x, y = page.where(name)
        page.press("#snap")
        page.mouse("mousePressed", x, y)
        page.run(_WATCH)
        chromium.call("Performance.enable", timeDomain="threadTicks")
        page_time, own_time = _thread_time(chromium), time.process_time()
        count = "window.symgen.editor.times().frames"
        began, before, frames, k = time.monotonic(), page.run(count), 0, 0
        while frames < pictures and time.monotonic() - began < patience:
            k += 1
            page.mouse("mouseMoved", x + 10 * math.sin(0.3 * k), y + 5 + 5 * math.cos(0.3 * k))
            time.sleep(0.03)
            frames = page.run(count) - before
        spent = time.monotonic() - began
        worked = page.run("window.worked.splice(0)")
        page_time, own_time = _thread_time(chromium) - page_time, time.process_time() - own_time
        page.mouse("mouseReleased", x, y)
        page.rested()
    return Drag(frames / spent, own_time / max(frames, 1), 1e3 * page_time / len(worked), max(worked))


def motion_in_page(bodies: int, length: float = 0.2) -> Worked:
    """Return the times of motions that the page of an editor works out, as a slider or a hand asks for them."""
    with opened_editor(bodies) as (chromium, page):
        page.until("window.symgen.editor.times().lived === window.symgen.editor.version()")
        chromium.call("Performance.enable", timeDomain="threadTicks")
        spent = list[float]()
        for until in (length, length, 0.001, 2 * length):  # the first one compiles the script
            began = _thread_time(chromium)
            page.run(f"symgen.run({{}}, {until})")
            spent.append(_thread_time(chromium) - began)
    return Worked(spent[2], (spent[3] - spent[1]) / length)


def key_in_page(bodies: int, keys: int = 20) -> float:
    """Return the processor time of the page's thread for a key that is typed into the first line [ms]."""
    with opened_editor(bodies) as (chromium, page):
        page.until("window.symgen.editor.times().lived === window.symgen.editor.version()")
        page.type(0, "# ")
        chromium.call("Performance.enable", timeDomain="threadTicks")
        began = _thread_time(chromium)
        for _ in range(keys):
            chromium.call("Input.insertText", text="a")
            page.run("new Promise((shown) => requestAnimationFrame(() => setTimeout(shown)))")
        return 1e3 * (_thread_time(chromium) - began) / keys


def main() -> None:
    """Print a table for each number of bodies."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("bodies", nargs="+", type=int)
    parser.add_argument("--browser", action="store_true")
    given = parser.parse_args()
    for bodies in given.bodies:
        for what, *spent in measure(bodies):
            print(
                f"{bodies:4d} bodies  {what:9s}", *(f"{name} {x:.3f} s" for name, x in zip(NAMES, spent, strict=True))
            )
        if given.browser:
            print(f"{bodies:4d} bodies  a key in the text: {key_in_page(bodies):.1f} ms")
            worked = motion_in_page(bodies)
            print(
                f"{bodies:4d} bodies  in the page: {worked.start:.3f} s for a start,"
                f" {worked.second:.2f} s for a second of motion"
            )
            drag = frames_of_drag(bodies)
            print(
                f"{bodies:4d} bodies  a pin is dragged: {drag.pictures:.1f} pictures a second,"
                f" {drag.served:.3f} s for each; frames of {drag.mean:.1f} ms, at most {drag.worst:.1f} ms by the clock"
            )


NAMES = ("drawing", "motion", "live part")

if __name__ == "__main__":
    main()
