"""From where mechanisms in space are seen, and symbols that are as long as what they show."""

import numpy as np
import pytest
from matplotlib.path import Path as Outline

from symgen.api import Model, load
from symgen.describe.drawing import Drawing, build_scene
from symgen.describe.drawing.paper import Circle, items_on_paper, view_axes
from symgen.describe.drawing.paper import Path as Stroke
from symgen.describe.drawing.scene import Line
from symgen.describe.drawing.viewpoint import USUAL
from symgen.describe.files.builder import MechanismBuilder

Part = Stroke | Circle


def seen(view: object, scene: object, line: np.ndarray) -> np.ndarray:
    """Return points of the ground frame as the eye has them, flat."""
    return np.asarray(line @ view_axes(scene, view)[:2].T)  # type: ignore[arg-type]


def across(a: np.ndarray, b: np.ndarray) -> float:
    """Return the angle between two lines on paper, at most 90 [deg]."""
    (ux, uy), (vx, vy) = (line[-1] - line[0] for line in (a, b))
    return float(np.degrees(np.arctan2(abs(ux * vy - uy * vx), abs(ux * vx + uy * vy))))


def test_a_rod_behind_another_one_is_seen() -> None:
    """Two bars that lie behind each other along the usual view: the drawing looks from elsewhere."""
    direction = view_axes(load("heavy-top").draw().scene, USUAL)[2]
    both = MechanismBuilder("both", space="spatial", gravity=(0.0, 0.0, -9.81))
    for name, at in (("near", 0.4 * direction), ("far", -0.4 * direction)):
        ends = {"p": (0.0, 0.0, -0.5), "q": (0.0, 0.0, 0.5)}
        both.body(name, mass=1.0, inertia=(0.1, 0.1, 0.1), points=ends, position=tuple(at))
        both.joint(f"of_{name}", "spherical", between=("ground", name), at=(tuple(at + np.array([0.0, 0.0, 0.5])), "q"))
    drawing = Model(both.build()).draw()

    def apart(view: object) -> float:
        near, far = (seen(view, drawing.scene, np.array([at])) for at in (0.4 * direction, -0.4 * direction))
        return float(abs((near - far)[0, 0]))  # the bars are upright on paper

    assert apart(USUAL) < 1e-9 and apart(drawing.view) > 2.0 * drawing.scene.unit


def test_the_crank_of_a_slider_crank_in_space_is_no_part_of_its_rod() -> None:
    model = load("spatial-slider-crank")
    drawing = model.draw()
    poses = drawing.scene.poses(drawing.q)
    ends = ((0, (0.0, 0.0, 0.04)), (1, (0.15, 0.0, 0.0)))  # a point of each, from its centre of mass
    lines = [poses.to_ground(k, [(0.0, 0.0, 0.0), end]) for k, end in ends]
    usual, own = (across(*(seen(view, drawing.scene, x) for x in lines)) for view in (USUAL, drawing.view))
    assert own > 15.0 and usual < 8.0


@pytest.mark.slow_cases("chain")
@pytest.mark.parametrize("name", ["chain", "heavy-top", "bicycle", "rolling-disc"])
def test_the_usual_view_stays_where_it_hides_nothing(name: str) -> None:
    assert load(name).draw().view == USUAL


def least_visible(drawing: Drawing) -> float:
    """Return the least visible share of a body's outline, on a grid; what is in front counts with its opacity."""
    drawn = [
        each for each in items_on_paper(drawing.scene, np.array(drawing.q), drawing.view) if each.item.role == "body"
    ]

    def covered(part: Part, grid: np.ndarray) -> np.ndarray:
        if isinstance(part, Circle):
            return np.asarray(np.hypot(*(grid - [part.x, part.y]).T) <= part.radius)
        filled = part.closed and part.look.fill
        return np.asarray(Outline(part.points).contains_points(grid) if filled else np.zeros(len(grid), dtype=bool))

    least = 1.0
    for k, body in enumerate(drawn):
        corners = np.concatenate([p.points for p in body.parts if not isinstance(p, Circle)])
        axes_of_grid = [np.linspace(low, high, 120) for low, high in zip(corners.min(0), corners.max(0), strict=True)]
        grid = np.stack(np.meshgrid(*axes_of_grid), axis=-1).reshape(-1, 2)
        grid = grid[np.any([covered(part, grid) for part in body.parts], axis=0)]
        clear = np.ones(len(grid))
        for part in (part for each in drawn[k + 1 :] for part in each.parts):
            clear[covered(part, grid)] *= 1.0 - part.look.opacity
        least = min(least, float(clear.mean()))
    return least


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("front-suspension", "stewart-platform", "bricard", "flyball-governor")
@pytest.mark.parametrize("name", ["stewart-platform", "flyball-governor", "front-suspension", "bricard"])
def test_no_body_is_mostly_hidden(name: str) -> None:
    """Legs of a platform cross in every view; each is still recognised."""
    assert least_visible(load(name).draw()) > 0.75


@pytest.mark.slow
def test_a_body_inside_another_one_is_drawn_after_it() -> None:
    drawing = load("flyball-governor").draw()
    order = [each.item.name for each in items_on_paper(drawing.scene, np.array(drawing.q), drawing.view)]
    assert order.index("shaft") < order.index("slider") < order.index("sleeve")


@pytest.mark.slow
def test_the_scissor_lift_has_a_platform_and_a_cylinder() -> None:
    """The platform is as wide as the lift; barrel and rod fit between foot and head when the cylinder is shortest."""
    model = load("scissor-lift")
    result = model.simulate(until=9.0, output_step=0.5)
    values = model.parameters()
    scene = build_scene(model.mechanism, result.q.values, values)
    items = {(item.role, item.name): item for item in scene.items}
    frames = {frame.name: k for k, frame in enumerate(scene.frames)}
    plate = items["body", "platform"].marks[0]
    assert isinstance(plate, Line) and np.ptp(np.array(plate.points)[:, 0]) > values["width"]
    parts = [m for m in items["joint", "cylinder"].marks if isinstance(m, Line)]
    assert {m.body for m in parts} == {frames["barrel"], frames["rod"]}
    for mark in parts:
        along = np.array(mark.points)[:, 0] + (0.3 if mark.body == frames["barrel"] else -0.3)  # from eye or clevis
        assert np.ptp(along) <= values["retracted"]
        reach = along if mark.body == frames["barrel"] else -along
        assert reach.min() >= -1e-9 and reach.max() <= values["retracted"]
    # and the rod's inner end is inside the barrel when it is longest
    rod = min(np.array(m.points)[:, 0].min() - 0.3 for m in parts if m.body == frames["rod"])
    barrel = max(np.array(m.points)[:, 0].max() + 0.3 for m in parts if m.body == frames["barrel"])
    assert values["retracted"] + values["stroke"] + rod < barrel
