"""``rgss check`` finds what no trial could do in a scene: the pair, the distance, both places, and the remedy."""

from __future__ import annotations

import math
import re
import sys

import pytest
import trimesh

SCENE = "scenes/restaurant.yaml"
LIFTED = "  - move: {to: grasp}\n  - grip: {}\n  - move: {to: lift, mode: straight}\n"
BESIDE = "'grip' grips nothing: the ends of the fingers are "
ABOVE = "'release' releases cup "


@pytest.fixture
def check_with(rgss, folder):
    """Checks a project whose scene is edited."""

    def check(*edits):
        path = folder / SCENE
        text = path.read_text(encoding="utf-8")
        for old, new in edits:
            assert text.count(old) == 1, old
            text = text.replace(old, new)
        path.write_text(text, encoding="utf-8")
        told = rgss("check", "--json", "--project", folder)
        return told.status, [one for one in told.document["findings"] if one["rule"].startswith("scene.")], text

    return check


def line_of(text, what):
    return text[: text.index(what)].count("\n") + 1


def test_the_shipped_scene_is_sound(rgss, untouched):
    told = rgss("check", "--json", "--project", untouched)

    assert told.status == 0
    assert told.document["skipped"] == []
    assert [one for one in told.document["findings"] if one["rule"].startswith("scene.")] == []


def test_furniture_in_furniture(check_with):
    status, findings, text = check_with(("foot: [-0.72 m, -1.15 m, 0 m]", "foot: [-1.30 m, -0.90 m, 0 m]  # moved"))

    (one,) = findings
    table = line_of(text, "foot: [-1.30 m, -0.90 m, 0 m]\n")
    assert (status, one["rule"], one["severity"]) == (1, "scene.overlap", "warning")
    assert re.fullmatch(rf"table_near and chair_left \({SCENE}:\d+:\d+\) overlap, 560 mm deep", one["message"])
    assert (one["file"], one["line"]) == (SCENE, table)
    assert str(line_of(text, "# moved")) in one["message"]
    assert "560 mm" in one["hint"]


def test_furniture_that_is_built_in_is_no_mistake(check_with):
    """A shelf that enters the column by a centimetre."""
    status, findings, _ = check_with(("foot: [0.42 m, 0.42 m, 0 m]", "foot: [0.43 m, 0.43 m, 0 m]"))

    assert (status, findings) == (0, [])


def test_a_body_inside_another(check_with):
    status, findings, _ = check_with(("foot: [0.72 m, -0.06 m, 0.90 m]", "foot: [0.70 m, 0.66 m, 0.92 m]"))

    (one,) = findings
    assert (status, one["rule"]) == (1, "scene.inside")
    assert re.match(rf"glass_rack is inside coffee_machine \({SCENE}:\d+:\d+\), \d+ mm deep", one["message"])


def test_a_cup_in_another_body(check_with):
    status, findings, text = check_with(("at: [0.70 m, -0.30 m]", "at: [0.72 m, -0.06 m]"))

    overlap = next(one for one in findings if one["rule"] == "scene.object-overlap")
    unserved = [one for one in findings if one["rule"] == "scene.unserved"]
    assert status == 1
    assert re.fullmatch(rf"at the start, cup overlaps glass_rack \({SCENE}:\d+:\d+\), 100 mm deep", overlap["message"])
    assert (overlap["line"], overlap["severity"]) == (line_of(text, "at: [0.72 m, -0.06 m]"), "error")
    assert any(
        re.search(r"serves grasp: collision of \S+ with \S+, [\d.]+ mm deep", one["message"]) for one in unserved
    )


MUG = """
workpieces:
  - id: mug
    radius: 30 mm
    height: 80 mm
    mass: 0.2 kg
    friction: 1.0
    force_limit: 40 N
    stands_on: counter_pick
    at: [{at}]
    colour: "#3d7fd9"
    place_region: {{stands_on: counter_place, at: [{to}], radius: 30 mm, largest_tilt: 5 deg}}

place_region:
"""


@pytest.mark.parametrize(
    ("at", "to", "rule", "message", "where"),
    [
        ("0.72 m, -0.28 m", "0.60 m, 0.30 m", "scene.object-overlap", "at the start, mug overlaps cup", 0),
        ("1.20 m, -0.30 m", "0.60 m, 0.30 m", "scene.object-unsupported", "at the start, mug does not rest", 0),
        ("0.60 m, -0.40 m", "0.60 m, 1.30 m", "scene.place-unsupported", "in its place, mug does not rest", 1),
    ],
)
def test_further_objects_are_checked_as_the_first_is(check_with, at, to, rule, message, where):
    status, findings, text = check_with(("\nplace_region:\n", MUG.format(at=at, to=to)))

    one = next(one for one in findings if one["rule"] == rule)
    assert (status, one["severity"]) == (1, "error")
    assert one["message"].startswith(message)
    assert one["line"] == line_of(text, f"at: [{(at, to)[where]}]")


