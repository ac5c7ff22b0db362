"""The parameters and inputs of a description, with the values of their formulas."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import msgspec

from symgen.base.vocabulary.expressions import names_in_expression
from symgen.describe.formulas.evaluate import evaluate_formula, evaluation_order
from symgen.describe.formulas.identifiers import one_line
from symgen.describe.formulas.parser import FormulaNames
from symgen.describe.mechanism import OperatingLimit, Parameter
from symgen.describe.parts.collected import Errors
from symgen.describe.parts.fields import Scalar, read_table, read_value
from symgen.describe.parts.limits import read_limits_of_entry
from symgen.describe.parts.own_units import parameter_value
from symgen.describe.parts.sections import InputSection, ParameterSection


class Parameters:
    """The parameters and inputs of a description being read; `limits` grows as they are read.

    Parameters
    ----------
    source : str
        Name of the file or other origin.
    errors : Errors
        Where errors go.
    sections : mapping
        The entries of the sections ``parameters`` and ``inputs``.
    tables : iterable of str
        Names of the tables.
    """

    def __init__(
        self, source: str, errors: Errors, sections: Mapping[str, Mapping[str, Any]], tables: Iterable[str]
    ) -> None:
        self.source, self.errors, self.sections = source, errors, sections
        elsewhere = frozenset(("t", *sections["inputs"], *tables))
        plain = {name: name for name in sections["parameters"]}
        self.limits = list[OperatingLimit]()
        self.names = FormulaNames("a number or an expression of parameters", plain, elsewhere=elsewhere)

    def place_in_file(self, section: str, name: str) -> str:
        """Return file and key for a message."""
        return f"{self.source}: {section}.{name}"

    def read_all(self) -> tuple[Parameter, ...]:
        """Return the parameters in the order of the file, then the inputs, formulas worked out with the defaults."""
        parameters = dict[str, Parameter]()
        for section, entries in self.sections.items():
            for name, raw in entries.items():
                with self.errors.part_of_description(name):
                    parameters[name] = self.read_parameter(section, name, raw)
        return self.evaluate_formulas(parameters)

    def evaluate_formulas(self, parameters: Mapping[str, Parameter]) -> tuple[Parameter, ...]:
        """Return `parameters` with the values of their formulas."""
        formulas = {name: parameter.formula for name, parameter in parameters.items()}
        order, values = [name for name, formula in formulas.items() if formula is None], dict[str, float]()
        with self.errors.part_of_description(*(name for name, formula in formulas.items() if formula is not None)):
            order = evaluation_order(formulas, f"{self.source}: parameters")
        for name in order:
            formula = formulas[name]
            if formula is None:
                values[name] = parameters[name].value
                continue
            with self.errors.part_of_description(name):
                self.errors.leave_if_wrong(*names_in_expression(formula))
                section = "inputs" if name in self.sections["inputs"] else "parameters"
                values[name] = evaluate_formula(formula, values, self.place_in_file(section, name))
        return tuple(
            msgspec.structs.replace(parameter, value=values[name]) if parameter.formula is not None else parameter
            for name, parameter in parameters.items()
            if name in values
        )

    def read_parameter(self, section: str, name: str, raw: object) -> Parameter:
        """Return a parameter or an input; one with a formula of others has no value yet."""
        where, text, note = self.place_in_file(section, name), "", ""
        limited: ParameterSection | None = None
        value: float | str
        if not isinstance(raw, Mapping):
            value = read_value(Scalar, raw, where)
        elif section == "inputs":
            content = read_table(InputSection, raw, where)
            value, text, note = content.default, content.unit, content.note
        else:
            table = read_table(ParameterSection, raw, where)
            value, text, note, limited = table.value, table.unit, table.note, table
        number, formula, unit = parameter_value(value, text, self.names, where)
        shown = "" if unit.is_si else unit.text
        if limited is not None:
            self.limits += read_limits_of_entry(name, limited, unit, self.names, where, si=True)
        return Parameter(name, number, unit.si, one_line(note), formula, section == "inputs", shown)
