"""The filmstrip: a panel for each state that was entered, each where it belongs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from rgss.evidence import Failure
from rgss.reports.trials.filmstrip import filmstrip, write_filmstrip
from tests.fixtures.eight_states import Phase

WIDTH, HEIGHT = 200, 150
PHASES = list(Phase)


def pictures(phases):
    """A picture of one colour for each phase."""
    return {
        phase: np.full((HEIGHT, WIDTH, 3), (20 * PHASES.index(phase), 100, 200), dtype=np.uint8) for phase in phases
    }


def panels(image):
    """The colours at the middles of the panels of two rows of four, found from the size of the strip."""
    gap = (image.width - 4 * WIDTH) // 5
    lower = image.height - gap - HEIGHT // 2
    label_gap_and_picture = next(
        distance for distance in range(HEIGHT, image.height) if _is_new_row(image, lower, distance, gap)
    )
    rows = (lower - label_gap_and_picture, lower)
    return [image.getpixel((gap + column * (WIDTH + gap) + WIDTH // 2, row)) for row in rows for column in range(4)]


def _is_new_row(image, lower, distance, gap):
    return image.getpixel((gap + 5, lower - distance))[2] == 200 and distance > HEIGHT


def test_panels_are_in_the_order_of_the_states(succeeded):
    image = filmstrip(succeeded, pictures(PHASES))

    assert panels(image) == [(20 * index, 100, 200) for index in range(8)]


def test_states_that_were_not_entered_are_named_below(succeeded, failed):
    image = filmstrip(failed, pictures(PHASES[:3]))
    whole = filmstrip(succeeded, pictures(PHASES))
    there = {pixel for _, pixel in image.getcolors(1 << 20)}

    assert {(0, 100, 200), (20, 100, 200), (40, 100, 200)} <= there
    assert (236, 238, 241) not in there
    # One row of three panels, and below it the lines with the names of the other five.
    assert 3 * WIDTH < image.width < 4 * WIDTH
    assert HEIGHT < image.height < whole.height / 1.5
    lowest = np.asarray(image.convert("L"))[-40:]
    assert lowest.min() < 140
    assert np.asarray(whole.convert("L"))[-5:].min() > 200


def test_the_headline_and_the_names_of_states_that_were_not_entered_fit(failed):
    for width in (200, 333, 640):
        ended = replace(
            failed,
            variant=10_000,
            failure=Failure.TRAJECTORY_IN_COLLISION,
            failed_phase=PHASES[4],
            phases=(
                replace(failed.phases[2], phase=PHASES[0]),
                *(replace(failed.phases[3], phase=phase) for phase in PHASES[1:]),
            ),
        )
        image = np.asarray(filmstrip(ended, {PHASES[0]: np.zeros((width, width, 3), dtype=np.uint8)}).convert("L"))
        gap = (image.shape[1] - 3 * width) // 4
        assert image[:, -gap:].min() > 200, width


def test_the_state_that_failed_has_a_red_frame_even_if_nothing_moved(failed):
    for there in (PHASES[:3], PHASES[:2]):
        image = filmstrip(failed, pictures(there))
        gap = (image.width - 3 * WIDTH) // 4
        left = gap + 2 * (WIDTH + gap)
        edge = [image.getpixel((left, row)) for row in range(image.height)]
        assert edge.count((190, 38, 32)) == HEIGHT
        assert [image.getpixel((gap, row)) for row in range(image.height)].count((190, 38, 32)) == 0
    # Without a picture the panel says so.
    assert (236, 238, 241) in {pixel for _, pixel in image.getcolors(1 << 20)}


def test_outcomes_have_their_colours(succeeded, failed):
    def colours(record):
        return {pixel for _, pixel in filmstrip(record, pictures(PHASES[:3])).getcolors(1 << 20)}

    green, red = (28, 122, 62), (190, 38, 32)
    assert green in colours(succeeded)
    assert red not in colours(succeeded)
    assert {green, red} <= colours(failed)


def test_labels_fit_above_their_panels(succeeded):
    """The longest titles end before the next panel begins, at any size that can be asked for."""
    for width in (200, 333, 640):
        shown = {phase: np.zeros((width, width, 3), dtype=np.uint8) for phase in PHASES}
        image = np.asarray(filmstrip(succeeded, shown).convert("L"))
        gap = (image.shape[1] - 4 * width) // 5
        for column in range(1, 5):
            edge = column * (width + gap)
            strip = image[:, edge + gap // 2 : edge + gap]
            assert strip[3 * gap :].min() > 200, width


def test_file_is_a_png_and_the_only_one(succeeded, tmp_path):
    path = tmp_path / "strip.png"
    write_filmstrip(path, succeeded, pictures(PHASES))

    assert [entry.name for entry in tmp_path.iterdir()] == ["strip.png"]
    with Image.open(path) as image:
        assert image.format == "PNG"
        assert image.size == filmstrip(succeeded, pictures(PHASES)).size


def test_the_whole_strip_is_of_two_rows(succeeded):
    image = filmstrip(succeeded, pictures(PHASES))

    assert 4 * WIDTH < image.width < 5 * WIDTH
    assert 2 * HEIGHT < image.height < 3 * HEIGHT
    assert image.mode == "RGB"
    assert image.getpixel((0, 0)) == pytest.approx((255, 255, 255))
