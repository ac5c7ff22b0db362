"""One cache for all tests of a session, so that the runtime's loops are compiled once, never the user's own cache.

Worker processes of pytest-xdist inherit it through the environment. SYMGEN_TEST_CACHE_DIR keeps it between sessions.
"""

from __future__ import annotations

import gc
import locale
import os
import shutil
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers

#: Random inputs of a test that does not say how many it draws; every run draws others.
EXAMPLES = 15

# no test depends on how fast a machine is or how busy: neither an example's time nor that of drawing it is bounded
settings.register_profile("any machine", max_examples=EXAMPLES, deadline=None, suppress_health_check=list(HealthCheck))
settings.load_profile("any machine")

# It would look for numbers and texts to try in every imported module that is no library's, and so in all that symgen
# emits in a session, again and again as more are imported: half a minute. Draws would depend on what ran before.
providers._get_local_constants = lambda: providers._local_constants

# Hundreds of tests start processes, each of which would compile the sources of all it imports: half of its time.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# Each processor has a worker: threads of linear algebra would wait for each other, at matrices of a few rows.
for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

# Programs with windows take the decimal comma of the user's language, for all that prints numbers in them.
with suppress(locale.Error):
    locale.setlocale(locale.LC_NUMERIC, "")

# The turn by which `support.rotation` chooses cases: the same ones every time unless another one, or all, is asked for.
os.environ.setdefault("SYMGEN_TEST_TURN", "0")

#: Set where the newest libraries are tried: what they announce to change is an error there. Older ones announce what is
#: long mended, and a library that is newer than all that was tried makes no test of a checkout fail by an announcement.
ANNOUNCEMENTS = "SYMGEN_TEST_ANNOUNCEMENTS"

#: Objects that may come into being between two collections of the young ones; young ones, and older ones, that go
#: before those behind them. A session holds some millions: Python's own numbers look through them all the time.
COLLECTIONS = (10_000, 20, 50)

#: Tests of half a minute and more, which come first: last, they would leave all workers but one idle.
LONGEST = {
    "test_many_random_mechanisms",
    "test_random_mechanisms_by_every_method",
    "test_a_curved_body_flies_as_all_nodes_do",
    "test_a_geneva_wheel",
    "test_a_ratchet_over_the_angle_at_which_it_starts",
    "test_another_floating_frame_is_off_by_the_second_order_of_the_deformation",
    "test_drawn_lines_of_a_record_are_measured_again",
    "test_functions_are_numbas",
    "test_no_row_is_lost_or_computed_twice_by_a_lost_worker_and_a_lost_scheduler",
    "test_runs_are_numbas",
    "test_runs_of_looped_code_are_numbas",
    "test_scipy_agrees_on_the_stiff_case",
    "test_some_of_the_cells_are_measured_again",
    "test_the_rod_bends_as_beams_do",
}

_made: list[Path] = []


def pytest_configure(config: pytest.Config) -> None:
    """Choose the cache before anything of symgen asks for it; let libraries announce changes, unless asked to fail."""
    if not os.environ.get(ANNOUNCEMENTS):
        for category in ("DeprecationWarning", "PendingDeprecationWarning", "FutureWarning"):
            config.addinivalue_line("filterwarnings", f"default::{category}")
    if hasattr(config, "workerinput") and "SYMGEN_CACHE_DIR" in os.environ:
        return
    kept = os.environ.get("SYMGEN_TEST_CACHE_DIR")
    if kept:
        os.environ["SYMGEN_CACHE_DIR"] = kept
        return
    session = os.environ.get("PYTEST_XDIST_TESTRUNUID")
    if session:  # a worker that inherited nothing: all workers of the session agree on this name
        os.environ["SYMGEN_CACHE_DIR"] = str(Path(tempfile.gettempdir()) / f"symgen-tests-{session}")
        return
    _made.append(Path(tempfile.mkdtemp(prefix="symgen-tests-")))
    os.environ["SYMGEN_CACHE_DIR"] = str(_made[0])


@pytest.hookimpl(tryfirst=True)  # before tests are chosen by their markers
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Put the longest tests in front; mark cases slow that `fast` does not name, or `slow_cases` does."""
    items.sort(key=lambda item: item.name.partition("[")[0] not in LONGEST)
    named: dict[str, set[str]] = {}
    for item in items:
        place, _, case = item.nodeid.removesuffix("]").partition("[")
        for name in ("fast", "slow_cases"):
            marker = item.get_closest_marker(name)
            if marker is None:
                continue
            if (case in marker.args) == (name == "slow_cases"):
                item.add_marker("slow")
            named.setdefault(place, set(marker.args)).discard(case)
    if any("::" in word for word in config.args):  # where one case is asked for, others are absent
        return
    for place, unknown in named.items():
        if unknown:
            raise pytest.UsageError(f"{place}: no case is called {', '.join(sorted(unknown))}")
    _take_turns(config, items)


def _take_turns(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out the slow cases of tests marked `by_turns` that belong to another turn."""
    from support.rotation import has_turn, of_turn  # behind the choice of the turn

    cases: dict[str, list[pytest.Item]] = {}
    for item in items:
        if item.get_closest_marker("by_turns") and item.get_closest_marker("slow"):
            cases.setdefault(item.nodeid.partition("[")[0], []).append(item)
    others: set[pytest.Item] = set()
    for place, own in cases.items():
        turns = own[0].get_closest_marker("by_turns").args[0]
        if len(own) == 1:
            others.update(() if has_turn(place, turns) else own)
        else:
            others.update(set(own) - set(of_turn(own, turns, place)))
    if others:
        config.hook.pytest_deselected(items=[item for item in items if item in others])
        items[:] = [item for item in items if item not in others]


def pytest_collection_finish() -> None:
    """Leave modules and collected tests, which last as long as the session, out of garbage collection."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(*COLLECTIONS)


def pytest_unconfigure() -> None:
    """Remove the cache that this process made."""
    for path in _made:
        shutil.rmtree(path, ignore_errors=True)


@pytest.fixture
def decimal_point():
    """Other programs read their files by the language of the process, which is set beside symgen."""
    before = locale.setlocale(locale.LC_NUMERIC)
    locale.setlocale(locale.LC_NUMERIC, "C")
    yield
    locale.setlocale(locale.LC_NUMERIC, before)


@pytest.fixture
def cli(capsys):
    """Run the command line; return exit code, standard output and standard error."""
    from symgen.cli import main  # behind the choice of the cache

    def run(*arguments):
        code = main([str(a) for a in arguments])
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return run
