"""Run the tests that a change enters: `make affected`, a plugin of pytest for who changes symgen.

While a test runs, the files are recorded whose functions it enters and those that it opens. The next time, tests run
that entered a file which differs since, those that failed, and new ones. What fixtures of more than one test enter
belongs to each of these. A test that starts processes, or asks the cache for emitted code, is taken to enter all that
may be behind. A file of constants alone is entered by nobody: tests that enter the files which import it stand for it.

The map is `out/affected.json`; where it is absent, all tests run. It is a help while one works: what another test left
in memory or in the cache is not entered again, so that a change is done when `make test` is green.
"""

from __future__ import annotations

import ast
import hashlib
import json
import os
import sys
from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
MAP = ROOT / "out" / "affected.json"
FOLDERS = ("symgen", "templates", "tests", "benchmarks", "docs", "generated", "examples")
#: Files on which all tests depend.
ALWAYS = ("pyproject.toml", "tests/conftest.py")
#: Beginnings of the names of files that are behind one that is entered, in another process or an earlier one.
BEHIND = {
    "symgen/run/compiling/folders.py": ("symgen/derive/", "symgen/base/ir/", "templates/"),
    "tests/support/processes.py": ("symgen/", "templates/"),
}
#: Stands for a process that a test starts.
PROCESS = "tests/support/processes.py"
#: Key of a report that tells a worker's records to the session.
RECORD = "entered"


def digests_of_files(root: Path = ROOT) -> dict[str, str]:
    """Return the digest of each file that a test may enter, by its name from the root on."""
    paths = [root / name for name in ALWAYS]
    for folder in FOLDERS:
        paths += (root / folder).rglob("*")
    return {
        path.relative_to(root).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(set(paths))
        if path.is_file() and "__pycache__" not in path.parts
    }


