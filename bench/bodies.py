"""Whole bodies of any size, for the times in docs/performance.md.

    python3 bench/bodies.py OUT

writes into OUT:

  limbs_29.yaml, limbs_37, limbs_45, limbs_57, and each with _posture: the walk of
    tests/support/walk_rigid.yaml by models/lower_body_21.yaml with one to three pairs of arms, which are copies
    of its legs on the thorax (without feet at 29 and 37 coordinates) with a quarter of their mass in
    all. Without the posture term nothing but torques says where the arms are.
  extra_SEED_K.yaml: models/walk_whole_body_45.yaml by its body with 2 K further joints, K from 1 to
    5: the middle of each thigh, shank, upper arm and forearm and the root of each collar bone turn
    about random axes, the left ones about the mirrored. extra_SEED_K_bare.yaml: without a posture
    term on arms and further joints. Seeds 1 to 3; K = 5 is the body of 55 coordinates.
  NAME_bare.yaml of the shipped walks of whole bodies: without the posture term on the arms.

Only text is moved, so that programs of any age can read what they could read before.
"""

import os
import random
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)

# where a bone turns: the link before, the one after, metres (of a stature of 1) along the bone, and
# the strength of the joint in units of weight times stature
PLACES = [
    ("thigh", "knee", 0.12, 0.1),
    ("shank", "ankle", 0.12, 0.08),
    ("upper_arm", "elbow", 0.08, 0.04),
    ("forearm", "wrist", 0.07, 0.03),
    ("thorax", "sternum", 0.0, 0.1),
]


def read(*parts):
    with open(os.path.join(ROOT, *parts), encoding="utf-8") as file:
        return file.read()


def write(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


def legs_as_arms(legs, pair, share, feet):
    """The links of both legs as pair number `pair` of arms."""
    if not feet:
        legs = re.sub(r"  - \{name: ankle_([rl]).*?(?=\n  #|\Z)", "", legs, flags=re.S)
    legs = re.sub(r"\b(\w+_[rl])\b", lambda found: f"arm{pair}_{found.group(1)}", legs)
    legs = legs.replace("parent: pelvis", "parent: thorax")

    def lighter(found):
        return re.sub(r"[\d.]+(?=[,}])", lambda mass: f"{float(mass.group()) * share:.6f}", found.group())

    return re.sub(r"mass: \{[^}]*\}", lighter, legs)


def limbs(folder, coordinates, pairs, feet):
    body = read("models", "lower_body_21.yaml")
    walk = read("tests", "support", "walk_rigid.yaml")
    start, end = body.index("  # right leg"), body.index("\npoints:")
    legs = body[start:end]
    arms = [legs_as_arms(legs, pair, 0.25 / pairs, feet) for pair in range(1, pairs + 1)]
    write(folder, f"limbs_body_{coordinates}.yaml", body[:end] + "\n" + "\n".join(arms) + body[end:])
    names = [name for arm in arms for name in re.findall(r"coordinate: \{name: (\w+)", arm)]
    assert 21 + len(names) == coordinates
    walk = walk.replace("../../models/lower_body_18_rigid.yaml", f"limbs_body_{coordinates}.yaml")
    walk = walk.replace("subtalar_angle_l: 0.02}", "subtalar_angle_l: 0.02,\n      "
                        + ", ".join(f"{name}: 0.03" for name in names) + "}")
    posture = ("  - {term: posture, name: arm_posture, weight: 0.05, scale: {"
               + ", ".join(f"{name}: 1" for name in names) + "}}\n")
    write(folder, f"limbs_{coordinates}.yaml", walk)
    write(folder, f"limbs_{coordinates}_posture.yaml", walk.rstrip("\n") + "\n" + posture)


def turned_bone(side, number, theta, alpha):
    """Links that put a joint into a bone; frames are the body's before and after."""
    before, after, along, strength = PLACES[number]
    name = f"extra_{before}_{side}"
    other = f"extra_{before}_{'l' if side == 'r' else 'r'}"
    parent = before if before == "thorax" else f"{before}_{side}"
    turn = theta if side == "r" else theta + 180
    rows = [
        ("a", parent, f"fixed, dh: [-90, 0, {along}, 0]"),
        ("b", None, "fixed, dh: [90, 0, 0, 0]"),
        ("c", None, f"fixed, dh: [{turn:.3f}, 0, 0, {alpha:.3f}]"),
        ("d", None, f"revolute, dh: [0, 0, 0, {-alpha:.3f}],\n     coordinate: {{name: {name}, range: "
         f"[-25, 25], mirror: {other}, torque: [{-strength}, {strength}]}}"),
        ("e", None, f"fixed, dh: [{-turn:.3f}, 0, 0, 0]"),
        ("f", None, f"fixed, dh: [-90, 0, {-along}, 0]"),
        ("g", None, "fixed, dh: [90, 0, 0, 0]"),
    ]
    text, last = "", None
    for letter, parent, rest in rows:
        text += f"  - {{name: {name}_{letter}, parent: {parent or last}, joint: {rest}}}\n"
        last = f"{name}_{letter}"
    return f"{after}_{side}", last, name, text


def without_posture(walk):
    return re.sub(r"  - term: posture\n    name: arm_posture\n.*?(?=  - term)", "", walk, flags=re.S)


def extra(folder, seed, count):
    body = read("models", "whole_body_45.yaml")
    walk = read("models", "walk_whole_body_45.yaml")
    chance = random.Random(seed)
    names = []
    for number in range(count):
        theta, alpha = chance.uniform(0, 360), chance.uniform(20, 160)
        for side in "rl":
            after, last, name, text = turned_bone(side, number, theta, alpha)
            row = re.search(r"  - \{name: " + after + r", parent: \w+", body)
            body = (body[:row.start()] + text
                    + re.sub(r"parent: \w+", f"parent: {last}", row.group()) + body[row.end():])
            names.append(name)
    write(folder, f"extra_body_{seed}_{count}.yaml", body)
    walk = walk.replace("whole_body_45.yaml", f"extra_body_{seed}_{count}.yaml")
    torques = ", ".join(f"{name}: 1" for name in names)
    walk = walk.replace("scale: {default: 0,\n      arm_flex_r: 3",
                        "scale: {default: 0,\n      " + torques + ",\n      arm_flex_r: 3")
    postures = ", ".join(f"{name}: 2" for name in names)
    walk = walk.replace("scale: {arm_flex_r: 1.2", "scale: {" + postures + ",\n      arm_flex_r: 1.2")
    write(folder, f"extra_{seed}_{count}.yaml", walk)
    write(folder, f"extra_{seed}_{count}_bare.yaml", without_posture(walk))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    for coordinates, pairs, feet in [(29, 1, False), (37, 2, False), (45, 2, True), (57, 3, True)]:
        limbs(folder, coordinates, pairs, feet)
    for seed in (1, 2, 3):
        for count in range(1, len(PLACES) + 1):
            extra(folder, seed, count)
    for name in ("walk_whole_body", "walk_whole_body_37", "walk_whole_body_45"):
        walk = read("models", name + ".yaml")
        model = re.search(r"^model: (\S+)", walk, re.M).group(1)
        write(folder, model, read("models", model))
        write(folder, name + "_bare.yaml", without_posture(walk))


if __name__ == "__main__":
    main()
