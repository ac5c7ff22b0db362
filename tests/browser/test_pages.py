"""Pages in a real browser, from their files and without a network; ``make browser`` runs these."""

import json
import math
import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from support.emitted import mechanism_of
from support.in_coordinates import in_coordinates
from support.random_closed import make

from symgen.api import Model, load
from symgen.compile.native.javascript_code import HELPERS
from symgen.describe import catalogue
from symgen.describe.files.builder import MechanismBuilder
from symgen.result.player.live import live_part
from symgen.result.player.motion_page import motion_page
from symgen.result.player.recording import Recording
from tests.browser.chromium import WITHOUT_WEBGL, Chromium
from tests.browser.uncontracted import Uncontracted, prepared

pytestmark = pytest.mark.browser

NAMES = [e.name for e in (*catalogue.entries(), *catalogue.entries(catalogue.MACHINES))]
#: Where pictures and figures of a run of these tests are kept; nowhere unless it is set.
KEPT = os.environ.get("SYMGEN_BROWSER_PICTURES")


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    return {}


def page_of(name: str, pages: dict[str, Path], folder: Path, **changes: object) -> Path:
    if name not in pages:
        model = load(name)
        until = min(10.0, model.mechanism.defaults.until)
        made = model.simulate(until=until, **changes).view()  # type: ignore[arg-type]
        pages[name] = made.save(folder / f"{name}.html")
    return pages[name]


def note(what: str, figures: object) -> None:
    if KEPT:
        with (Path(KEPT) / "figures.jsonl").open("a") as file:
            file.write(json.dumps([what, figures]) + "\n")


@pytest.mark.by_turns(3)
@pytest.mark.fast("four-bar", "spatial-slider-crank")
@pytest.mark.parametrize("name", NAMES)
def test_pages_of_the_catalogue(
    name: str, chromium: Chromium, pages: dict[str, Path], tmp_path_factory: pytest.TempPathFactory
) -> None:
    """Nothing is said on the console, nothing asked of a network, something is drawn, at both widths."""
    path = page_of(name, pages, tmp_path_factory.mktemp("pages"))
    spatial = load(name).mechanism.space == "spatial"
    size = len(path.read_bytes())
    assert size <= (1_600_000 if spatial else 900_000)
    for width, height in ((1280, 800), (390, 800)):
        chromium.open(path, width, height)
        for box in ("forces", "gaps", "labels"):
            chromium.run(f"document.getElementById('{box}').click()")
        chromium.run("document.getElementById('play').click()")
        chromium.frame()
        chromium.run("document.getElementById('play').click()")
        assert chromium.said == []
        assert chromium.run("document.documentElement.scrollWidth <= window.innerWidth")
        if KEPT:
            chromium.picture(Path(KEPT) / f"{name}-{width}.png")
        assert chromium.run("!document.getElementById('solid').hidden") == spatial
        assert colours(chromium) > 5
    pace = chromium.run("window.symgen.live ? window.symgen.pace() : null")
    drawn = sorted(chromium.run(f"window.symgen.frame({k / 20})") for k in range(20))
    note(name, {"bytes": size, "pace": pace, "frame": [drawn[10], drawn[18]]})


def colours(chromium: Chromium) -> int:
    """Return how many colours the picture has, of both canvases, in the task that draws a frame."""
    counted = """(() => {
      window.symgen.frame(0.5);
      const c = document.createElement('canvas'), parts = ['solid', 'view'].map((id) => document.getElementById(id));
      Object.assign(c, { width: parts[1].width, height: parts[1].height });
      const context = c.getContext('2d');
      for (const part of parts) if (!part.hidden) context.drawImage(part, 0, 0);
      const d = context.getImageData(0, 0, c.width, c.height).data, s = new Set();
      for (let i = 0; i < d.length; i += 4) s.add(d[i] * 65536 + d[i + 1] * 256 + d[i + 2]);
      return s.size;
    })()"""
    return int(chromium.run(counted))


def test_without_webgl_a_canvas_draws_what_is_in_space(
    chromium: Chromium, pages: dict[str, Path], tmp_path: Path
) -> None:
    path = page_of("flyball-governor", pages, tmp_path)
    chromium.open(path, scripts=(WITHOUT_WEBGL,))
    chromium.frame()
    assert chromium.run("document.getElementById('solid').hidden")
    assert colours(chromium) > 5
    assert chromium.said == []


