"""Commands and options by the words of other programs, with the words that `symgen` has for them."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import SequenceMatcher
from typing import Final

from symgen.base.errors import CLOSE, suggest
from symgen.base.units import read_unit

#: Words that users type for commands -> what stands after ``symgen``.
COMMANDS_MEANT: Final = {
    **dict.fromkeys(
        ("simulate", "sim", "solve", "integrate", "exec", "execute", "start", "compute", "calculate"), "run"
    ),
    **dict.fromkeys(("plot", "graph", "chart", "figure"), "run MODEL --plot FILE.svg"),
    **dict.fromkeys(("save", "csv", "data", "record"), "run MODEL --save FILE.csv"),
    **dict.fromkeys(
        ("animate", "animation", "show", "play", "render", "video", "movie", "display", "visualise"), "view"
    ),
    **dict.fromkeys(("visualize", "watch", "open3d"), "view"),
    **dict.fromkeys(("picture", "image", "sketch", "diagram"), "draw"),
    **dict.fromkeys(("optimise", "optimize", "optimisation", "optimization"), "design"),
    **dict.fromkeys(("synthesis", "synthesise", "burmester"), "synthesize"),
    **dict.fromkeys(("fit", "estimate", "calibrate", "identification"), "identify"),
    **dict.fromkeys(("export", "compile", "build", "codegen", "fmu", "emit"), "generate"),
    **dict.fromkeys(("eig", "eigen", "eigenvalues", "frequencies", "modal", "vibrate", "vibration"), "modes"),
    **dict.fromkeys(("linearize", "linear", "statespace", "state-space"), "linearise"),
    **dict.fromkeys(("static", "statics", "steady", "rest", "equilibrate"), "equilibrium"),
    **dict.fromkeys(("validate", "lint", "verify", "test"), "check"),
    **dict.fromkeys(("gui", "ui", "editor", "open"), "edit"),
    **dict.fromkeys(("init", "create", "template"), "new"),
    **dict.fromkeys(("convert", "load", "urdf", "mjcf"), "import"),
    **dict.fromkeys(("info", "describe", "equations", "print", "explain"), "inspect"),
    **dict.fromkeys(("bench", "benchmark"), "compare"),
    **dict.fromkeys(("scan", "batch", "montecarlo", "monte-carlo", "vary", "doe"), "sweep"),
    **dict.fromkeys(("ls", "catalogue", "catalog", "examples", "models"), "list"),
    **dict.fromkeys(("inverse-dynamics", "torques"), "inverse"),
    **dict.fromkeys(("purge", "delete", "remove", "rm", "wipe", "empty", "clean", "reset"), "cache clear"),
    **{"help": "--help", "version": "--version", "usage": "--help"},
}
_UNTIL: Final = (
    "--end",
    "--tend",
    "--t-end",
    "--time",
    "--duration",
    "--tmax",
    "--tfinal",
    "--stop",
    "--end-time",
    "-t",
)
#: Words that users type for options -> options, of which the first that the command has is suggested.
OPTIONS_MEANT: Final = {
    **dict.fromkeys(("--param", "--parameter", "--parameters", "--params", "--p", "-p", "-D", "-s"), ("--set",)),
    **dict.fromkeys(("--dt", "--h", "--step-size", "--timestep", "--time-step", "-dt"), ("--step",)),
    **dict.fromkeys((*_UNTIL, "--stop-time", "--tstop", "-T"), ("--until",)),
    **dict.fromkeys(("--out", "--outfile", "--file", "-o", "--output", "--csv", "--export"), ("--output", "--save")),
    **{"--save": ("--output",)},
    **dict.fromkeys(("--solver", "--scheme", "-i"), ("--integrator",)),
    **dict.fromkeys(("--formulation", "-m"), ("--method",)),
    **dict.fromkeys(("--tol", "--tolerance", "--reltol", "--rel-tol"), ("--rtol",)),
    **dict.fromkeys(("--abstol", "--abs-tol"), ("--atol",)),
    **dict.fromkeys(("--initial", "--init", "--x0", "--q0"), ("--start",)),
    **dict.fromkeys(("--options", "--opt", "--alpha"), ("--option",)),
    **dict.fromkeys(("--figure", "--graph", "--chart", "--png", "--svg"), ("--plot",)),
    **dict.fromkeys(("--columns", "--outputs", "--signals", "--variables", "-q", "-y"), ("--quantity",)),
    **dict.fromkeys(("--threads", "--workers", "--processes", "--cores", "-j"), ("--jobs",)),
    **dict.fromkeys(("--lang", "--language", "--backend"), ("--target",)),
    **dict.fromkeys(("--keep", "--fields", "--channels"), ("--quantity",)),
    **dict.fromkeys(("--motion", "--data", "--recording", "--continue", "--restart"), ("--from",)),
    **dict.fromkeys(("--quiet", "--silent"), ("--json",)),
    **dict.fromkeys(("--animate", "--animation", "--show", "--video", "--gui"), ("symgen view MODEL -o FILE.html",)),
    **dict.fromkeys(("--inputs", "--u"), ("--input", "--by")),
    **{"--latex": ("--format latex",), "--tex": ("--format latex",), "--at-time": ("--at",)},
}


#: Words that users type for one of a few values of an option -> the value, suggested where the option has it.
VALUES_MEANT: Final = {
    **dict.fromkeys(("python", "numba", "numpy", "py"), "cpu"),
    **dict.fromkeys(("gpu", "nvidia"), "cuda"),
    **dict.fromkeys(("c++", "cpp", "c99", "ansi-c", "fortran", "rust", "c#", "matlab", "arduino"), "c"),
    **dict.fromkeys(("fmi", "simulink", "modelica", "fmi2", "fmi3"), "fmu"),
    **dict.fromkeys(("js", "web", "html"), "javascript"),
    **{"tex": "latex", "txt": "text", "plain": "text"},
}


def hint_on_choice(word: str, values: Sequence[str]) -> str:
    """Return the likely one of the values of an option, with a semicolon before it; empty where none is."""
    meant = VALUES_MEANT.get(word.lower(), "")
    hint = f"did you mean '{meant}'?" if meant in values else suggest(word, values)
    return f"; {hint}" if hint.startswith("did") else ""


def hint_on_command(word: str, commands: Sequence[str]) -> str:
    """Return the hint on an unknown command: by meaning, by spelling, or the list of all."""
    meant = COMMANDS_MEANT.get(word.lower(), "")
    if not meant:
        return suggest(word, commands)
    own = meant.rpartition(" ")[2]
    if meant in commands or own in commands:  # of symgen, or of one of its commands
        return f"did you mean '{meant if meant in commands else own}'?"
    return f"did you mean 'symgen {meant}'?"


def hint_on_extra(word: str) -> str:
    """Return the hint on a word too many, with a semicolon before it: a unit or a value that stands apart."""
    if word.lower() in ("true", "false", "yes", "no", "on", "off"):
        return "; an option that is on or off has no value"
    if not isinstance(read_unit(word), str):
        return "; a number and its unit are one word, such as --set arm=300mm; --until and --step are in s without it"
    return ""


def hint_on_option(option: str, options: Sequence[str]) -> str:
    """Return the likely option for an unknown one, by meaning or by spelling; empty where none is."""
    words = OPTIONS_MEANT.get(option, ())
    meant = next((each for each in words if each.split()[0] in (*options, "symgen")), "")
    if meant:
        return f"did you mean '{meant}'?"
    hint = suggest(option, options)
    # three letters in common mean nothing
    close = hint.startswith("did you mean") and SequenceMatcher(None, option[2:], hint[16:-2]).ratio() >= CLOSE
    return hint if close else ""