def importers(names: Collection[str], root: Path = ROOT) -> dict[str, set[str]]:
    """Return the modules of the project that import each of some modules, by the names of files."""
    found: dict[str, set[str]] = {name: set() for name in names}
    modules = {name.removesuffix(".py").replace("/", ".").removeprefix("tests."): name for name in names}
    for path in (path for folder in ("symgen", "tests", "benchmarks") for path in (root / folder).rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_bytes())):
            words = []
            if isinstance(node, ast.ImportFrom) and node.module:
                words = [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
            elif isinstance(node, ast.Import):
                words = [alias.name for alias in node.names]
            for word in words:
                if word in modules:
                    found[modules[word]].add(path.relative_to(root).as_posix())
    return found


def affected_tests(tests: Mapping[str, Collection[str]], changed: Collection[str], root: Path = ROOT) -> set[str]:
    """Return the recorded tests that entered a changed file, or one that stands for it."""
    if not tests:
        return set()
    entered = {name for names in tests.values() for name in names}
    marks, unseen, left = set(changed), set[str](), {name for name in changed if name.endswith(".py")} - entered
    while left:  # constants alone, perhaps of constants alone
        unseen |= left
        beside = set().union(*importers(left, root).values())
        marks |= beside
        left = {name for name in beside if name.endswith(".py")} - entered - unseen
    marks |= {name for name, parts in BEHIND.items() if any(part.startswith(parts) for part in changed)}
    if marks & set(ALWAYS):
        return set(tests)
    return {test for test, names in tests.items() if not marks.isdisjoint(names)}


class Recorder:
    """Names of files that are entered or opened since it was last asked."""

    def __init__(self, names: Iterable[str], root: Path = ROOT) -> None:
        self.names = set(names)
        self.prefix = f"{root}{os.sep}"
        self.entered: set[str] = set()
        self.known: dict[str, str | None] = {}
        self.over = False
        sys.monitoring.use_tool_id(sys.monitoring.PROFILER_ID, "affected")
        events = sys.monitoring.events.PY_START
        sys.monitoring.register_callback(sys.monitoring.PROFILER_ID, events, self._enter)
        sys.monitoring.set_events(sys.monitoring.PROFILER_ID, events)
        sys.addaudithook(self._hear)

    def end(self) -> None:
        """Record no more; what hears of files cannot be removed, and hears nothing."""
        sys.monitoring.set_events(sys.monitoring.PROFILER_ID, 0)
        sys.monitoring.free_tool_id(sys.monitoring.PROFILER_ID)
        self.names.clear()
        self.known.clear()
        self.over = True

    def begin(self) -> set[str]:
        """Begin anew: a function that was entered is told again. Return what was entered before."""
        before, self.entered = self.entered, set()
        sys.monitoring.restart_events()
        return before

    def _enter(self, code: Any, offset: int) -> Any:
        self._add(code.co_filename)
        return sys.monitoring.DISABLE  # until it begins anew

    def _hear(self, event: str, arguments: tuple[Any, ...]) -> None:
        if self.over:
            return
        if event == "open" and isinstance(arguments[0], str):
            self._add(arguments[0])
        elif event in ("subprocess.Popen", "os.posix_spawn", "os.fork"):
            self.entered.add(PROCESS)

    def _add(self, path: str) -> None:
        if path not in self.known:
            full = os.path.abspath(path) if path[:1] != "<" else path
            name = full.removeprefix(self.prefix).replace(os.sep, "/") if full.startswith(self.prefix) else ""
            self.known[path] = name if name in self.names else None
        if (name := self.known[path]) is not None:
            self.entered.add(name)


class Affected:
    """The plugin: chooses tests by the map, records, and writes the map."""

    def __init__(self, config: pytest.Config) -> None:
        self.is_worker = hasattr(config, "workerinput")
        self.digests = digests_of_files()
        self.order = sorted(self.digests)
        self.number = {name: k for k, name in enumerate(self.order)}
        kept = json.loads(MAP.read_text(encoding="utf-8")) if MAP.exists() else {"files": {}, "tests": {}, "failed": []}
        self.tests: dict[str, list[str]] = {}
        self.failed: set[str] = set()
        before: dict[str, str] = kept["files"]
        names = list(before)
        recorded = {test: [names[k] for k in numbers] for test, numbers in kept["tests"].items()}
        changed = {name for name in before.keys() | self.digests.keys() if before.get(name) != self.digests.get(name)}
        gone = affected_tests(recorded, changed) | set(kept["failed"])
        self.kept = {
            test: parts
            for test, parts in recorded.items()
            if test not in gone and test.partition("::")[0] in self.digests
        }
        self.recorder = Recorder(self.order) if self.is_worker or not config.getoption("numprocesses", None) else None

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, config: pytest.Config, items: list[pytest.Item]) -> None:
        """Leave out the tests whose files are as they were."""
        others = [item for item in items if item.nodeid in self.kept]
        if others:
            config.hook.pytest_deselected(items=others)
            items[:] = [item for item in items if item.nodeid not in self.kept]

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef: Any) -> Iterator[None]:
        """Keep what a fixture enters, for all tests that use it."""
        if self.recorder is None:
            return (yield)
        before = self.recorder.begin()
        try:
            return (yield)
        finally:
            fixturedef.entered = set(self.recorder.entered)
            self.recorder.entered |= before

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """Begin anew with each test."""
        if self.recorder is not None:
            self.recorder.begin()
        return (yield)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(self, item: Any, call: Any) -> Iterator[None]:
        """Tell with the report of a test's end what it entered."""
        report = yield
        if self.recorder is not None and call.when == "teardown":
            found = self.recorder.entered | {item.path.relative_to(ROOT).as_posix(), *ALWAYS}
            for definitions in item._fixtureinfo.name2fixturedefs.values():
                found |= set().union(*(getattr(fixture, "entered", ()) for fixture in definitions))
            for value in vars(getattr(item, "module", item)).values():  # what the test imports by name
                module = sys.modules.get(str(getattr(value, "__module__", "")))
                name = (getattr(module, "__file__", None) or "").removeprefix(f"{ROOT}{os.sep}").replace(os.sep, "/")
                found |= {name} & self.digests.keys()
            report.user_properties.append((RECORD, sorted(self.number[name] for name in found)))
        return report

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Take over the record of a test; one that fails runs again."""
        if report.failed:
            self.failed.add(report.nodeid)
        if not self.is_worker and (record := dict(report.user_properties).get(RECORD)) is not None:
            self.tests[report.nodeid] = [self.order[k] for k in record]

    def pytest_sessionfinish(self) -> None:
        """Write the map: of tests that were left out, and of those that ran."""
        if self.recorder is not None:
            self.recorder.end()
        if self.is_worker:
            return
        tests = self.kept | self.tests
        numbers = {
            test: sorted(self.number[name] for name in names if name in self.number) for test, names in tests.items()
        }
        MAP.parent.mkdir(exist_ok=True)
        content = {
            "files": {name: self.digests[name] for name in self.order},
            "tests": numbers,
            "failed": sorted(self.failed),
        }
        beside = MAP.with_suffix(".part")
        beside.write_text(json.dumps(content, separators=(",", ":")), encoding="utf-8")
        beside.replace(MAP)


def pytest_configure(config: pytest.Config) -> None:
    """Take part in a session."""
    if sys.version_info < (3, 12):
        raise pytest.UsageError("make affected records what tests enter as Python 3.12 and newer tell it")
    config.pluginmanager.register(Affected(config), "affected")