@pytest.mark.parametrize(
    ("along", "apart", "looks"),
    [
        # from where y is negative, and from behind
        ((0.0, 0.0, 1.0), (0.0, -0.3, 0.0), ((0.5 * math.pi, 0.0), (-0.5 * math.pi, 0.0))),
        # from above, and from below
        ((0.0, 1.0, 0.0), (0.0, 0.0, 0.3), ((0.2, 1.57), (0.2, -1.57))),
    ],
)
def test_near_bars_hide_far_ones_from_either_side(
    along: tuple[float, ...],
    apart: tuple[float, ...],
    looks: tuple[tuple[float, float], ...],
    chromium: Chromium,
    tmp_path: Path,
) -> None:
    """Two bars that cross, seen from either side: the colour in the middle is that of the nearer one."""
    crossed = MechanismBuilder("crossed", space="spatial", gravity=(0.0, 0.0, 0.0))
    for name, reach in (("a", (1.0, 0.0, 0.0)), ("b", along)):
        ends = {"p": tuple(-x for x in reach), "q": reach}
        crossed.body(name, mass=1.0, inertia=(0.1, 0.1, 0.1), points=ends)
        crossed.joint(f"of_{name}", "spherical", between=("ground", name), at=(ends["p"], "p"))
    aside, upright = np.array([0.3, 0.0, 0.0]), [1.0, 0.0, 0.0, 0.0]
    q = np.array([[*(aside + apart), *upright, *(0.4 * np.array(along) - apart), *upright]])
    path = tmp_path / "crossed.html"
    motion_page(Recording(crossed.build(), {}, np.zeros(1), q)).save(path)
    chromium.open(path)
    middle = """(() => {
      window.symgen.look(%r, %r, [0, 0, 0]);
      window.symgen.frame(0);
      const solid = document.getElementById('solid'), c = document.createElement('canvas');
      Object.assign(c, { width: solid.width, height: solid.height });
      const context = c.getContext('2d');
      context.drawImage(solid, 0, 0);
      return [...context.getImageData(c.width >> 1, c.height >> 1, 1, 1).data];
    })()"""
    red, _, blue, _ = chromium.run(middle % looks[0])
    assert blue > red + 50  # the first body
    red, _, blue, _ = chromium.run(middle % looks[1])
    assert red > blue + 50  # the second one, in orange


def test_sines_of_a_page_are_within_half_a_last_bit(chromium: Chromium) -> None:
    """Against 40 digits: what rounding leaves, and a hundredth for what the series and its sums leave out."""
    import mpmath

    random = np.random.default_rng(3)
    angles = [*random.uniform(-0.8, 0.8, 1000), *random.uniform(-7.0, 7.0, 1000), *random.uniform(-9e4, 9e4, 1000)]
    found = chromium.run(f"(() => {{ {HELPERS} return {json.dumps(angles)}.map((x) => [sine(x), cosine(x)]); }})()")
    with mpmath.workdps(40):
        for angle, pair in zip(angles, found, strict=True):
            for value, exact in zip(pair, (mpmath.sin(angle), mpmath.cos(angle)), strict=True):
                assert abs(mpmath.mpf(value) - exact) <= 0.51 * math.ulp(float(exact))
    assert chromium.run(
        f"(() => {{ {HELPERS} return [Object.is(sine(-0), -0), sine(1e300) === Math.sin(1e300)]; }})()"
    ) == [True, True]


@pytest.fixture(scope="module")
def uncontracted() -> Iterator[Uncontracted]:
    with Uncontracted() as process:
        yield process


