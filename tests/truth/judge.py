"""make check-judge: do others find what Ambulo found?

Problems that statement.py states anew for CasADi are solved by the program; then

  same        the new statement has the rows, relations, values and the objective of Ambulo, at the point of
              solution.yaml and at one far from it: largest difference, relative to the number or to 1
  extended    the same in numbers of 64 bits and more (numpy's longdouble): objective and the worst violation of each
              family of rows beside those of summary.json
  IPOPT       started at that point with exact Hessians, how far it moves the objective, in per cent

    judge.py PROGRAM MODELS FOLDER [PROBLEM...]

A figure outside its bound has a `*`; exit code 1 if there is any. Needs casadi, scipy, numpy, cffi, and
PYTHONPATH with the package of the same build, which tells Ambulo's values of rows.
"""

import json
import os
import subprocess
import sys
import time

PROBLEMS = ["pendulum_swing", "two_link_reach", "yardstick_12", "yardstick_36", "yardstick_72"]
SAME, MOVED = 1e-9, 0.1  # relative; per cent
MISSING = "skipped: make check-judge (no Python with {}; `make setup-judge` installs it)\n[  SKIPPED ]"


def importable(name):
    try:
        __import__(name)
    except ImportError:
        return False
    return True


def main():
    missing = [name for name in ("numpy", "scipy", "casadi", "cffi") if not importable(name)]
    if missing:
        print(MISSING.format(" and ".join(missing)))
        return 0
    program, models, folder = sys.argv[1:4]
    names = sys.argv[4:] or PROBLEMS
    print(f"{'problem':16} {'rows':>6} {'same':>9} {'extended':>9} {'objective':>12} {'IPOPT':>12} {'moved %':>9}"
          f" {'iterations':>10} {'s':>6}")
    passed = sum(judge(program, models, folder, name) for name in names)
    print(f"{passed} passed, {len(names) - passed} failed")
    return passed != len(names)