def write_task_of_mug(folder):
    """Let the task of the study carry the mug alone."""
    moves = ("grasp_departure", "place_approach", "place")
    steps = ["{move: {to: grasp}}", "{grip: {}}", "{move: {to: lift, mode: straight}}"]
    steps += [*(f"{{move: {{to: {name}}}}}" for name in moves), "{release: {}}", "{move: {to: grasp_approach}}"]
    (folder / "scenes/tasks").mkdir(exist_ok=True)
    task = "task: mug\nsteps:\n  - for_each:\n      objects: [mug]\n      steps:\n"
    task += "".join(f"        - {step}\n" for step in steps)
    (folder / "scenes/tasks/mug.yaml").write_text(task, encoding="utf-8")
    study = folder / "studies/pick_place.yaml"
    text = study.read_text(encoding="utf-8")
    study.write_text(re.sub(r"(?m)^scene: (.*)$", r"scene: \1\ntask: scenes/tasks/mug.yaml", text), encoding="utf-8")


def test_a_waypoint_of_a_further_object_that_nothing_serves_is_found_at_its_place(check_with, folder):
    write_task_of_mug(folder)
    _, findings, text = check_with(("\nplace_region:\n", MUG.format(at="0.60 m, -0.40 m", to="1.50 m, 0.30 m")))

    one = next(one for one in findings if one["rule"] == "scene.unserved" and " place of mug" in one["message"])
    assert one["line"] == line_of(text, "at: [1.50 m, 0.30 m]")


def test_a_cup_that_does_not_rest_on_its_support(check_with):
    _, findings, _ = check_with(("at: [0.70 m, -0.30 m]", "at: [1.20 m, -0.30 m]"))

    one = next(one for one in findings if one["rule"] == "scene.object-unsupported")
    assert "at the start, cup does not rest on counter_pick" in one["message"]
    assert one["message"].endswith("its centre of mass is 150 mm beyond the edge")
    assert "stands_on" in one["hint"]


@pytest.mark.parametrize(
    ("shape", "rule", "message", "severity"),
    [
        (
            "box: [160 mm, 50 mm, 60 mm]\n  centre_of_mass: [79 mm, 0 mm, 0 mm]\n  at: [1.04 m, -0.30 m]",
            "scene.object-unsupported",
            "at the start, cup does not rest on counter_pick (scenes/restaurant.yaml:26:11): its centre of mass is 69",
            "error",
        ),
        (
            "mesh: cone.stl\n  collision: hull\n  at: [0.70 m, -0.30 m]",
            "scene.object-unstable",
            "cup cannot stand by itself on counter_pick: it touches it with a point of its shape, and its centre",
            "warning",
        ),
        (
            "mesh: leaning.stl\n  collision: boxes\n  at: [0.70 m, -0.30 m]",
            "scene.object-unstable",
            "it touches it with a face of its shape, and its centre of mass is 9 mm outside of it",
            "warning",
        ),
    ],
)
def test_an_object_that_topples_by_itself(check_with, folder, shape, rule, message, severity):
    cone = trimesh.creation.cone(radius=0.03, height=0.09)
    cone.apply_transform(trimesh.transformations.rotation_matrix(math.pi, [1, 0, 0]))
    cone.export(folder / "scenes/cone.stl")
    # A foot 20 mm wide, beside which an equal block of 60 mm lies on top: together 19 mm from the middle of the foot.
    blocks = [trimesh.creation.box((0.02, 0.04, 0.06)), trimesh.creation.box((0.096, 0.04, 0.0125))]
    blocks[1].apply_translation((0.038, 0.0, 0.03625))
    trimesh.util.concatenate(blocks).export(folder / "scenes/leaning.stl")
    kind, at = shape.rsplit("\n  ", 1)
    _, findings, _ = check_with(("radius: 35 mm\n  height: 100 mm", kind), ("at: [0.70 m, -0.30 m]", at))

    one = next(one for one in findings if one["rule"] == rule)
    assert message in one["message"]
    assert one["severity"] == severity


def test_a_place_that_is_taken(check_with):
    _, findings, text = check_with(("at: [-0.25 m, 0.70 m]", "at: [-0.03 m, 0.68 m]"))

    one = next(one for one in findings if one["rule"] == "scene.place-overlap")
    assert "in its place, cup overlaps menu_stand" in one["message"]
    assert one["line"] == line_of(text, "at: [-0.03 m, 0.68 m]")
    unserved = next(one for one in findings if one["rule"] == "scene.unserved" and " serves place: " in one["message"])
    assert "menu_stand" in unserved["message"]
    assert unserved["line"] == one["line"]