@pytest.mark.by_turns(4)
@pytest.mark.fast("four-bar-absolute", "spatial-slider-crank-joint")
@pytest.mark.parametrize(("name", "coordinates"), in_coordinates(NAMES))
def test_rates_are_those_of_the_compiled_code(
    name: str, coordinates: str, chromium: Chromium, uncontracted: Uncontracted, tmp_path: Path
) -> None:
    """On 1000 random states with pivots above 1e-2, by the largest entry of each vector: 1e-12.

    That of machine code which fuses nothing; where sines of the C library and of the page differ in the last bit, that
    may change rates by as much as the last bit of every coordinate does. Machine code for this processor fuses
    multiplication and addition: four times of what that alone changes is allowed beside it.
    """
    mechanism = load(name).mechanism
    compiled, start, q = prepared(name, coordinates)
    live, why = live_part(mechanism, compiled, start, 1e-3)
    if live is None:
        assert "operations are more than" in why
        return
    recording = Recording(mechanism, load(name).parameters(), np.zeros(1), q[None, :])
    path = tmp_path / "page.html"
    motion_page(recording, live, why).save(path)
    random, info = np.random.default_rng(7), compiled.info
    states, fused, w = [], [], start.w.copy()
    pivots = range(info.sections["pivot"][0], info.sections["pivot"][0] + info.m)
    tried = 0
    while len(states) < 1000 and tried < 20000:
        tried += 1
        y = start.y.copy()
        y[: info.nq] += 0.2 * random.standard_normal(info.nq)
        y[info.nq : info.work] += random.standard_normal(info.nv)
        w[:] = start.w
        ydot, iw = np.zeros(info.ny), np.zeros(16, dtype=np.int64)
        compiled.model.geometry(0.1, y, start.p, w)
        kept = [w[i] for i in pivots if abs(w[i]) > 1e-12]  # of rows that are left out, rounding or 0
        if min(kept, default=1.0) < 1e-2:
            continue
        w[:] = start.w
        if compiled.law_module.rhs(0.1, y, start.p, w, iw, ydot) == 0 and np.all(np.isfinite(ydot)):
            states.append(y)
            fused.append(ydot)
    assert len(states) > 100
    expected, nearby = uncontracted.rates(name, coordinates, np.array(states), tmp_path)
    chromium.open(path)
    asked = json.dumps([y.tolist() for y in states])
    found = np.array(chromium.run(f"{asked}.map((y) => window.symgen.rates(0.1, y))"), dtype=np.float64)
    largest = np.abs(expected).max(axis=1, keepdims=True)
    worst = {
        what: float(np.max(np.abs(a - b) / largest))
        for what, a, b in (
            ("uncontracted", found, expected),
            ("contracted", found, fused),
            ("of contraction", expected, fused),
            ("of a last bit", expected, nearby),
        )
    }
    same = float(np.mean(np.all(found == expected, axis=1)))
    note(f"rates {name} {coordinates}", {"states": len(states), "the same bits": same, **worst})
    assert worst["uncontracted"] <= max(1e-12, worst["of a last bit"])
    assert worst["contracted"] <= max(1e-12, 4.0 * worst["of contraction"])


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("pendulum", {"bob_mass": 3.0, "length": 1.3}),
        ("slider-crank", None),
        ("wiper", None),
        ("spatial-slider-crank", None),
        ("heavy-top", None),
    ],
)
def test_a_slider_does_what_set_does(
    name: str, values: dict[str, float] | None, chromium: Chromium, tmp_path: Path
) -> None:
    """The page's state at the end of 1 s with changed parameters, and that of a run by the same steps."""
    model = load(name)
    known = model.parameters()
    if values is None or not set(values) <= set(known):
        values = {p: 1.1 * x for p, x in list(known.items())[:2]}
    step = model.mechanism.defaults.step
    until = round(min(1.0, model.mechanism.defaults.until) / step) * step
    kind: dict[str, object] = {"integrator": "rk4", "step": step, "until": until, "times": (0.0, until)}
    path = model.simulate(**kind).view().save(tmp_path / "page.html")  # type: ignore[arg-type]
    result = model.simulate(parameters=values, **kind)  # type: ignore[arg-type]
    chromium.open(path)
    found = np.array(chromium.run(f"window.symgen.run({json.dumps(values)}, {until!r}, {step!r})"))
    expected = np.concatenate([result.q.values[-1], result.v.values[-1]])
    scale = np.abs(expected).max()
    worst = np.max(np.abs(found[: len(expected)] - expected)) / scale
    note(f"slider {name}", {"values": values, "worst": worst})
    # rounding of both grows with the motion: a thousand steps of a regular motion keep nine digits
    assert worst <= 1e-9


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_page_begins_with_what_its_run_had(coordinates: str, chromium: Chromium, tmp_path: Path) -> None:
    """A number in place of a formula, and another start: the page's own motion is the run's."""
    kind: dict[str, object] = {"integrator": "rk4", "step": 1e-5, "until": 1e-4, "coordinates": coordinates}
    changed: dict[str, dict[str, float]] = {"parameters": {"throw": 0.03}, "start": {"crank.theta": 1.0}}
    result = load("engine").simulate(**changed, **kind)  # type: ignore[arg-type]  # of settings
    chromium.open(result.view().save(tmp_path / "page.html"))
    found = np.array(chromium.run("window.symgen.run({}, 1e-4, 1e-5)"))
    names = chromium.run("window.symgen.state")
    expected = {n: x for table in (result.q, result.v) for n, x in zip(table.names, table.values[-1], strict=True)}
    compared = [(i, expected[n]) for i, n in enumerate(names) if n in expected]
    assert compared and [found[i] for i, _ in compared] == pytest.approx([x for _, x in compared], rel=1e-9, abs=1e-9)


