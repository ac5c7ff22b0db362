"""The search for events as compiled code."""

import numpy as np
import pytest

from symgen.compile.loopcode.exact import plain_form
from symgen.run.layout import abi
from symgen.run.loops import event_loop, frame_parts, inner_points, inside, search_records, searching, switching


def test_the_search_is_in_the_language_of_emitted_code():
    """`read` raises where a function, or one that it calls, is outside."""
    function = searching.decide.read(abi.DECIDE.signature.arguments)
    called = {f.name: f for f in function.called}
    assert called.keys() >= {"look", "keep", "give_back", "take_values", "candidate", "settle_bracket", "concealed"}
    hidden = {f.name: f for f in called["concealed"].called}["hidden"]
    between = {f.name: f for f in hidden.called}["dip_between"]
    assert "dip" in {f.name for f in between.called}


def test_the_first_root_of_a_cubic_is_numpys():
    """Against the roots of the polynomial with these values and slopes at both ends."""
    rng, met = np.random.default_rng(1), 0
    for _ in range(300):
        g0, d0, g1, d1 = 1.0, 6.0 * rng.standard_normal(), -rng.uniform(0.1, 2.0), 6.0 * rng.standard_normal()
        rise = g1 - g0
        roots = np.roots([d0 + d1 - 2.0 * rise, 3.0 * rise - 2.0 * d0 - d1, d0, g0])
        inside = sorted(r.real for r in roots if abs(r.imag) < 1e-9 and 0.0 < r.real < 1.0)
        gaps = np.diff(inside)
        if gaps.size and gaps.min() < 1e-3:
            continue  # a double root, which rounding has or has not
        met += 1
        # roots of a polynomial with coefficients near 10 and gaps above 1e-3: rounding over its slope there
        assert switching.first_root(g0, d0, g1, d1, 1.0) == pytest.approx(inside[0], abs=1e-9)
    assert met > 250


def hunted(*functions):
    """What is kept of events whose values and rates are given, with a state of one number that is their time."""
    n, width = len(functions), 8
    notes = event_loop.notes_at(n, width, 1)
    hunt = np.zeros(notes + (search_records.NOTES + 2 * n) * (2 + width))
    hunt[search_records.COUNT] = n
    w, iw, y = np.zeros(1), np.zeros(abi.N_COUNTERS, dtype=np.int64), np.zeros(width)
    out = search_records.N_HEAD + search_records.N_COLUMNS * n

    def told(t, h, doing):
        hunt[out : out + 2 * n] = np.ravel(np.array([function(t) for function in functions]).T)
        return plain_form(searching.decide)(hunt, n, notes, t, h, doing, width, y, w, iw)

    return hunt, told


def test_a_reset_that_leaves_g_beside_zero_by_rounding_is_no_event_until_g_has_come_away():
    """Behind a reset g is -1e-16, on its way up: steps so short that it stays there are not events of their own."""
    beside = 1e-16
    hunt, told = hunted(lambda t: (t - beside, 1.0))
    at = search_records.N_HEAD
    columns = hunt[at : at + search_records.N_COLUMNS]
    columns[search_records.DIRECTION], columns[search_records.ACTION] = -1.0, 1.0
    # the event has just happened: the run came from above, and g stands beside zero
    columns[search_records.SIDE], columns[search_records.FIRED], columns[search_records.SIZE] = -1.0, 1.0, 1.0
    columns[search_records.G_START], columns[search_records.D_START] = -beside, -1.0
    told(0.0, 0.0, searching.LOOK)
    assert columns[search_records.SIDE] == columns[search_records.GRAZING] == 1.0
    t = 0.0
    for h in (1e-17, 2e-17, 1e-17):
        t += h
        assert told(t, h, frame_parts.NOTHING) == frame_parts.NOTHING
    assert told(1.0, 1.0 - t, frame_parts.NOTHING) == frame_parts.NOTHING
    assert columns[search_records.GRAZING] == 0.0 and columns[search_records.SIDE] == 1.0
    assert told(2.0, 1.0, frame_parts.NOTHING) == frame_parts.NOTHING