def test_a_waypoint_out_of_reach(check_with):
    status, findings, _ = check_with(("approach_height: 150 mm", "approach_height: 2 m"))

    assert status == 1
    (one,) = findings
    assert re.fullmatch(
        r"no configuration of the arm serves grasp_approach: out of reach: 2\.\d\d m from the origin of the arm's "
        r"first joint, reach 1\.\d\d m from there with the gripper",
        one["message"],
    )
    assert "nearer to the robot" in one["hint"]


def test_a_robot_in_collision_at_its_home(check_with):
    status, findings, _ = check_with(("base: [0 m, 0 m, 0.85 m]", "base: [0.42 m, 0.30 m, 0.85 m]"))

    one = next(one for one in findings if one["rule"] == "scene.home-collision")
    assert status == 1
    assert re.match(r"at its home the robot is in collision: \S+ with \S+ .*mm deep", one["message"])
    assert "'home'" in one["hint"]


def test_without_engines_the_rest_is_checked(monkeypatch, rgss, untouched):
    monkeypatch.setitem(sys.modules, "coal", None)
    told = rgss("check", "--project", untouched)
    document = rgss("check", "--json", "--project", untouched).document

    assert (told.status, told.errors) == (0, "")
    assert [line for line in told.output.splitlines() if line.startswith("Skipped: ")] == [
        "Skipped: the scene is not checked: coal is not installed (pip install 'rgss[sim]')."
    ]
    assert "72 variants: 0 findings" in told.output
    assert document["skipped"] == ["the scene is not checked: coal is not installed (pip install 'rgss[sim]')"]


def lengthen_fingers(folder):
    """Give one of the two grippers longer fingers."""
    longer = folder / "scenes/grippers/kg-3.yaml"
    text = longer.read_text(encoding="utf-8")
    assert text.count("grasp_depth: 145 mm") == text.count("length: 90 mm") == 1
    text = text.replace("grasp_depth: 145 mm", "grasp_depth: 175 mm").replace("length: 90 mm", "length: 120 mm")
    longer.write_text(text, encoding="utf-8")


@pytest.mark.parametrize("height", ["105 mm", "300 mm", "1.5 m"])
def test_an_object_too_tall_for_the_hand_is_named_with_what_would_fit(check_with, height):
    status, findings, text = check_with(("height: 100 mm", f"height: {height}"))

    (one,) = [finding for finding in findings if finding["rule"] == "scene.too-tall"]
    assert (status, one["severity"], one["line"]) == (1, "error", line_of(text, f"height: {height}"))
    assert re.fullmatch(
        r"cup is too tall for scenes/grippers/kg-2\.yaml, scenes/grippers/kg-3\.yaml: held at its middle, its top is "
        r"[\d.]+ mm above the grasp, and the palm leaves 52 mm",
        one["message"],
    )
    assert one["hint"].startswith("take an object of at most 104 mm, a gripper with longer fingers")
    # The same collision is not reported again as a waypoint that nothing serves.
    assert not any("gripper_base" in finding["message"] for finding in findings)


def test_an_object_that_just_fits_is_not_too_tall(check_with):
    status, findings, _ = check_with(("height: 100 mm", "height: 103.9 mm"))

    assert (status, findings) == (0, [])


def test_an_object_too_tall_for_one_hand_of_two_is_a_result(check_with, folder):
    lengthen_fingers(folder)
    status, findings, _ = check_with(("height: 100 mm", "height: 130 mm"))

    (one,) = [finding for finding in findings if finding["rule"] == "scene.too-tall"]
    assert (status, one["severity"]) == (0, "info")
    assert one["message"].startswith("cup is too tall for scenes/grippers/kg-2.yaml: ")


@pytest.mark.parametrize("is_for_one", [False, True])
def test_a_further_object_too_tall_is_found_as_the_first_is(check_with, folder, is_for_one):
    """In a task that grips it; at its own height."""
    write_task_of_mug(folder)
    if is_for_one:
        lengthen_fingers(folder)
    mug = MUG.format(at="0.60 m, -0.40 m", to="-0.38 m, 0.70 m").replace("height: 80 mm", "height: 130 mm")
    _, findings, text = check_with(("\nplace_region:\n", mug))

    (one,) = [finding for finding in findings if finding["rule"] == "scene.too-tall"]
    assert one["line"] == line_of(text, "height: 130 mm")
    assert [finding["severity"] for finding in findings] == ["info" if is_for_one else "error"]
    hands = "scenes/grippers/kg-2.yaml" if is_for_one else "scenes/grippers/kg-2.yaml, scenes/grippers/kg-3.yaml"
    assert one["message"].startswith(f"mug is too tall for {hands}: held at its middle, its top is 65 mm above")
    assert not any("gripper_base" in finding["message"] for finding in findings)


