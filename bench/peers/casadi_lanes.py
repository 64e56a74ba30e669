#!/usr/bin/env python3
"""C code for CasADi's inverse dynamics of the shared model, one time node per vector lane.

    casadi_lanes.py FOLDER      reads FOLDER/model.txt, writes FOLDER/casadi_lanes.h

The recursion is Newton's and Euler's in link frames (Luh, Walker & Paul 1980) on SX graphs;
gradient and Jacobians are CasADi's own; common subexpressions are shared. Instead of CasADi's
scalar C, its instruction lists are printed with a vector type, which serves it best.
"""
import sys

import casadi as ca

OPERATORS = {ca.OP_ADD: "{0} + {1}", ca.OP_SUB: "{0} - {1}", ca.OP_MUL: "{0} * {1}",
             ca.OP_DIV: "{0} / {1}", ca.OP_NEG: "-{0}", ca.OP_SQ: "{0} * {0}",
             ca.OP_TWICE: "{0} + {0}", ca.OP_ASSIGN: "{0}", ca.OP_INV: "broadcast(1) / {0}",
             ca.OP_SIN: "lanes_sin({0})", ca.OP_COS: "lanes_cos({0})"}


def read_model(path):
    with open(path) as file:
        words = file.read().split()
    count, gravity, rows = int(words[0]), [float(w) for w in words[1:4]], []
    for at in range(4, 4 + 18 * count, 18):
        parent, prismatic = int(words[at]), int(words[at + 1])
        v = [float(w) for w in words[at + 2:at + 18]]
        rows.append({"parent": parent, "prismatic": prismatic, "axis": v[0:3], "place": v[3:6],
                     "mass": v[6], "com": v[7:10], "inertia": v[10:16]})
    return gravity, rows


def rotation(axis, angle):
    """From the turned frame to the fixed one, Rodrigues' formula."""
    c, s = ca.cos(angle), ca.sin(angle)
    e = ca.DM(axis)
    return ca.SX(ca.DM.eye(3) - e @ e.T) * c + ca.SX(e @ e.T) + ca.SX(ca.skew(e)) * s


def inverse_dynamics(gravity, rows, q, qd, qdd):
    zero = ca.SX.zeros(3)
    turn, arm, w, dw, acc, force, moment = ([None] * len(rows) for _ in range(7))
    for i, row in enumerate(rows):
        p, axis, place = row["parent"], ca.SX(row["axis"]), ca.SX(row["place"])
        wp, dwp, ap = (w[p], dw[p], acc[p]) if p >= 0 else (zero, zero, -ca.SX(gravity))
        if row["prismatic"]:
            turn[i], arm[i] = ca.SX(ca.DM.eye(3)), place + axis * q[i]
            own = 2 * ca.cross(wp, axis * qd[i]) + axis * qdd[i]
            w[i], dw[i] = wp, dwp
        else:
            turn[i], arm[i], own = rotation(row["axis"], q[i]), place, zero
            back = turn[i].T @ wp
            w[i] = back + axis * qd[i]
            dw[i] = turn[i].T @ dwp + ca.cross(back, axis * qd[i]) + axis * qdd[i]
        at_joint = ap + ca.cross(dwp, arm[i]) + ca.cross(wp, ca.cross(wp, arm[i])) + own
        acc[i] = turn[i].T @ at_joint
        com, v = ca.SX(row["com"]), row["inertia"]
        inertia = ca.DM([[v[0], v[3], v[4]], [v[3], v[1], v[5]], [v[4], v[5], v[2]]])
        at_com = acc[i] + ca.cross(dw[i], com) + ca.cross(w[i], ca.cross(w[i], com))
        force[i] = row["mass"] * at_com
        momentum = inertia @ w[i]
        moment[i] = inertia @ dw[i] + ca.cross(w[i], momentum) + ca.cross(com, force[i])
    tau = [None] * len(rows)
    for i in reversed(range(len(rows))):
        row = rows[i]
        tau[i] = ca.dot(ca.SX(row["axis"]), force[i] if row["prismatic"] else moment[i])
        p = row["parent"]
        if p >= 0:
            carried = turn[i] @ force[i]
            force[p] += carried
            moment[p] += turn[i] @ moment[i] + ca.cross(arm[i], carried)
    return ca.vertcat(*tau)


def print_function(function, file):
    name, work = function.name(), function.sz_w()
    file.write(f"static void {name}(const lanes *const *in, lanes *const *out) {{\n  lanes ")
    file.write(", ".join(f"w{i}" for i in range(work)) + ";\n")
    for k in range(function.n_instructions()):
        operation = function.instruction_id(k)
        to, by = function.instruction_output(k), function.instruction_input(k)
        if operation == ca.OP_CONST:
            line = f"w{to[0]} = broadcast({function.instruction_constant(k)!r})"
        elif operation == ca.OP_INPUT:
            line = f"w{to[0]} = in[{by[0]}][{by[1]}]"
        elif operation == ca.OP_OUTPUT:
            line = f"out[{to[0]}][{to[1]}] = w{by[0]}"
        else:
            line = f"w{to[0]} = " + OPERATORS[operation].format(*(f"w{b}" for b in by))
        file.write(f"  {line};\n")
    file.write("}\n")


def print_pattern(name, matrix, file):
    """Row-major places of the nonzeros, in CasADi's order."""
    rows, columns = matrix.sparsity().get_triplet()
    places = ", ".join(str(r * matrix.shape[1] + c) for r, c in zip(rows, columns))
    file.write(f"static const int {name}[] = {{{places}}};\n")


def main():
    folder = sys.argv[1]
    gravity, rows = read_model(f"{folder}/model.txt")
    d = len(rows)
    q, qd, qdd, weights = (ca.SX.sym(name, d) for name in ("q", "qd", "qdd", "w"))
    state = [q, qd, qdd]
    tau = inverse_dynamics(gravity, rows, q, qd, qdd)
    gradient = ca.gradient(ca.dot(weights, tau), ca.vertcat(*state))
    jacobians = [ca.jacobian(tau, x) for x in state]
    share = {"cse": True}
    with open(f"{folder}/casadi_lanes.h", "w") as file:
        file.write(f"enum {{ coordinates = {d} }};\n")
        for k, matrix in enumerate(jacobians):
            print_pattern(f"pattern_{k}", matrix, file)
        print_function(ca.Function("casadi_tau", state, [ca.densify(tau)], share), file)
        print_function(ca.Function("casadi_vjp", state + [weights],
                                   [ca.densify(tau)] + ca.vertsplit(ca.densify(gradient), d),
                                   share), file)
        print_function(ca.Function("casadi_jacobians", state, [ca.densify(tau)] + jacobians,
                                   share), file)


main()
