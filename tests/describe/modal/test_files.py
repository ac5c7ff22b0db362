"""Modal bodies of a mechanism file: names, starts, refusals, and files that are none."""

import shutil
import struct
import subprocess
import sys
import zipfile

import numpy as np
import pytest
from support.modal_machines import arc, bow, machine, reduce_to, straight

import symgen
from symgen.base.errors import AssemblyError, InputError
from symgen.describe.facts.digest import digest

ARM = """
[bodies.arm]
type = "modal"
file = "arm.npz"
{keys}
[joints.pin]
type = "revolute"
between = ["ground", "arm.root"]
at = [[0.0, 0.0], [0.0, 0.0]]
{more}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with a bar and its row, and bodies of other kinds."""
    folder = tmp_path_factory.mktemp("modal")
    mesh = straight(count=6)
    n = mesh.mass.shape[0]
    rows = {"sigma": (np.vstack([np.eye(n)[0], -2.0 * np.eye(n)[3], np.eye(n)[5]]), "Pa"), "lift": np.eye(n)[1]}
    reduce_to(folder / "arm.npz", mesh, 1, rows=rows)
    reduce_to(folder / "space.npz", arc(), 0)
    reduce_to(folder / "free.npz", bow(), 2, ends=False)
    return folder


def load(folder, keys="", more="", space="planar"):
    return machine(folder, ARM.format(keys=keys, more=more), space, "[0.0, -9.81]" if space == "planar" else "")


def sentence(folder, keys="", more="", space="planar"):
    with pytest.raises(InputError) as error:
        load(folder, keys, more, space)
    assert "\n" not in str(error.value)
    return str(error.value)


def test_a_body_has_modes_and_interfaces(folder):
    model = load(folder)
    body = model.mechanism.body("arm")
    assert body.coordinates == ("x", "y", "theta", "m1", "m2", "m3", "m4")
    assert body.speeds[3:] == ("vm1", "vm2", "vm3", "vm4")
    assert model.mechanism.body("arm.tip").coordinates == ()
    assert repr(model.mechanism) == "<Mechanism bent, planar: 1 body, 1 joint, 1 force, 0 parameters>"


@pytest.mark.slow
def test_rows_and_interfaces_are_read_by_name(folder):
    more = '[outputs]\npeak = { value = "max(abs(arm.sigma))", unit = "Pa" }\nlow = "min(arm.sigma)"\n'
    more += 'h = "arm.tip.vy + arm.lift"\n'
    result = load(folder, more=more).simulate(until=0.05)
    values = np.column_stack([result[f"arm.sigma{i}"] for i in (1, 2, 3)])
    np.testing.assert_allclose(result["peak"], np.abs(values).max(axis=1), rtol=1e-12)
    np.testing.assert_allclose(result["low"], values.min(axis=1), rtol=1e-12)
    np.testing.assert_allclose(result["h"], result["arm.tip.vy"] + result["arm.lift"], rtol=1e-12)
    turns = load(folder).mechanism.body("arm.tip").carried.turn
    bent = sum(turn * result[f"arm.m{i}"] for i, (turn,) in enumerate(turns, 1))
    bending = sum(turn * result[f"arm.vm{i}"] for i, (turn,) in enumerate(turns, 1))
    np.testing.assert_allclose(result["arm.tip.theta"], result["arm.theta"] + bent, rtol=1e-12)
    np.testing.assert_allclose(result["arm.tip.omega"], result["arm.omega"] + bending, rtol=1e-12, atol=1e-14)


def test_max_of_one_number_stays_refused(folder):
    said = sentence(folder, more='[outputs]\npeak = "max(arm.x)"\n')
    assert said.endswith("outputs.peak: expected two arguments or more, got max() with 1")