def test_a_further_object_that_no_step_grips_may_be_tall(check_with):
    mug = MUG.format(at="0.60 m, -0.40 m", to="-0.38 m, 0.70 m").replace("height: 80 mm", "height: 130 mm")
    _, findings, _ = check_with(("\nplace_region:\n", mug))

    assert not [finding for finding in findings if finding["rule"] == "scene.too-tall"]


def test_an_object_wider_than_its_place_region_is_noted_with_both_sizes(check_with):
    status, findings, text = check_with(("radius: 40 mm", "radius: 30 mm"))

    (one,) = findings
    assert (status, one["rule"], one["severity"]) == (0, "scene.place-region", "info")
    assert one["line"] == line_of(text, "radius: 30 mm")
    assert one["message"] == (
        "cup does not fit its place region: half of its width is 35 mm, and the radius of the region is 30 mm"
    )
    assert one["hint"].startswith("make the radius at least 35 mm, or take a smaller object")


@pytest.fixture
def check_task(rgss, folder):
    """Checks a project with a task; returns the findings on its steps."""

    def check(steps, *edits):
        (folder / "scenes/tasks").mkdir(exist_ok=True)
        # The measures of the study have a row for each of five planned moves.
        missing = 5 - len(re.findall(r"(?m)^  - move: (?!.*straight)", steps))
        steps += "".join(f"  - move: {{name: away_{index}, to: grasp_approach}}\n" for index in range(missing))
        (folder / "scenes/tasks/own.yaml").write_text(f"task: own\nsteps:\n{steps}", encoding="utf-8")
        study = folder / "studies/pick_place.yaml"
        text = study.read_text(encoding="utf-8")
        text = re.sub(r"(?m)^scene: (.*)$", r"scene: \1\ntask: scenes/tasks/own.yaml", text)
        study.write_text(text, encoding="utf-8")
        scene = folder / "scenes/restaurant.yaml"
        text = scene.read_text(encoding="utf-8")
        for old, new in edits:
            assert text.count(old) == 1, old
            text = text.replace(old, new)
        scene.write_text(text, encoding="utf-8")
        told = rgss("check", "--json", "--project", folder)
        return [one for one in told.document["findings"] if one["rule"].startswith("task.")]

    return check


@pytest.mark.parametrize(
    ("steps", "rule", "line", "message"),
    [
        # The approach is 150 mm above the grasp, the fingers reach 30 mm below it and the cup 50 mm above.
        (
            "  - move: {to: grasp_approach}\n  - grip: {}\n  - move: {to: place}\n  - release: {}\n",
            "task.grip-beside",
            4,
            f"{BESIDE}70 mm from cup",
        ),
        (
            "  - move: {to: grasp, raised: 90 mm}\n  - grip: {}\n  - move: {to: place}\n  - release: {}\n",
            "task.grip-beside",
            4,
            f"{BESIDE}10 mm from cup",
        ),
        (f"{LIFTED}  - release: {{}}\n", "task.release-place", 6, f"{ABOVE}1379 mm from its place on counter_place"),
        (
            f"{LIFTED}  - move: {{to: place, raised: 60 mm}}\n  - release: {{}}\n",
            "task.release-height",
            7,
            f"{ABOVE}65 mm above its place on counter_place",
        ),
        (
            f"{LIFTED}  - move: {{to: place, raised: 15 mm}}\n  - release: {{}}\n",
            "task.release-height",
            7,
            f"{ABOVE}20 mm above its place on counter_place, at most 10 mm",
        ),
    ],
)
def test_steps_of_the_hand_that_cannot_succeed(check_task, steps, rule, line, message):
    (one,) = check_task(steps)
    assert (one["rule"], one["line"], one["severity"]) == (rule, line, "error")
    assert one["message"].startswith(message)
    assert one["hint"].startswith("move to ")


def test_steps_of_the_hand_that_can_succeed(check_task):
    steps = "  - move: {to: grasp, raised: 70 mm}\n  - grip: {}\n  - move: {to: place, raised: 4 mm}\n  - release: {}\n"
    assert check_task(steps) == []


@pytest.mark.parametrize(("drop", "found"), [("65 mm", 0), ("55 mm", 1)])
def test_the_height_of_a_release_is_compared_with_the_place(check_task, drop, found):
    steps = f"{LIFTED}  - move: {{to: place, raised: 55 mm}}\n  - release: {{}}\n"
    assert len(check_task(steps, ("\nplace_region:\n", f"\nplace_region:\n  largest_drop: {drop}\n"))) == found


def test_a_chosen_grasp_is_approached_along_its_own_axis(check_task):
    steps = "  - move: {to: grasp_approach}\n  - grip: {}\n  - move: {to: place}\n  - release: {}\n"
    (one,) = check_task(steps, ("\ntask:\n", "\ntask:\n  grasp: automatic\n"))
    assert one["rule"] == "task.grip-beside"