@pytest.mark.slow
def test_a_step_away_from_zero_is_one_in_which_the_search_finds_nothing():
    """Whatever values and rates both ends have: where one pass is enough, the search gives the same sides and ends."""
    rng, quiet, heads = np.random.default_rng(3), 0, search_records.N_HEAD
    kept = ("SIDE", "FIRED", "GRAZING", "SIZE", "G_START", "D_START")
    columns = [getattr(search_records, name) for name in kept]
    for _ in range(6000):
        ends = [
            [tuple(rng.choice([-1.0, -0.1, 0.0, 0.1, 1.0, np.nan], 2, p=[0.23] * 4 + [0.04] * 2)) for _ in range(2)]
            for _ in range(2)
        ]
        hunt, told = hunted(*(lambda t, at=at: at[int(t > 0.0)] for at in ends))
        direction = heads + search_records.DIRECTION * 2
        hunt[direction : direction + 2] = rng.integers(-1, 2, 2)
        told(0.0, 0.0, frame_parts.LOOK)
        once = hunt.copy()
        steepest = heads + search_records.STEEPEST * 2
        once[steepest : steepest + 2] = rng.choice([0.0, 0.1, 1.0], 2)
        doing = told(0.3, 0.3, frame_parts.NOTHING)
        values = heads + search_records.N_COLUMNS * 2
        once[values : values + 4] = hunt[values : values + 4]
        if plain_form(inside.stays_away)(once, 2, 0.3) == 1:
            quiet += 1
            assert doing == frame_parts.NOTHING and once[search_records.NOTED] == hunt[search_records.NOTED] == 0.0
            both = (h[heads:values].reshape(-1, 2)[columns] for h in (once, hunt))
            np.testing.assert_array_equal(*both)
    assert 100 < quiet < 3000


def test_a_root_of_a_cubic_takes_one_shorter_step_besides_the_last_one():
    """Where a step ends on its root up to the resolution of time, no step before the root is tried."""
    rng, heads = np.random.default_rng(5), search_records.N_HEAD
    attempts = list[int]()
    for _ in range(200):
        roots = np.array([rng.uniform(0.01, 0.09), -rng.uniform(0.5, 2.0), rng.uniform(0.5, 2.0)])
        slope = np.polynomial.Polynomial.fromroots(roots).deriv()
        # the product has the small rounding near its roots that g of a motion has
        hunt, told = hunted(lambda t, roots=roots, slope=slope: (float(np.prod(t - roots)), float(slope(t))))
        hunt[heads + search_records.ACTION] = search_records.LEAVE
        told(0.0, 0.0, searching.LOOK)
        tried, code, h = 1, told(0.1, 0.1, frame_parts.NOTHING), 0.1
        while code in (frame_parts.SEEK, frame_parts.TAKE):
            h, tried = float(hunt[frame_parts.TRY]), tried + 1
            code = told(h, h, code)
        assert code == frame_parts.MEET
        assert abs(h - roots[0]) < 1e-15
        attempts.append(tried)
    assert min(attempts) == 3 and np.mean(np.array(attempts) == 3) > 0.5


def test_slopes_of_forces_at_inner_points_are_those_of_the_polynomial_through_them():
    """A force of degree 5 over a step with seven inner points: its slopes, with their signs, at all nine points."""
    hunt, _ = hunted(lambda t: (t, 1.0))
    force = np.polynomial.Polynomial([3.0, -10.0, 4.0, 0.5, -2.0, 1.5])
    step, inner = 0.3, search_records.N_INSIDE
    times = step * np.sort(np.random.default_rng(2).uniform(0.05, 0.95, inner))
    places = search_records.PLACES
    hunt[search_records.WHOLE], hunt[search_records.INSIDE] = step, inner
    hunt[places : places + inner] = times
    at = search_records.N_HEAD
    hunt[at + search_records.OF_FORCES] = 1.0
    hunt[at + search_records.G_START], hunt[at + search_records.G_END] = force(0.0), force(step)
    hunt[at + search_records.G_INSIDE : at + search_records.G_INSIDE + inner] = force(times)
    inner_points.slopes_of_forces(hunt, 1)
    slopes = [hunt[at + search_records.D_START], *hunt[at + search_records.D_INSIDE :][:inner]]
    slopes.append(hunt[at + search_records.D_END])
    np.testing.assert_allclose(slopes, force.deriv()(np.array([0.0, *times, step])), rtol=1e-8)
