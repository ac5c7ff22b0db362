"""Environments of Gymnasium: against runs, each row against an environment of its own, and what is refused."""

import re
import warnings
from typing import Any

import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import symgen
from symgen import gym
from symgen.base.errors import InputError

OFF = dict.fromkeys(("gain_x", "gain_vx", "gain_lean", "gain_rate"), 0.0)
TASK: dict[str, Any] = {
    "model": "cart-pole",
    "observe": ["cart.x", "cart.vx", "sin(pole.theta)", "pole.tip.ax", "pole.omega"],
    "act": {"force": (-20.0, 20.0)},
    "reward": "cos(pole.theta) - 1e-3*force**2",
    "reset": {"pole.theta": (-0.2, 0.2)},
    "parameters": OFF,
}


def test_an_episode_is_a_run_with_the_actions_as_data() -> None:
    env = gym.make(**{**TASK, "reset": {"pole.theta": 0.1}, "until": 0.4})
    env.reset()
    forces, seen, rewards, over = 3.0 * np.sin(np.arange(20)), [], [], False
    for force in forces:
        assert not over
        values, reward, ended, over, info = env.step(np.array([force]))
        assert not ended and not info
        seen.append(values)
        rewards.append(reward)
    assert over  # after 0.4 s
    times = 0.02 * np.arange(21)
    data = {"t": times, "u": [*forces, forces[-1]], "interpolation": "hold"}
    run = symgen.load("cart-pole").simulate(
        parameters=OFF, inputs={"force": data}, start={"pole.theta": 0.1}, times=times, integrator="dop853", rtol=1e-10
    )
    assert run.status == "ok"
    near = {"cart.x": 0, "cart.vx": 1, "pole.omega": 4}
    assert all(np.allclose(np.array(seen)[:, i], run[name][1:], atol=1e-9) for name, i in near.items())
    assert np.allclose(rewards, np.cos(run["pole.theta"][1:]) - 1e-3 * forces**2, atol=1e-9)


@pytest.mark.parametrize(
    "settings", [{}, {"coordinates": "absolute"}, {"integrator": "dop853"}], ids=["joint", "absolute", "adaptive"]
)
def test_rows_are_environments_of_their_own_to_the_bit(settings: dict[str, Any]) -> None:
    task = {**TASK, "observe": [*TASK["observe"], "pole.theta"], **settings}
    rows, alone = gym.make_vec(num_envs=9, jobs=2, **task), [gym.make(**task) for _ in range(3)]
    assert len(rows._rows._parts) == 2
    seen, _ = rows.reset(seed=4)
    assert len(set(seen[:, 5])) == 9 and np.abs(seen[:, 5]).max() <= 0.2
    for i, env in enumerate(alone):
        assert np.array_equal(env.reset(options={"start": {"pole.theta": seen[i, 5]}})[0], seen[i])
    generator = np.random.default_rng(1)
    for _ in range(10):
        actions = generator.uniform(-20.0, 20.0, (9, 1))
        seen, rewards, *_ = rows.step(actions)
        for i, env in enumerate(alone):
            values, reward, *_ = env.step(actions[i])
            assert np.array_equal(values, seen[i]) and reward == rewards[i]
    rows.close()


def test_gymnasium_checks_it() -> None:
    env = gym.make(**TASK, end="abs(pole.theta) - 1")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # advice on the sizes of spaces
        check_env(env, skip_render_check=True)


def test_rows_end_and_begin_alone() -> None:
    task = {**TASK, "reset": {"pole.theta": 0.0, "cart.x": 0.0}, "observe": ["pole.theta", "cart.x"]}
    rows = gym.make_vec(num_envs=3, end="abs(cart.x) - 0.01", until=0.2, **task)
    rows.reset()
    actions, ends = np.array([[20.0], [0.0], [0.0]]), []
    for _ in range(11):
        seen, rewards, ended, truncated, infos = rows.step(actions)
        ends.append((ended.tolist(), truncated.tolist()))
        assert not infos
    first = next(k for k, (ended, _) in enumerate(ends) if ended[0])
    assert ends[first] == ([True, False, False], [False] * 3)
    assert ends[first + 1] == ([False] * 3, [False] * 3)  # it begins anew
    assert ends[9][1][1:] == [True, True] and ends[10][1][1:] == [False, False]
    assert rows._rows.times[1] == 0.0 and rewards[1] == 0.0 and not seen[1].any()
    before = rows.step(actions)[0]
    after, _ = rows.reset(options={"reset_mask": np.array([False, True, False])})
    assert np.array_equal(after[[0, 2]], before[[0, 2]]) and not after[1].any()
    rows.close()