@pytest.mark.slow
def test_modes_start_at_rest_and_stay_where_a_start_puts_them(folder):
    assert load(folder).simulate(until=0.01)["arm.m1"][0] == 0.0
    own = load(folder, "start = { m1 = 0.002, vm2 = 0.1 }").simulate(until=0.01)
    assert (own["arm.m1"][0], own["arm.vm2"][0]) == pytest.approx((0.002, 0.1), rel=1e-14)  # closed, within rounding
    assert load(folder).simulate(until=0.01, start={"arm.m1": -0.001})["arm.m1"][0] == -0.001


@pytest.mark.slow
def test_a_start_that_a_joint_contradicts_is_refused(folder):
    """Both ends are pinned at their distance without deformation, and the fifth mode would change it."""
    far = float(
        np.linalg.norm(np.subtract(*(load(folder).mechanism.body(f"arm.{x}").carried.place for x in ("root", "tip"))))
    )
    more = f'[joints.other]\ntype = "revolute"\nbetween = ["ground", "arm.tip"]\nat = [[{far!r}, 0.0], [0.0, 0.0]]\n'
    model = load(folder, more=more)
    assert model.simulate(until=0.001).status == "ok"
    axial = f"arm.m{1 + int(np.argmax([abs(x[0]) for x in model.mechanism.body('arm.tip').carried.shape]))}"
    with pytest.raises(AssemblyError, match=r"joint '(pin|other)' stays open"):
        model.simulate(until=0.001, start={axial: 0.01})


@pytest.mark.slow
def test_both_ends_of_a_joint_on_one_body(folder):
    """A bar of fixed length between the ends of one body: modes alone can follow it."""
    more = '[joints.tie]\ntype = "distance"\nlength = 1.0\nbetween = ["arm.root", "arm.tip"]\n'
    more += "at = [[0.0, 0.0], [0.0, 0.0]]\n"
    model = load(folder, more=more)
    result = model.simulate(until=0.05, rtol=1e-10, atol=1e-12)
    away = [result[f"arm.tip.{x}"] - result[f"arm.root.{x}"] for x in "xy"]
    np.testing.assert_allclose(np.hypot(*away), np.hypot(*away)[0], rtol=1e-10)
    assert not [name for name in result.reactions.names if name.startswith("tie.")]
    assert np.abs(result["arm.m1"]).max() > 0.0