def judge(program, models, folder, name):
    from statement import Statement  # what is missing has been told by now
    begin = time.process_time()
    out = os.path.join(folder, name)
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(models, name + ".yaml")
    subprocess.run([program, "solve", path, "--quiet", "--force", "-o", out], check=False,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    statement = Statement(path)
    points = values_of_ambulo(path, os.path.join(out, "solution.yaml"))
    same, extended = compared(statement, points, summary)
    x, ours = points[0][:2]
    objective, iterations, status = restarted(statement, x)
    moved = 100 * abs(objective - ours) / max(abs(ours), 1e-12)
    good = same <= SAME and extended <= SAME and moved < MOVED and status == "Solve_Succeeded"
    mark = lambda text, fine: text + (" " if fine else "*")  # noqa: E731
    print(f"{name:16} {len(statement.rows):6d} {mark(f'{same:.0e}', same <= SAME):>10}"
          f"{mark(f'{extended:.0e}', extended <= SAME):>10} {ours:11.6f} {objective:12.6f}"
          f" {mark(f'{moved:.4f}', moved < MOVED):>10}{iterations:10d} {time.process_time() - begin:6.1f}"
          + ("" if status == "Solve_Succeeded" else f"  *{status}"), flush=True)
    return good


def values_of_ambulo(path, solution):
    """Control points of the solution and of a point far from it, of each (objective, {row: (relation, value)})."""
    import ambulo
    import numpy as np
    problem = ambulo.Problem.load(path)
    x = np.array(problem.load_solution(solution)).reshape(problem.control_point_count, -1)
    far = x + np.random.default_rng(1).uniform(-0.1, 0.1, x.shape)
    relation = {"equal": "=", "not_negative": ">="}
    out = []
    for at in (x, far):
        found = problem.evaluate(at)
        out.append((at, found.objective, {(r.family, r.subject, r.detail, r.node): (relation[str(r.relation)], v)
                                          for r, v in zip(problem.rows(), found.rows)}))
    return out


def compared(statement, points, summary):
    """Largest differences: from Ambulo's values at the points, and from the summary at the first of them."""
    import numpy as np
    theirs = {name: relation for name, (relation, _, _) in statement.rows.items()}
    ours = {name: relation for name, (relation, _) in points[0][2].items()}
    if theirs != ours:
        strange = set(theirs.items()) ^ set(ours.items())
        print(f"  {len(strange)} rows that only one has: {sorted(map(str, strange))[:4]}")
        return np.inf, np.inf
    same = 0.0
    for x, objective, values in points:
        found, rows = extended_values(statement, x)
        same = max(same, relative(found, objective), *(relative(rows[name], v) for name, (_, v) in values.items()))
    found, rows = extended_values(statement, points[0][0])
    extended = relative(found, summary["objective"]["total"])
    for family in summary["families"]:
        worst = max(abs(v) if theirs[name] == "=" else max(-v, 0) for name, v in rows.items()
                    if name[0] == family["family"])
        extended = max(extended, abs(worst - family["worst"]))
    return float(same), float(extended)


def relative(found, expected):
    return abs(found - expected) / max(1, abs(expected))


def extended_values(statement, x):
    """The objective, and {row: value}."""
    import numpy as np
    import tape
    output = tape.evaluate(statement.node, *[basis @ x.astype(np.longdouble) for basis in statement.basis])
    rows = {name: sum(factor * output[node, k] for node, k, factor in terms) + constant
            for name, (_, terms, constant) in statement.rows.items()}
    return statement.weights() @ output[:, statement.order["density"]], rows


def restarted(statement, x):
    """Of IPOPT from x: objective, iterations, how it ended."""
    import casadi as ca
    import numpy as np
    names = list(statement.rows)
    high = [0.0 if statement.rows[name][0] == "=" else np.inf for name in names]
    options = {"print_time": False, "ipopt.print_level": 0, "ipopt.sb": "yes", "ipopt.mu_init": 1e-7, "ipopt.tol": 1e-6,
               "ipopt.bound_push": 1e-8, "ipopt.bound_frac": 1e-8, "ipopt.max_iter": 200, **derivatives(statement, names)}
    problem = options.pop("problem")
    solver = ca.nlpsol("judge", "ipopt", problem, options)
    found = solver(x0=x.ravel(), lbg=np.zeros(len(names)), ubg=high)
    return float(found["f"]), solver.stats()["iter_count"], solver.stats()["return_status"]


def derivatives(statement, names):
    """The problem in control points p, and its first and second derivatives from those of a node:

        z = W p  the states of all nodes,   J = M diag(dy/dz) W,   H = W' diag(d2(lambda . y)/dz2) W

    with y the outputs of a node and M the factors of the rows."""
    import casadi as ca
    import numpy as np
    import scipy.sparse as sp
    nodes, n, size = statement.intervals + 1, len(statement.body.names), statement.node.size1_out(0)
    z, weight = ca.SX.sym("z", 3 * n), ca.SX.sym("weight", size)
    y = statement.node(*ca.vertsplit(z, n))
    slope = ca.Function("slope", [z], [ca.densify(ca.jacobian(y, z))], {"cse": True}).map(nodes)
    bend = ca.Function("bend", [z, weight], [ca.densify(ca.hessian(ca.dot(weight, y), z)[0])], {"cse": True}).map(nodes)

    order = np.stack([b.astype(float) for b in statement.basis], axis=1).reshape(3 * nodes, -1)
    spread = sparse(sp.kron(sp.csc_matrix(order), sp.eye(n)))
    mix = sparse(mixed(statement, names, size, nodes))
    p = ca.MX.sym("p", spread.shape[1])
    states = ca.reshape(ca.mtimes(spread, p), 3 * n, nodes)
    output = statement.node.map(nodes)(*ca.vertsplit(states, n))
    density = statement.order["density"]
    by_time = ca.DM(statement.weights().astype(float)).T
    objective = ca.dot(output[density, :], by_time)
    rows = ca.mtimes(mix, ca.vec(output)) + ca.DM([float(statement.rows[name][2]) for name in names])
    blocks = ca.diagcat(*ca.horzsplit(slope(states), 3 * n))
    first = ca.mtimes(ca.mtimes(mix, blocks), spread)
    of, to = ca.MX.sym("of"), ca.MX.sym("to", len(names))
    lagrangian = ca.reshape(ca.mtimes(mix.T, to), size, nodes)
    lagrangian[density, :] += of * by_time
    blocks = ca.diagcat(*ca.horzsplit(bend(states, lagrangian), 3 * n))
    second = ca.triu(ca.mtimes(ca.mtimes(spread.T, blocks), spread))
    none = ca.MX.sym("none", 0)
    return {"problem": {"x": p, "f": objective, "g": rows},
            "jac_g": ca.Function("jac_g", [p, none], [rows, first], ["x", "p"], ["g", "jac_g_x"]),
            "hess_lag": ca.Function("hess_lag", [p, none, of, to], [second], ["x", "p", "lam_f", "lam_g"],
                                    ["triu_hess_gamma_x_x"])}


def mixed(statement, names, size, nodes):
    """[row][node and output]: the factors of the rows."""
    import scipy.sparse as sp
    entries = [(float(factor), r, node * size + k) for r, name in enumerate(names)
               for node, k, factor in statement.rows[name][1]]
    values, rows, columns = zip(*entries)
    return sp.csc_matrix((values, (rows, columns)), (len(names), size * nodes))


def sparse(matrix):
    import casadi as ca
    import scipy.sparse as sp
    matrix = sp.csc_matrix(matrix)
    matrix.sort_indices()
    pattern = ca.Sparsity(*matrix.shape, matrix.indptr.tolist(), matrix.indices.tolist())
    return ca.DM(pattern, matrix.data)


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    sys.exit(main())