def test_functions_in_place_of_formulas_and_bounds() -> None:
    def start(generator: np.random.Generator) -> dict[str, float]:
        return {"pole.theta": float(generator.normal(0.0, 0.1))}

    task = {**TASK, "reset": start, "reward": lambda seen, action: -(seen[..., 0] ** 2) - action[..., 0] ** 2}
    rows, one = gym.make_vec(num_envs=4, **task), gym.make(**task)
    rows.reset(seed=1)
    seen, rewards, *_ = rows.step(np.full((4, 1), 2.0))
    assert np.array_equal(rewards, -(seen[:, 0] ** 2) - 4.0)
    first, _ = one.reset(seed=3)
    again, _ = one.reset(seed=3)
    assert np.array_equal(first, again)
    seen, reward, *_ = one.step(np.array([2.0]))
    assert reward == -(seen[0] ** 2) - 4.0
    rows.close()


def test_a_row_that_fails_is_truncated_and_says_why() -> None:
    task = {**TASK, "act": ["force"], "max_energy_error": 1e-12, "step": 0.02}
    rows, one = gym.make_vec(num_envs=2, **task), gym.make(**task)
    rows.reset(seed=1)
    one.reset(seed=1)
    failed, alone = np.zeros(2, dtype=bool), False
    for _ in range(200):
        _, _, _, truncated, infos = rows.step(np.array([[500.0], [0.0]]))
        if "failure" in infos:
            failed = infos["_failure"]
            assert np.array_equal(failed & truncated, failed)
            assert "energy" in infos["failure"][np.flatnonzero(failed)[0]]
            break
    for _ in range(200):
        _, _, _, truncated, info = one.step(np.array([500.0]))
        if alone := "failure" in info:
            assert truncated and "energy" in info["failure"]
            break
    assert failed.any() and alone
    rows.close()


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"observe": []}, "observe: expected at least one name, got none"),
        ({"observe": ["cart.y.z"]}, "cart.y.z"),
        ({"observe": ["__import__('os')"]}, "got the character '_' at column 1"),
        ({"act": ["farce"]}, "expected an input of cart-pole, got 'farce'; did you mean 'force'"),
        ({"act": {"force": (1.0, -1.0)}}, "act 'force': expected a pair of bounds, the lower one first"),
        ({"reward": None}, "reward: expected a formula or a function"),
        ({"reward": "integral(force)"}, "expected a formula of the present state, got an integral"),
        ({"reset": {"pole.theta": (1.0, 0.0)}}, "reset 'pole.theta': expected a pair of bounds"),
        ({"dt": 0.0}, "dt: expected a finite number above 0"),
        ({"inputs": {"force": "t"}}, "act 'force': expected an input that nothing else sets"),
    ],
)
def test_wrong_arguments_are_refused(changes: dict[str, Any], words: str) -> None:
    for make in (gym.make, lambda **task: gym.make_vec(num_envs=2, **task)):
        with pytest.raises(InputError) as caught:
            make(**{**TASK, **changes})
        assert re.search(words, str(caught.value)), str(caught.value)


def test_one_call_takes_what_it_serves() -> None:
    for changes, words in (
        ({"integrator": "radau5"}, "expected an explicit integrator, got 'radau5'"),
        ({"shape": "looped"}, "expected code of the shape 'straight'"),
        ({"stop_when": "cart.x - 1"}, "expected a model without events, stops and dry friction"),
    ):
        with pytest.raises(InputError, match=re.escape(words)):
            gym.make_vec(num_envs=2, **{**TASK, **changes})
        env = gym.make(**{**TASK, **changes})
        env.reset(seed=0)
        env.step(np.array([1.0]))


def test_an_event_that_ends_runs_terminates() -> None:
    env = gym.make(**TASK, stop_when="cart.x - 0.01")
    env.reset(seed=0)
    for _ in range(50):
        _, _, ended, _, info = env.step(np.array([20.0]))
        if ended:
            break
    assert ended and info["event"]
    with pytest.raises(InputError, match="expected an array of shape"):
        env.step(np.zeros(2))