REFUSED = {
    "missing": (
        'file = "none.npz"',
        "expected the path of a .npz file that symgen.reduced has written",
    ),
    "outside": ('file = "../arm.npz"', "expected the path of a .npz file"),
    "space": ('file = "space.npz"', "expected a planar body for a planar mechanism, got 'space.npz', which is spatial"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_file_that_does_not_fit_is_refused(folder, name):
    keys, said = REFUSED[name]
    text = ARM.format(keys="", more="").replace('file = "arm.npz"', keys)
    with pytest.raises(InputError) as error:
        machine(folder, text)
    assert said in str(error.value) and str(error.value).startswith("bent.toml: bodies.arm.file: ")


@pytest.mark.parametrize(
    ("keys", "more", "said"),
    [
        ("damping = -1.0", "", "bodies.arm.damping: expected a time that is not negative, got -1.0"),
        (
            "start = { m9 = 0.1 }",
            "",
            "arm.start: expected m1 to m4 or vm1 to vm4, as the body has 4 modes, got 'm9'",
        ),
        ("mass = 1.0", "", "bodies.arm: expected the keys type, file"),
        (
            "",
            '[joints.b]\ntype = "revolute"\nbetween = ["ground", "arm"]\nat = [[0.0, 0.0], "centre"]\n',
            "b.between: expected an interface of the modal body 'arm', got 'arm', whose floating frame is no part "
            "of its material; it has arm.root, arm.tip",
        ),
        (
            "",
            '[forces.f]\ntype = "force"\nbody = "arm"\nforce = [1.0, 0.0]\n',
            "forces.f.body: expected an interface of the modal body 'arm'",
        ),
        (
            "",
            '[forces.f]\ntype = "force"\nbody = "arm.tipp"\nforce = [1.0, 0.0]\n',
            "expected an interface of the modal body 'arm', got the unknown one 'tipp'; did you mean 'arm.tip'?",
        ),
        (
            "",
            '[outputs]\ny = "arm.sigmaa1"\n',
            "got 'sigmaa1', which body 'arm' does not have; did you mean 'arm.sigma1'?",
        ),
    ],
)
def test_what_a_file_asks_wrongly_is_said_in_a_sentence(folder, keys, more, said):
    assert said in sentence(folder, keys, more)


def test_a_body_without_interfaces_takes_no_joint(folder):
    text = ARM.format(keys="", more="").replace("arm.npz", "free.npz").replace("arm.root", "arm")
    with pytest.raises(InputError, match="a body with interfaces, got 'arm', whose floating frame is no part"):
        machine(folder, text)


def test_a_beam_cannot_be_clamped_to_a_modal_body(folder):
    beam = (
        '[beams.leaf]\nstart = [1.0, 0.0]\nend = [1.5, 0.0]\nelements = 2\nclamp = "{}"\n'
        "section = {{ width = 0.02, height = 0.01 }}\nmaterial = {{ young = 2e9, density = 1000.0 }}\n"
    )
    for host in ("arm", "arm.tip"):
        assert "beams.leaf.clamp: expected" in sentence(folder, more=beam.format(host))


def rewritten(folder, name, **changes):
    """A file with some arrays changed; None leaves one out."""
    with np.load(folder / "arm.npz") as file:
        arrays = {key: file[key] for key in file.files} | changes
    np.savez(folder / name, allow_pickle=True, **{key: value for key, value in arrays.items() if value is not None})
    return name


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            {"version": np.array(2)},
            "expected a file of version 1, got 'x.npz' of version 2; write it again by symgen.reduced",
        ),
        ({"version": None}, "got 'x.npz' without a version"),
        ({"growth": None}, "got 'x.npz' without the array 'growth'"),
        ({"rows": np.array([{}], dtype=object)}, "got 'x.npz' whose array 'rows' is a pickle, which nothing here runs"),
        ({"mass": np.array(1.0 + 0.0j)}, "got 'x.npz' whose part 'mass.npy' is no plain array"),
        ({"mass": np.array([(1.0, 2)], dtype=[("a", float), ("b", int)])}, "whose part 'mass.npy' is no plain array"),
        ({"mass": np.array(np.nan)}, "got 'x.npz' whose array 'mass' has an entry that is not a finite number"),
        ({"mass": np.array(-1.0)}, "got 'x.npz' with a mass or a stiffness that is not above 0"),
        ({"growth": np.zeros((1, 1, 1))}, "got 'x.npz' whose array 'growth' has a size that does not fit the others"),
        ({"centre": np.array(0.0)}, "got 'x.npz' that is neither of the plane nor of space"),
        ({"stretch_ends": np.array([[0, 9]])}, "got 'x.npz' with a stretch between interfaces that it does not have"),
        (
            {"couple_ends": np.array([[0, 9]])},
            "got 'x.npz' whose array 'couple_share' has a size that does not fit the others",
        ),
        (
            {"stretch_growth": None},
            "got 'x.npz' whose array 'stretch_growth' has a size that does not fit the others",
        ),
        ({"centre": np.zeros(4)}, "got 'x.npz' that is neither of the plane nor of space"),
        ({"lines": np.array([[0, 99]])}, "got 'x.npz' whose outline has lines between points that it does not have"),
    ],
    ids=lambda x: next(iter(x)) if isinstance(x, dict) else "",
)
def test_a_file_of_something_else_is_refused(folder, changes, said):
    name = rewritten(folder, "x.npz", **changes)
    text = ARM.format(keys="", more="").replace("arm.npz", name)
    with pytest.raises(InputError) as error:
        machine(folder, text)
    assert said in str(error.value) and "bodies.arm.file" in str(error.value)