def test_sliders_and_keys_of_a_page(chromium: Chromium, pages: dict[str, Path], tmp_path: Path) -> None:
    path = page_of("slider-crank", pages, tmp_path)
    chromium.open(path)
    clock = "document.getElementById('clock').textContent"
    before = chromium.run(clock)
    chromium.run("window.dispatchEvent(new KeyboardEvent('keydown', {key: 'End'}))")
    chromium.frame()
    assert chromium.run(clock) != before
    slide = (
        "(() => { const i = document.querySelectorAll('#live input')[0]; i.value = 300; "
        "i.dispatchEvent(new Event('input')); })()"
    )
    chromium.run(slide)
    for _ in range(200):
        chromium.frame()
        if not chromium.run(clock).startswith("0.000"):
            break
    assert not chromium.run(clock).startswith("0.000")
    chromium.run("document.querySelector('#live button').click()")
    chromium.frame()
    assert chromium.said == []


def test_a_page_in_a_frame_that_was_hidden_is_drawn_when_it_is_seen(
    chromium: Chromium, pages: dict[str, Path], tmp_path: Path
) -> None:
    inner = page_of("four-bar", pages, tmp_path)
    outer = tmp_path / "outer.html"
    outer.write_text(f'<iframe src="{inner.as_uri()}" style="display: none; width: 900px; height: 700px"></iframe>')
    chromium.call("Emulation.setDeviceMetricsOverride", width=1000, height=800, deviceScaleFactor=1, mobile=False)
    chromium.said = []
    chromium.call("Page.navigate", url=outer.as_uri())
    frame = "document.querySelector('iframe')"
    for _ in range(200):
        if chromium.run(f"Boolean({frame} && document.readyState === 'complete')"):
            break
        chromium.frame()
    chromium.frame()
    before = Image.open(chromium.picture(tmp_path / "before.png")).convert("RGB")
    chromium.run(f"{frame}.style.display = 'block'; 0")
    for _ in range(20):
        chromium.frame()
    after = Image.open(chromium.picture(tmp_path / "after.png")).convert("RGB")
    assert len(before.getcolors(10**6) or []) < 5 and len(after.getcolors(10**6) or []) > 200
    assert [line for line in chromium.said if str(inner.name) not in line] == []


def test_dragging_moves_a_picture_in_the_plane(chromium: Chromium, pages: dict[str, Path], tmp_path: Path) -> None:
    """By as much as the pointer goes: what was drawn there before is drawn so many pixels further."""
    lines = """(() => { const of = CanvasRenderingContext2D.prototype, { moveTo } = of, found = [];
      of.moveTo = function (x, y) {
        if (this.canvas.id === 'view') found.push([x, y]);
        return moveTo.call(this, x, y);
      };
      window.symgen.frame(0); of.moveTo = moveTo; return found; })()"""
    drag = """(() => { const view = document.getElementById('view');
      view.setPointerCapture = () => {};
      for (const [kind, x, y] of [['pointerdown', 100, 100], ['pointermove', 130, 80], ['pointerup', 130, 80]])
        view.dispatchEvent(new PointerEvent(kind, { pointerId: 1, clientX: x, clientY: y })); })()"""
    chromium.open(page_of("slider-crank", pages, tmp_path))
    before = np.array(chromium.run(lines))
    chromium.run(drag)
    np.testing.assert_allclose(
        np.array(chromium.run(lines)) - before, np.tile([30.0, -20.0], (len(before), 1)), atol=1e-6
    )
    assert len(before) > 0 and chromium.said == []


def busy(chromium: Chromium) -> float:
    """Return how long the page's thread was at work so far [ms]."""
    measured = chromium.call("Performance.getMetrics")["metrics"]
    return 1e3 * next(float(x["value"]) for x in measured if x["name"] == "TaskDuration")


