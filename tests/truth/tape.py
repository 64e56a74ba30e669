"""A function of CasADi in extended precision: its operations one by one, in numpy's longdouble, at all nodes at once."""

import casadi as ca
import numpy as np

UNARY = {ca.OP_NEG: np.negative, ca.OP_SQ: np.square, ca.OP_SIN: np.sin, ca.OP_COS: np.cos, ca.OP_SQRT: np.sqrt,
         ca.OP_TWICE: lambda x: x + x, ca.OP_ASSIGN: np.copy, ca.OP_INV: lambda x: 1 / x}
BINARY = {ca.OP_ADD: np.add, ca.OP_SUB: np.subtract, ca.OP_MUL: np.multiply, ca.OP_DIV: np.divide}


def evaluate(function, *inputs):
    """`inputs` [node][entry]; [node][output]. SX functions of one output."""
    nodes = len(inputs[0])
    work = [None] * function.sz_w()
    out = np.zeros((nodes, function.size1_out(0)), np.longdouble)
    place = function.sparsity_out(0).row()
    for k in range(function.n_instructions()):
        op, to, of = function.instruction_id(k), function.instruction_output(k), function.instruction_input(k)
        if op == ca.OP_INPUT:
            work[to[0]] = inputs[of[0]][:, of[1]]
        elif op == ca.OP_OUTPUT:
            out[:, place[to[1]]] = work[of[0]]
        elif op == ca.OP_CONST:
            work[to[0]] = np.full(nodes, function.instruction_constant(k), np.longdouble)
        elif op in UNARY:
            work[to[0]] = UNARY[op](work[of[0]])
        else:
            work[to[0]] = BINARY[op](work[of[0]], work[of[1]])
    return out