def test_damaged_files_are_refused(folder):
    whole = (folder / "arm.npz").read_bytes()
    generator = np.random.default_rng(3)
    for i in range(60):
        content = bytearray(whole if i % 3 else whole[: int(generator.integers(len(whole)))])
        for at in generator.integers(len(content), size=4) if i % 3 else ():
            content[at] = int(generator.integers(256))
        (folder / f"damaged{i}.npz").write_bytes(bytes(content))
        try:
            machine(folder, ARM.format(keys="", more="").replace("arm.npz", f"damaged{i}.npz"))
        except InputError as error:
            assert "\n" not in str(error)


@pytest.mark.slow
def test_a_bomb_is_not_unpacked(folder):
    with zipfile.ZipFile(folder / "bomb.npz", "w", zipfile.ZIP_DEFLATED) as archive:
        header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (10000000,), }"
        head = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header
        archive.writestr("growth.npy", head + bytes(80_000_000))
    with pytest.raises(InputError, match="with too much in it"):
        machine(folder, ARM.format(keys="", more="").replace("arm.npz", "bomb.npz"))


def test_the_digest_is_that_of_the_equations(folder):
    """Rows and starts change nothing of them; another file does."""
    one = digest(load(folder).mechanism)
    assert digest(load(folder, "start = { m1 = 0.001 }").mechanism) == one
    shutil.copy(folder / "arm.npz", folder / "kept.npz")
    reduce_to(folder / "arm.npz", straight(count=6), 1)
    try:
        assert digest(load(folder).mechanism) == one
        reduce_to(folder / "arm.npz", straight(count=6, height=0.03), 1)
        assert digest(load(folder).mechanism) != one
    finally:
        shutil.move(folder / "kept.npz", folder / "arm.npz")


@pytest.mark.slow
def test_commands_take_a_modal_body(folder):
    load(folder)
    file = str(folder / "bent.toml")
    checked = subprocess.run(
        [sys.executable, "-m", "symgen", "check", file], capture_output=True, text=True, check=True
    )
    assert "arm: 4 modes, 3 of 2 interfaces, 3 (2 - 1), and 1 inside (arm.root, arm.tip); free at" in checked.stdout
    ran = subprocess.run([sys.executable, "-m", "symgen", "run", file], capture_output=True, text=True, check=True)
    assert "pin.angle " in ran.stdout
    looped = subprocess.run(
        [sys.executable, "-m", "symgen", "run", file, "--shape", "looped"], capture_output=True, text=True
    )
    assert (
        looped.returncode == 2 and "expected straight code where a file has modal bodies, got looped" in looped.stderr
    )


@pytest.mark.slow
def test_a_builder_and_a_picture_take_a_modal_body(folder, monkeypatch):
    monkeypatch.chdir(folder)
    builder = symgen.MechanismBuilder("built", gravity=[0.0, -9.81])
    builder.body("arm", type="modal", file="arm.npz", damping=1e-4)
    builder.joint("pin", "revolute", between=["ground", "arm.root"], at=[[0.0, 0.0], [0.0, 0.0]])
    model = symgen.Model(builder.build())
    assert model.simulate(until=0.01).status == "ok"
    model.draw().save(folder / "arm.svg")
    assert "<svg" in (folder / "arm.svg").read_text(encoding="utf-8")


def test_a_file_of_an_earlier_release_is_read_without_what_it_lacks(folder):
    later = ("stretch_ends", "stretch_growth", "stretch_stiffness", "couple_ends", "couple_share", "softening")
    name = rewritten(folder, "earlier.npz", **dict.fromkeys(later))
    own = load(folder).mechanism.body("arm").modal
    read = machine(folder, ARM.format(keys="", more="").replace("arm.npz", name), gravity="[0.0, -9.81]").mechanism
    assert [s.ends for s in own.stretches] == [("root", "tip")] and read.body("arm").modal.stretches == ()
    assert read.body("arm").modal.equations == own.equations