#: How often each of ten frames calls the canvas: whatever moves a pen, strokes or fills.
CALLS_OF_FRAMES = """(() => {
  const of = CanvasRenderingContext2D.prototype, kept = {}, found = [];
  let calls = 0;
  for (const name of ['moveTo', 'lineTo', 'arc', 'stroke', 'fill', 'fillText', 'fillRect']) {
    kept[name] = of[name];
    of[name] = function (...given) { calls += 1; return kept[name].apply(this, given); };
  }
  for (let k = 0; k < 10; k++) { calls = 0; window.symgen.frame(k / 10); found.push(calls); }
  Object.assign(of, kept);
  return found; })()"""


def test_frames_with_200_bodies(chromium: Chromium, tmp_path: Path) -> None:
    """A frame draws a few lines a body, every frame as many; the time of the page's thread is noted.

    Strokes are counted because they are the same on every machine. The time is the thread's, each frame in a task of
    its own: many frames in one task would count what the browser paints as soon as too many strokes wait for it.
    """
    chain = MechanismBuilder("long", gravity=(0.0, -9.81))
    for i in range(200):
        chain.body(f"b{i}", mass=1.0, inertia=0.1, points={"a": (-0.5, 0.0), "b": (0.5, 0.0)}, position=(i + 0.5, 0.0))
        before = ("ground", f"b{i}") if i == 0 else (f"b{i - 1}", f"b{i}")
        chain.joint(f"j{i}", "revolute", between=before, at=((0.0, 0.0), "a") if i == 0 else ("b", "a"))
    mechanism = chain.build()
    t = np.linspace(0.0, 10.0, 200)
    q = np.zeros((200, 600))
    for k, time in enumerate(t):
        angle, x, y = 0.0, 0.0, 0.0
        for i in range(200):
            angle = 0.3 * math.sin(time + 0.1 * i)
            q[k, 3 * i : 3 * i + 3] = x + 0.5 * math.cos(angle), y + 0.5 * math.sin(angle), angle
            x, y = x + math.cos(angle), y + math.sin(angle)
    path = tmp_path / "long.html"
    motion_page(Recording(mechanism, {}, t, q)).save(path)
    chromium.open(path)
    chromium.call("Performance.enable", timeDomain="threadTicks")
    found = []
    for k in range(80):  # what is drawn is painted without a graphics card, and the page waits for that now and then
        before = busy(chromium)
        chromium.run(f"window.symgen.frame({k % 40 / 40})")
        found.append(busy(chromium) - before)
    chromium.call("Performance.disable")
    warm = np.array(found[20:])
    counted = np.array(chromium.run(CALLS_OF_FRAMES))
    note(
        "200 bodies",
        {
            "median": float(np.median(warm)),
            "95 %": float(np.quantile(warm, 0.95)),
            "calls": int(counted[0]),
            "bytes": path.stat().st_size,
        },
    )
    assert 200 < counted[0] <= 40 * 200 and np.ptp(counted) <= 0.1 * counted[0]
    if KEPT:
        chromium.picture(Path(KEPT) / "long.png")


def test_names_of_a_file_stay_text(chromium: Chromium, tmp_path: Path) -> None:
    """A title and a note that would be scripts, and a script's end inside the data."""
    title = "</script><script>window.canary = 1</script><img src=x onerror='window.canary = 2'>"
    builder = MechanismBuilder("arm", title=title).parameter("m", 1.0, note=title)
    model = Model(builder.body("a", type="point", mass="m").build())
    path = model.simulate(integrator="rk4", until=0.1, step=0.01).view().save(tmp_path / "page.html")
    chromium.open(path)
    assert chromium.run("typeof window.canary") == "undefined"
    assert chromium.run("document.querySelector('h1').textContent") == title
    assert chromium.said == []


@pytest.mark.parametrize("seed", range(6))
def test_random_mechanisms_in_space(seed: int, chromium: Chromium, tmp_path: Path) -> None:
    result = Model(mechanism_of(make(seed, "spatial"))).simulate(integrator="rk4", until=0.5, step=1e-3)
    path = result.view().save(tmp_path / "page.html")
    assert len(path.read_bytes()) <= 680_000
    for width in (1280, 390):
        chromium.open(path, width)
        chromium.run("document.getElementById('play').click()")
        chromium.frame()
        assert chromium.said == []
    if KEPT and seed < 4:
        chromium.picture(Path(KEPT) / f"random-{seed}.png")
