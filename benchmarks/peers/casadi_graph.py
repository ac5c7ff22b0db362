"""An emitted function as a graph of CasADi."""

from __future__ import annotations

from typing import Any

import casadi as ca

from symgen.base.ir.program import Block


def shared_by_casadi(block: Block) -> int:
    """Return the instructions of a block as CasADi's SX, after its elimination of common parts.

    Constants, inputs and tables are no instructions.
    """
    names = {"lt": "lt", "le": "le", "gt": "gt", "ge": "ge", "or": "logic_or", "and": "logic_and", "not": "logic_not"}
    names |= {"add": "plus", "sub": "minus", "mul": "times", "div": "rdivide", "pow": "power"}
    names |= {"max": "fmax", "min": "fmin", "abs": "fabs", "where": "if_else", "step": "gt"}
    g, values, inputs = block.graph, dict[int, Any](), list[Any]()
    ends = [node for _, node in block.outputs] + ([] if block.flag is None else [block.flag])
    for node in g.required_nodes(ends):
        op, args, payload = g.nodes[node]
        numbers = [values[a] for a in args]
        if op == "const":
            assert isinstance(payload, float), "constants are numbers"
            values[node] = ca.SX(payload)
        elif op in ("input", "table"):
            values[node] = ca.SX.sym(f"x{node}")
            inputs.append(values[node])
        elif op == "neg":
            values[node] = -numbers[0]
        else:
            values[node] = getattr(ca, names.get(op, op))(*numbers)
    shared = ca.cse(ca.vertcat(*(values[node] for node in ends)))
    function = ca.Function("rhs", inputs, [shared])
    idle = {ca.OP_INPUT, ca.OP_OUTPUT, ca.OP_CONST, ca.OP_PARAMETER}
    return sum(function.instruction_id(k) not in idle for k in range(function.n_instructions()))
